"""All operations on a real survey."""

from matplotlib.figure import Figure as Canvas

from reports import words
from reports.figures import Figure, Tables, style
from reports.figures.steady_state import TURNING


def chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, arcs geometry."""
    table = tables["chart"][tables["chart"]["geometry"] == "arcs"]
    canvas = style.figure(5.0)
    hookload, torque = canvas.subplots(1, 2, sharey=True)
    for index, operation in enumerate(table["operation"].unique()):
        of_kind = table[table["operation"] == operation]
        look = {**style.line(index), "label": words.name(operation)}
        hookload.plot(of_kind["hookload_N"] / 1e3, of_kind["bit_depth_m"], **look)
        odd = of_kind[of_kind["status"] != "converged"]
        hookload.plot(odd["hookload_N"] / 1e3, odd["bit_depth_m"], **style.dots(index), markersize=8)
        if operation in TURNING:
            torque.plot(of_kind["surface_torque_N_m"] / 1e3, of_kind["bit_depth_m"], **style.line(index))
    hookload.set_xlabel("hook load, kN")
    torque.set_xlabel("surface torque, kN·m")
    hookload.set_xlim(left=0)
    torque.set_xlim(left=0)
    style.depth_downwards(hookload, "bit depth, m")
    canvas.legend(*hookload.get_legend_handles_labels(), loc="outside upper left", ncols=3)
    return canvas


FIGURES = [
    Figure(
        "chart",
        "A real survey of 8,161 m with an assumed string and friction factor 0.2: hook load (left) and surface "
        "torque (right) of all operations. Filled marks, if any, are rows that locked up or are unstable.",
        chart,
    )
]
