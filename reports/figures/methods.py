"""Contact methods and engines: operations, cost, error, and whether loads depend on them."""

import numpy as np
from matplotlib.axes import Axes

from reports import words
from reports.figures import Canvas, Tables, figure, style


@figure(
    "contact_operations",
    name="operations",
    caption=(
        "Operations of one contact point on the paper's well, counted by running the engine's own helpers. The paper "
        "counts thirteen for one cylinder; its search tests a few hundred cylinders, while the engine remembers the "
        "last one."
    ),
    checks=("operations of*",),
)
def operations(tables: Tables) -> Canvas:
    """A row for each part, arithmetic and comparisons on a logarithmic axis."""
    table = tables["operations"]
    canvas, ax = style.subplots(1.0 + 0.3 * len(table))
    for index, column in enumerate(("arithmetic", "compare")):
        some = table[column] > 0
        height = np.flatnonzero(some) + 0.14 * (2 * index - 1)
        label = "sums, products, roots" if column == "arithmetic" else "comparisons"
        ax.plot(table.loc[some, column], height, **style.dots(index, filled=not index), markersize=6, label=label)
    ax.set(xscale="log", xlabel="operations per point, –")
    style.rows_downwards(ax, list(table["what"]))
    style.legend_outside(ax)
    return canvas


# Zero has no place on a logarithmic axis; exact answers are drawn on a line below it.
FLOOR = 0.3


@figure(
    "contact_accuracy",
    name="error_and_cost",
    caption=(
        "Largest error of penetration (left) and of the wall's direction (right) over all points, against "
        "the processor time of a point in a query from Python, with quartiles. Lines lead from coarse to fine: "
        "cylinders and FOR-loop by length, meshes by facets and ring spacing. Points on the dotted line are exact."
    ),
    checks=("largest error of*", "missed contacts*"),
)
@style.panels(4.3, 1, 2, sharex=True)
def error_and_cost(tables: Tables, depth: Axes, angle: Axes) -> None:
    """A line for each method from its coarse to its fine settings: error of depth and of direction."""
    cost = tables["cost"]
    panels = ((depth, "max_error_mm"), (angle, "max_angle_deg"))
    for index, method in enumerate(cost["method"].unique()):
        chosen = cost[cost["method"] == method]
        look = style.dots(index, filled=index < 6) | {"linestyle": "-", "linewidth": 0.8}
        for ax, column in panels:
            smallest = cost.loc[cost[column] > 1e-5, column].min()
            at, height = chosen["point_ns"], chosen[column].clip(lower=FLOOR * smallest)
            ax.plot(at, height, **look, label=words.name(method))
            ax.hlines(height, chosen["point_ns_low"], chosen["point_ns_high"], color=style.colour(index), linewidth=2)
    for ax, label in ((depth, "largest error of penetration, mm"), (angle, "largest error of direction, °")):
        ax.set(xscale="log", yscale="log", xlabel="cost per point, ns", ylabel=label)
        style.plain_log_ticks(ax.yaxis)
    for ax, column in panels:
        exact_line(ax, FLOOR * cost.loc[cost[column] > 1e-5, column].min())
    style.legend_outside(depth, columns=4)


def exact_line(ax: Axes, height: float) -> None:
    """The line on which exact answers are drawn."""
    ax.axhline(height, color=style.QUIET, linewidth=1, linestyle=(0, (1, 2)))
    ax.annotate("exact", (0.98, height), xycoords=("axes fraction", "data"), ha="right", va="bottom", color=style.QUIET)


@figure(
    "contact_swap",
    name="costs",
    caption=(
        "Cost of one segment and step in the same loop with each contact method, by number of segments. Compiled "
        "loops need no call from Python; the row “no contact, asked from Python” is the cost of such calls."
    ),
    checks=("cost of a step*", "FCL contact over cylinders*"),
)
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


