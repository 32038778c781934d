"""Torque off bottom with contact on a mesh and in cylinders."""

from matplotlib.figure import Figure as Canvas

from reports.figures import Figure, Tables, style


def figure_13b(tables: Tables) -> Canvas:
    """Torque of the windows with both methods and the steady curve; below, the difference in the windows."""
    windows, steady = tables["windows"], tables["steady"]
    canvas = style.figure(4.6)
    above, below = canvas.subplots(2, 1, sharex=True, height_ratios=[2, 1])
    above.plot(
        steady["bit_depth_m"], steady["surface_torque_N_m"] / 1e3, color=style.QUIET, linewidth=1.2,
        label="FCTD, steady",
    )  # fmt: skip
    above.plot(windows["bit_depth_m"], windows["FCTD_kN_m"], **style.dots(0), markersize=8, label="FCTD, windows")
    above.plot(
        windows["bit_depth_m"], windows["fcl_kN_m"], **style.dots(1, filled=False), markersize=5, label="FCL, windows"
    )
    above.set_ylabel("surface torque, kN·m")
    below.plot(windows["bit_depth_m"], windows["difference_percent"], **style.dots(1, filled=False))
    below.axhline(0, color=style.QUIET, linewidth=1)
    below.set(xlabel="bit depth, m", ylabel="FCL − FCTD, %")
    largest = 1.5 * float(windows["difference_percent"].abs().max())
    below.set_ylim(-largest, largest)
    style.legend_above(above, columns=3)
    return canvas


FIGURES = [
    Figure(
        "figure_13b",
        "Paper's Fig. 13 in reading (b): torque while rotating off bottom, law coulomb, with FCL contact on a mesh and "
        "in cylinders, means over the same few seconds after a start from rest, in which the string still swings about "
        "its steady torque (grey). Below: the difference of the two. Reading (a) stands with the study contact_swap.",
        figure_13b,
    )
]
