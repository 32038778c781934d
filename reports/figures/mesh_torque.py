"""Torque off bottom with contact on a mesh and in cylinders."""

from reports.figures import Canvas, Figure, Tables, style


def figure_13b(tables: Tables) -> Canvas:
    """Σ rμF_n of the windows with both methods and the steady torque; below, differences in the windows."""
    windows, steady = tables["windows"], tables["steady"]
    canvas, (above, below) = style.subplots(4.6, 2, 1, sharex=True, height_ratios=[2, 1])
    depth = windows["bit_depth_m"]
    above.plot(
        steady["bit_depth_m"], steady["surface_torque_N_m"] / 1e3, color=style.QUIET, linewidth=1.2,
        label="FCTD, steady torque",
    )  # fmt: skip
    above.plot(depth, windows["FCTD_sum_r_mu_fn_kN_m"], **style.dots(0), markersize=8, label="FCTD, windows")
    above.plot(
        depth, windows["fcl_sum_r_mu_fn_kN_m"], **style.dots(1, filled=False), markersize=5, label="FCL, windows"
    )
    above.set_ylabel("Σ rμFₙ, kN·m")
    differences = (("sum_r_mu_fn_difference_percent", 1, "Σ rμFₙ"), ("difference_percent", 2, "surface torque"))
    for column, index, label in differences:
        below.plot(depth, windows[column], **style.dots(index, filled=False), label=label)
    below.axhline(0, **style.ZERO)
    limits = style.around_zero(windows[[column for column, *_ in differences]])
    below.set(xlabel="bit depth, m", ylabel="FCL − FCTD, %", ylim=limits)
    below.legend(loc="upper left", ncols=2)
    style.legend_above(above, columns=3)
    return canvas


FIGURES = [
    Figure(
        "figure_13b",
        "Paper's Fig. 13 in reading (b): the string rotates off bottom under law coulomb, contact with FCL on a mesh "
        "and in cylinders; above Σ rμFₙ, in rotation the torque of friction, over the last seconds of short windows. "
        "Below: differences, also of the surface torque, which still swings in such a window. The study contact_swap "
        "shows reading (a).",
        figure_13b,
    )
]