@figure(
    "contact_swap",
    name="figure_13",
    caption=(
        "The paper's well tripped into down to 2250 m (its Fig. 13), law paper. FCL contact was run in windows of "
        "some metres only; the whole trip with it is an extrapolation in the table of times. Below: the difference "
        "of the two contact methods over the same windows."
    ),
    checks=("Σ rμF_n tripping in*",),
)
@style.panels(4.6, 2, 1, sharex=True, height_ratios=[2, 1])
def figure_13(tables: Tables, above: Axes, below: Axes) -> None:
    """Σ rμF_n over depth: the engine's whole trip, both methods in windows; below, their difference."""
    windows, trip = tables["figure_13"], tables["trip"]
    above.plot(
        trip["bit_depth_m"],
        trip["sum_r_mu_fn_N_m"] / 1e3,
        color=style.QUIET,
        linewidth=1.2,
        label="FCTD, the whole trip",
    )
    depth, off = windows["bit_depth_m"], windows["sum_difference_percent"]
    above.plot(depth, windows["FCTD_sum_r_mu_fn_kN_m"], **style.dots(0), markersize=8, label="FCTD, windows")
    above.plot(
        depth, windows["fcl_sum_r_mu_fn_kN_m"], **style.dots(1, filled=False), markersize=5, label="FCL, windows"
    )
    above.set_ylabel("Σ rμFₙ, kN·m")
    below.plot(depth, off, **style.dots(1, filled=False))
    below.axhline(0, **style.ZERO)
    below.set(xlabel="bit depth, m", ylabel="FCL − FCTD, %", ylim=style.around_zero(off))
    style.legend_above(above, columns=3)


@figure(
    "contact_swap",
    name="torques",
    caption=(
        "The curved chain rotating against the wall of every contact method at its default options: difference of "
        "the sum from that with the engine's own arcs."
    ),
    checks=("Σ rμF_n rotating*",),
)
def torques(tables: Tables) -> Canvas:
    """A dot for each method: its difference of Σ rμF_n while rotating."""
    methods = tables["torques"]
    canvas, ax = style.subplots(1.2 + 0.28 * len(methods))
    ax.plot(methods["sum_difference_percent"], methods["method"].map(words.name), **style.dots(1), markersize=6)
    ax.axvline(0, **style.ZERO)
    ax.set(xlabel="Σ rμFₙ against FCTD, %", xlim=style.around_zero(methods["sum_difference_percent"]))
    ax.invert_yaxis()
    return canvas


@figure(
    "contact_swap",
    name="facets",
    caption=(
        "Why a mesh gives more torque: two facets support a string that rests in the corner between them. The wide "
        "grey line is the excess of two facets at an angle of 2π/n over a round wall; a string on the flat of a "
        "facet has no excess. Where the second line has no mark the run with that mesh failed; the table says how."
    ),
    checks=("Σ rμF_n rotating, meshes*",),
)
@style.panels(3.4)
def facets(tables: Tables, ax: Axes) -> None:
    """The difference of contact force times radius between mesh and cylinders, over facets, with the wedge."""
    meshes = tables["facets"].dropna(subset="facets")
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
        label="|mesh − arcs|",
    )
    ax.set(xscale="log", yscale="log", xlabel="number of facets, –", ylabel="difference of Σ rμFₙ, %")
    style.plain_log_ticks(ax.xaxis, ax.yaxis)
    ax.set_xticks(meshes["facets"].to_list())
    ax.legend()


@figure(
    "mesh_torque",
    name="figure_13b",
    caption=(
        "Paper's Fig. 13 in reading (b): the string rotates off bottom under law coulomb, contact with FCL on a mesh "
        "and in cylinders; above Σ rμFₙ, in rotation the torque of friction, over the same windows from one start. "
        "Below: differences, also of the surface torque. The study contact_swap shows reading (a)."
    ),
    checks=("*FCL against FCTD*",),
)
@style.panels(4.6, 2, 1, sharex=True, height_ratios=[2, 1])
def figure_13b(tables: Tables, above: Axes, below: Axes) -> None:
    """Σ rμF_n of the windows with both methods and the steady torque; below, differences in the windows."""
    windows, steady = tables["windows"], tables["steady"]
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
    differences = (("sum_difference_percent", 1, "Σ rμFₙ"), ("torque_difference_percent", 2, "surface torque"))
    for column, index, label in differences:
        below.plot(depth, windows[column], **style.dots(index, filled=False), label=label)
    below.axhline(0, **style.ZERO)
    limits = style.around_zero(windows[[column for column, *_ in differences]])
    below.set(xlabel="bit depth, m", ylabel="FCL − FCTD, %", ylim=limits)
    below.legend(loc="lower left", ncols=2)
    style.legend_above(above, columns=3)


