"""The error of a bend built from straight cylinders."""

from reports.figures import Canvas, Figure, Tables, style


def errors(tables: Tables) -> Canvas:
    """Error of penetration, with its bound, and of direction against the length of a cylinder."""
    table = tables["errors"].sort_values("cylinder_length_m")
    length = table["cylinder_length_m"]
    canvas, (penetration, angle) = style.subplots(3.6, 1, 2, sharex=True)
    penetration.plot(length, table["bound_mm"], color=style.QUIET, linewidth=3.5, alpha=0.6, label="bound ℓ²/8R")
    penetration.plot(length, table["max_penetration_error_mm"], **style.marked(0), label="largest")
    penetration.plot(length, table["rms_penetration_error_mm"], **style.marked(1), label="root mean square")
    penetration.set_ylabel("error of penetration, mm")
    penetration.legend(loc="upper left")
    angle.plot(length, table["max_angle_error_deg"], **style.marked(0))
    angle.set_ylabel("largest error of direction, °")
    for ax in (penetration, angle):
        ax.set(xscale="log", yscale="log", xlabel="cylinder length, m")
        style.plain_log_ticks(ax.xaxis, ax.yaxis)
    return canvas


FIGURES = [
    Figure(
        "errors",
        "Error of the wall's position (left) and direction (right), against the exact arc, for points "
        "near the wall of a bend built from cylinders of one length. The wide grey line is the distance "
        "between chord and arc, which falls with the square of the length.",
        errors,
    )
]
