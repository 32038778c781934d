"""The loop with each contact method, the trip of Fig. 13, and the effect of facets on the torque."""

import numpy as np

from reports import words
from reports.figures import Canvas, Figure, Tables, style


def costs(tables: Tables) -> Canvas:
    """A row for each loop, a dot for each number of segments, on a logarithmic axis."""
    cost = tables["cost"]
    loops = list(cost["loop"].unique())
    canvas, ax = style.subplots(1.2 + 0.28 * len(loops))
    for index, (segments, chosen) in enumerate(cost.groupby("segments")):
        at = chosen.set_index("loop").reindex(loops)
        height = np.arange(len(loops)) + 0.14 * (2 * index - 1)
        ax.plot(at["ns_per_segment_step"], height, **style.dots(index), markersize=6, label=f"{segments} segments")
    ax.set(xscale="log", xlabel="cost per segment and step, ns")
    style.rows_downwards(ax, [words.name(loop) for loop in loops])
    style.legend_above(ax)
    return canvas


def figure_13(tables: Tables) -> Canvas:
    """Σ rμF_n over depth: the engine's whole trip, both methods in windows; below, their difference."""
    windows, trip = tables["figure_13"], tables["trip"]
    canvas, (above, below) = style.subplots(4.6, 2, 1, sharex=True, height_ratios=[2, 1])
    above.plot(
        trip["bit_depth_m"],
        trip["sum_r_mu_fn_N_m"] / 1e3,
        color=style.QUIET,
        linewidth=1.2,
        label="FCTD, the whole trip",
    )
    above.plot(windows["bit_depth_m"], windows["FCTD_kN_m"], **style.dots(0), markersize=8, label="FCTD, windows")
    above.plot(
        windows["bit_depth_m"], windows["fcl_kN_m"], **style.dots(1, filled=False), markersize=5, label="FCL, windows"
    )
    above.set_ylabel("Σ rμFₙ, kN·m")
    below.plot(windows["bit_depth_m"], windows["difference_percent"], **style.dots(1, filled=False))
    below.axhline(0, **style.ZERO)
    below.set(xlabel="bit depth, m", ylabel="FCL − FCTD, %", ylim=style.around_zero(windows["difference_percent"]))
    style.legend_above(above, columns=3)
    return canvas


def facets(tables: Tables) -> Canvas:
    """The difference of contact force times radius between mesh and cylinders, over facets, with the wedge."""
    meshes = tables["facets"].dropna(subset="facets")
    canvas, ax = style.subplots(3.4)
    ax.plot(
        meshes["facets"],
        meshes["wedge_percent"],
        color=style.QUIET,
        linewidth=3.5,
        marker="o",
        alpha=0.6,
        label="1/cos(π/n) − 1",
    )
    ax.plot(
        meshes["facets"],
        meshes["sum_difference_percent"].abs(),
        **style.marked(1),
        label="|mesh − cylinders|",
    )
    ax.set(xscale="log", yscale="log", xlabel="number of facets, –", ylabel="difference of Σ rμFₙ, %")
    style.plain_log_ticks(ax.xaxis, ax.yaxis)
    ax.set_xticks(meshes["facets"].to_list())
    ax.legend()
    return canvas


def torques(tables: Tables) -> Canvas:
    """A dot for each method: its difference of Σ rμF_n while rotating."""
    methods = tables["torques"]
    canvas, ax = style.subplots(1.2 + 0.28 * len(methods))
    ax.plot(methods["sum_difference_percent"], methods["method"].map(words.name), **style.dots(1), markersize=6)
    ax.axvline(0, **style.ZERO)
    ax.set(xlabel="Σ rμFₙ against FCTD, %", xlim=style.around_zero(methods["sum_difference_percent"]))
    ax.invert_yaxis()
    return canvas


FIGURES = [
    Figure(
        "costs",
        "Cost of one segment and step in the same loop with each contact method, by number of segments. Compiled "
        "loops need no call from Python; the row “no contact, asked from Python” is the cost of such calls.",
        costs,
    ),
    Figure(
        "figure_13",
        "The paper's well tripped into down to 2250 m (its Fig. 13), law paper. FCL contact was run in windows of "
        "some metres only; the whole trip with it is an extrapolation in the table of times. Below: the difference "
        "of the two contact methods over the same windows.",
        figure_13,
    ),
    Figure(
        "torques",
        "The curved chain rotating against the wall of every contact method at its default options: difference of "
        "the sum from that with the engine's own cylinders.",
        torques,
    ),
    Figure(
        "facets",
        "Why a mesh gives more torque: two facets support a string that rests in the corner between them. The wide "
        "grey line is the excess of two facets at an angle of 2π/n over a round wall; a string on the flat of a "
        "facet has no excess.",
        facets,
    ),
]