@figure(
    "engines_agree",
    name="loads",
    caption=(
        "The curved chain in other engines, from the same state over the same window: differences of hook load and "
        "torque from FCTD's. An open dot is a run that failed a check; where FCTD has no torque there is no dot."
    ),
    checks=("*: curved chain, * against FCTD's*",),
)
def loads(tables: Tables) -> Canvas:
    """A dot per engine and operation: hook load and torque against FCTD; open dots failed a check."""
    numbers = tables["chain"]
    numbers = numbers[numbers["engine"] != "FCTD"]
    names = list(numbers["engine"].unique())
    windows = list(numbers.groupby(["hole", "operation"], sort=False))
    canvas, axes = style.subplots(1.8 + 0.42 * len(names), 1, 2, sharey=True)
    columns = (("hookload_off_percent", "hook load − FCTD's, %"), ("torque_off_percent", "torque − FCTD's, %"))
    for ax, (column, label) in zip(axes, columns, strict=True):
        for index, ((hole, kind), rows) in enumerate(windows):
            turning = ", hole that turns" if hole == "turning" else ""
            for _, row in rows.iterrows():
                height = names.index(row["engine"]) + 0.16 * (index - (len(windows) - 1) / 2)
                ax.plot(
                    row[column], height, **style.dots(index, filled=row["status"] == "valid"), markersize=6,
                    label=words.name(str(kind)) + turning,
                )  # fmt: skip
        ax.axvline(0, **style.ZERO)
        ax.set_xlabel(label)
        ax.margins(x=0.12)
    style.rows_downwards(axes[0], names)
    handles, labels = axes[0].get_legend_handles_labels()
    first = {label: handle for handle, label in zip(handles, labels, strict=True)}
    canvas.legend(first.values(), first.keys(), loc="outside upper left", ncols=2)
    return canvas


@figure(
    "engines_agree",
    name="contact",
    caption=(
        "Contact force along the turning chain in each engine at its best configuration, means over the last quarter "
        "of a second."
    ),
    checks=("*: runs of curved chain that*",),
)
@style.panels(3.4)
def contact(tables: Tables, ax: Axes) -> None:
    """Contact force along the turning chain, one line for each engine at its best configuration."""
    profiles = tables["profiles"]
    turning = profiles[(profiles["operation"] == "rotate_off_bottom") & (profiles["hole"] == "planar")]
    names = [name for name in turning["engine"].unique() if "default" not in name]
    for index, name in enumerate(names):
        at = turning[turning["engine"] == name]
        ax.plot(at["md_m"], at["contact_force_N"] / 1e3, **style.line(index), label=name)
    touched = turning.loc[turning["contact_force_N"] > 0, "md_m"]
    ax.set(xlabel="measured depth, m", ylabel="contact force, kN", xlim=(touched.min() - 50, touched.max() + 20))
    style.legend_above(ax, columns=4)


