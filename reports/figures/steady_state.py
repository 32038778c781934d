"""A chart of the paper's well by the steady solver, the stepper's answers beside it."""

from matplotlib.figure import Figure as Canvas

from reports import words
from reports.figures import Figure, Tables, style

TURNING = ("rotate_off_bottom", "back_ream", "drill_rotating")


def chart(tables: Tables) -> Canvas:
    """Hook load and torque against bit depth, lines from the solver, open marks from the stepper."""
    table, compared = tables["chart"], tables["compared"]
    canvas = style.figure(5.0)
    hookload, torque = canvas.subplots(1, 2, sharey=True)
    for index, operation in enumerate(table["operation"].unique()):
        of_kind = table[table["operation"] == operation]
        hookload.plot(
            of_kind["hookload_N"] / 1e3, of_kind["bit_depth_m"], **style.line(index), label=words.name(operation)
        )
        if operation in TURNING:
            torque.plot(of_kind["surface_torque_N_m"] / 1e3, of_kind["bit_depth_m"], **style.line(index))
        stepped = compared[compared["operation"] == operation]
        marks = style.dots(index, filled=False) | {"markersize": 7}
        hookload.plot(stepped["hookload_stepped_kN"], stepped["bit_depth_m"], **marks)
        if operation in TURNING:
            torque.plot(stepped["torque_stepped_kN_m"], stepped["bit_depth_m"], **marks)
    hookload.set_xlabel("hook load, kN")
    torque.set_xlabel("surface torque, kN·m")
    torque.set_xlim(left=0)
    style.depth_downwards(hookload, "bit depth, m")
    canvas.legend(*hookload.get_legend_handles_labels(), loc="outside upper left", ncols=3)
    return canvas


FIGURES = [
    Figure(
        "chart",
        "The paper's well by the steady solver: hook load (left) and surface torque of the operations that turn "
        "(right), every 10 m; drilling with 50 kN on the bit and 3 kN·m. Open marks are the stepper's answers at "
        "the same depths.",
        chart,
    )
]
