"""Closed forms of hydraulics against exact laminar flow."""

from matplotlib.axes import Axes

from reports.figures import Tables, figure, style

RATIO, INDEX = 0.6, 0.7  # of radii, for the left panel; of the flow curve, for the right one


@figure(
    "annular_flow",
    name="closed_forms",
    caption=(
        "Friction pressure by RP 13D's closed form against the exact laminar flow. Left: a pipe at rest, radii as 0.6, "
        "over the share of the yield stress in the stress at the wall. Right: pipes that move in a mud without yield "
        "stress, n = 0.7, over the ratio of radii."
    ),
)
@style.panels(3.4, 1, 2)
def closed_forms(tables: Tables, *axes: Axes) -> None:
    """Error of the gradient, at rest by index and moving by motion."""
    still, moving = axes
    rest = tables["rest"][tables["rest"]["ratio"] == RATIO]
    for k, (index, part) in enumerate(rest.groupby("index")):
        still.plot(part["yield_share"], part["gradient_off_percent"], **style.marked(k), label=f"RP 13D, n = {index:g}")
    newtonian = rest[rest["index"] == 1.0]
    still.plot(newtonian["yield_share"], newtonian["slot_off_percent"], **style.BOUND, label="exact slot, n = 1")
    still.set(xlabel="yield stress over stress at the wall, –", ylabel="error of the gradient, %")
    motions = tables["moving"]
    motions = motions[(motions["index"] == INDEX) & (motions["yield_share"] == 0)]
    for k, (motion, part) in enumerate(motions.groupby("motion", sort=False)):
        moving.plot(part["ratio"], part["gradient_off_percent"], **style.marked(k), label=str(motion))
    moving.set(xlabel="radius of pipe over that of hole, –")
    for ax in axes:
        ax.axhline(0.0, **style.ZERO)
        ax.legend()
