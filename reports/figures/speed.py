"""Cost of a simulated second in each engine, and cost of a segment-step in FCTD over the number of segments."""

import numpy as np

from reports.figures import Canvas, Figure, Tables, style

REAL_TIME_MS = 1000.0


def seconds(tables: Tables) -> Canvas:
    """A panel for each number of segments, a row for each engine, a dot for each state and step."""
    times = tables["times"]
    times = times[times["state"].isin(["no contact", "contact"])]
    names = list(times["engine"].unique())
    names.sort(key=lambda name: times.loc[times["engine"] == name, "ms_per_simulated_s"].max())
    counts = sorted(times["segments"].unique())
    height = 1.7 + 0.4 * len(names)
    canvas, (axes,) = style.subplots(height, 1, len(counts), sharex=True, sharey=True, squeeze=False)
    for ax, count in zip(axes, counts, strict=True):
        here = times[times["segments"] == count]
        for index, ((state, step), chosen) in enumerate(here.groupby(["state", "step"], sort=True)):
            at = chosen.set_index("engine")["ms_per_simulated_s"].reindex(names)
            height = np.arange(len(names)) + 0.17 * (index - 1.5)
            look = style.dots(0 if state == "contact" else 1, filled=step == "own step")
            ax.plot(at, height, **look, markersize=5.5, label=f"{state}, {step}")
        ax.axvline(REAL_TIME_MS, **style.BOUND)
        ax.set(xscale="log", xlabel="wall time of a simulated second, ms", title=f"{count} segments")
    style.rows_downwards(axes[0], names)
    style.legend_outside(canvas, axes[0])
    return canvas


def scaling(tables: Tables) -> Canvas:
    """Cost of a segment-step over the number of segments."""
    table = tables["scaling"]
    canvas, ax = style.subplots(2.6)
    ax.plot(table["segments"], table["ns_least"], **style.marked(0))
    ax.set(
        xscale="log",
        xlabel="number of segments, –",
        ylabel="cost per segment and step, ns",
        ylim=(0, 1.15 * table["ns_least"].max()),
    )
    style.plain_log_ticks(ax.xaxis)
    ax.set_xticks(table["segments"].to_list())
    return canvas


FIGURES = [
    Figure(
        "seconds",
        "Wall time of a simulated second of the curved chain, turning in contact (circles) or hanging free "
        "(squares), at each engine's own step (filled) and at the shortest of all steps (open). Same string and "
        "initial state, fastest of several rounds; nothing is extrapolated. The dashed line is real time. “In our "
        "loop”: another contact method in FCTD's loop, called from Python; without contact its query is empty.",
        seconds,
    ),
    Figure(
        "scaling",
        "FCTD's cost of one segment and step over the number of segments, in contact, fastest round. A level line "
        "means a cost proportional to the number of segments; in addition the stable step shrinks with the length of "
        "the segments.",
        scaling,
    ),
]