@figure(
    "engines_agree",
    name="friction",
    caption=(
        "A pipe turning in a straight, horizontal hole: angle of friction to the sliding, positive up the hole, over "
        "the azimuth of the hole. By Coulomb's law it is zero. Rings: friction opposite to M·v, with M the effective "
        "masses along two fixed directions."
    ),
    checks=("*: rules of the gate*",),
)
@style.panels(3.2)
def friction(tables: Tables, ax: Axes) -> None:
    """Angle of friction to the sliding over the azimuth of a straight hole, and that of two fixed directions."""
    table = tables["friction"]
    for index, (name, at) in enumerate(table.groupby("engine", sort=False)):
        ax.plot(at["azimuth_deg"], at["lean_deg"], **style.dots(index), markersize=6, label=name)
    given = table.dropna(subset="two_directions_lean_deg")
    ax.plot(
        given["azimuth_deg"], given["two_directions_lean_deg"], color=style.QUIET, linestyle="none", marker="o",
        markersize=12, markerfacecolor="none", label="against M·v, north and east",
    )  # fmt: skip
    ax.set(xlabel="azimuth of the hole, °", ylabel="angle of friction to sliding, °")
    style.legend_above(ax, columns=3)


REAL_TIME_MS = 1000.0


@figure(
    "speed",
    name="seconds",
    caption=(
        "Wall time of a simulated second of the curved chain, turning in contact (circles) or hanging free "
        "(squares), at each engine's own step (filled) and at the shortest of all steps (open). Same string and "
        "initial state, fastest of several rounds; nothing is extrapolated. The dashed line is real time. “In our "
        "loop”: another contact method in FCTD's loop, called from Python; without contact its query is empty. Struck "
        "through: the engine failed the gate before any speed, and the table says how."
    ),
    checks=("*over FCTD*", "real-time factor*"),
)
def seconds(tables: Tables) -> Canvas:
    """A panel for each number of segments, a row for each engine, a dot for each state and step."""
    times = tables["times"]
    times = times[times["state"].isin(["no contact", "contact"])]
    names = list(times["engine"].unique())
    names.sort(key=lambda name: times.loc[times["engine"] == name, "ms_per_simulated_s"].max())
    counts = sorted(times["segments"].unique())
    tall = 1.7 + 0.4 * len(names)
    canvas, (axes,) = style.subplots(tall, 1, len(counts), sharex=True, sharey=True, squeeze=False)
    for ax, count in zip(axes, counts, strict=True):
        here = times[times["segments"] == count]
        for index, ((state, step), chosen) in enumerate(here.groupby(["state", "step"], sort=True)):
            at = chosen.set_index("engine")["ms_per_simulated_s"].reindex(names)
            height = np.arange(len(names)) + 0.17 * (index - 1.5)
            look = style.dots(0 if state == "contact" else 1, filled=step == "own step")
            ax.plot(at, height, **look, markersize=5.5, label=f"{state}, {step}")
            wrong = chosen[words.failed_gate(chosen)].set_index("engine")["ms_per_simulated_s"].reindex(names)
            ax.plot(wrong, height, **style.STRUCK)
        ax.axvline(REAL_TIME_MS, **style.BOUND)
        ax.set(xscale="log", xlabel="wall time of a simulated second, ms", title=f"{count} segments")
    in_loop = {name: f"{words.name(method)} in our loop" for name in names for method in words.METHODS
               if name == f"{method} in our loop"}  # fmt: skip
    style.rows_downwards(axes[0], [in_loop.get(name, name) for name in names])
    style.legend_outside(axes[0])
    return canvas


@figure(
    "speed",
    name="scaling",
    caption=(
        "FCTD's cost of one segment and step over the number of segments, in contact, fastest round. A level line "
        "means a cost proportional to the number of segments; in addition the stable step shrinks with the length of "
        "the segments."
    ),
    checks=("segment-step with contact*", "exponent*"),
)
@style.panels(2.6)
def scaling(tables: Tables, ax: Axes) -> None:
    """Cost of a segment-step over the number of segments."""
    table = tables["scaling"]
    ax.plot(table["segments"], table["ns_least"], **style.marked(0))
    ax.set(
        xscale="log",
        xlabel="number of segments, –",
        ylabel="cost per segment and step, ns",
        ylim=(0, 1.15 * table["ns_least"].max()),
    )
    style.plain_log_ticks(ax.xaxis)
    ax.set_xticks(table["segments"].to_list())
