"""Single precision in a well."""

from matplotlib.axes import Axes

from reports.figures import Tables, figure, style


@figure(
    "precision_in_depth",
    name="depth",
    caption=(
        "Left: false force of a wall of 10⁷ N/m at the worst point, where places are kept in single precision; the "
        "level lines have an origin for every 50 m of hole. Right: the step from which on a free body falls right "
        "(filled) and up to which it does not fall at all (open), against its height above the origin; lines are the "
        "estimates √(spacing/2εg), ε = 5 %, √(spacing/2g) and spacing/2gt, t = 0.1 s; 0.1 ms is the shortest step "
        "tried."
    ),
)
@style.panels(4.4, 1, 2)
def depth(tables: Tables, force: Axes, step: Axes) -> None:
    """Force over depth, a line for each method; step over height, a colour for each kind of integrator."""
    wall, steps = tables["wall"], tables["steps"]
    for index, (name, at) in enumerate(wall.groupby("method", sort=False)):
        force.plot(at["depth_m"] / 1e3, at["false_force_kN"], **style.marked(index), label=name)
        force.plot(at["depth_m"] / 1e3, at["with_origins_kN"], **style.line(index) | {"linewidth": 0.9})
    force.set(xlabel="depth of the hole, km", ylabel="false force of the wall, kN", yscale="log")
    style.plain_log_ticks(force.yaxis)
    for index, (name, at) in enumerate(steps.groupby("integrator", sort=False)):
        for what, filled in (("right_from", True), ("frozen_up_to", False)):
            step.plot(at["height_m"], at[f"{what}_ms"], **style.dots(index, filled=filled), markersize=6,
                      label=f"{name}: {'falls right from' if filled else 'frozen up to'}")  # fmt: skip
        for what in ("right_expected_ms", "frozen_expected_ms"):
            step.plot(at["height_m"], at[what], color=style.COLOURS[index], linewidth=0.9)
    step.set(xlabel="height above the origin, m", ylabel="step, ms", xscale="log", yscale="log", ylim=(0.04, 40))
    style.plain_log_ticks(step.yaxis)
    for ax in (force, step):
        style.legend_above(ax, columns=1)
