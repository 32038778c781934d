"""The sections of a report on what is computed: loads over depth, margins, profiles, mud, notes, versions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, Final

from fctd.case.load import Case
from fctd.case.message import frame_of
from fctd.case.operations import KINDS
from fctd.case.systems import told
from fctd.plots.chart import chart_figure
from fctd.plots.depth_panels import panels_figure
from fctd.plots.flow import losses_panels
from fctd.plots.loads import ChartLook
from fctd.plots.profile import profile_figure
from fctd.report.answers import Answers
from fctd.report.parts import Part, Picture, Section, Text
from fctd.results.columns import LOADS
from fctd.results.doing import told_of
from fctd.results.notes import MEANINGS
from fctd.results.series import FRICTION_LABEL
from fctd.results.shown_tables import NONE, Cell, Table, facts, frame_table, of_column, shown_table, text
from fctd.results.status import SteadyStatus
from fctd.results.unit_systems import System, in_words, shown
from fctd.steady.margins import FATIGUE, OVERPULL, SET_DOWN, SLIPS, TORQUE
from fctd.steady.steady_string import Equilibrium
from fctd.store.origin import versions

if TYPE_CHECKING:
    import pandas as pd

# Columns of the tables, with words for those whose names say too little.
CHART: Final = (
    "operation", FRICTION_LABEL, "bit_depth_m", "hookload_N", "weight_indicator_N", "surface_torque_N_m",
    "drive_torque_N_m", "total_contact_force_N", "buckling", "buckled_from_md_m", "buckled_to_md_m", "status",
)  # fmt: skip
CHART_WORDS: Final = {FRICTION_LABEL: "friction"}
_PLACE: Final = ("share_used", "bit_depth_m", "md_m", "part")
_PUSHED: Final = ("operation", "limit", "force_at_bit_N", "hookload_N", "hookload_left_N", *_PLACE)
MARGINS: Final = {
    OVERPULL: ("Pull on a stuck bit", _PUSHED),
    SET_DOWN: ("Weight on the bit", _PUSHED),
    SLIPS: ("Weight in the slips", _PUSHED),
    TORQUE: (
        "Torque at the bit",
        ("operation", "limit", "torque_at_bit_N_m", "surface_torque_N_m", "surface_torque_left_N_m", *_PLACE),
    ),
    FATIGUE: (
        "Bending to and fro of a string that turns",
        ("operation", "bending_stress_Pa", "cycles_per_hour", "bit_depth_m", "md_m", "part"),
    ),
}
MARGIN_WORDS: Final = {
    "limit": "until", "force_at_bit_N": "at the bit", "torque_at_bit_N_m": "at the bit", "hookload_N": "hook load",
    "surface_torque_N_m": "surface torque", "hookload_left_N": "left", "surface_torque_left_N_m": "left",
    "share_used": "share used", "md_m": "reached at", "part": "component",
}  # fmt: skip
LINES: Final = ("operation", "limit", "bit_depth_m", "hookload_N", "surface_torque_N_m", "md_m", "part")
PROFILE: Final = (
    "md_m", "inclination_deg", "effective_tension_N", "true_tension_N", "torque_N_m", "contact_force_N",
    "bending_moment_N_m", "von_mises_Pa", "offset_high_m", "offset_right_m", "clearance_m", "buckling",
)  # fmt: skip
PROFILE_WORDS: Final = {
    "contact_force_N": "side force", "offset_high_m": "offset to high side", "offset_right_m": "offset to right",
}  # fmt: skip
PUMPED: Final = (
    "bit_depth_m", "standpipe_Pa", "surface_drop_Pa", "bore_drop_Pa", "tool_drop_Pa", "bit_drop_Pa", "annulus_drop_Pa",
    "ecd_shoe_kg_m3", "ecd_bit_kg_m3", "bit_power_W", "impact_force_N", "jet_speed_m_s", "lift_N",
)  # fmt: skip
PUMPED_WORDS: Final = {
    "bit_depth_m": "bit", "standpipe_Pa": "standpipe", "surface_drop_Pa": "surface lines", "bore_drop_Pa": "bore",
    "tool_drop_Pa": "tools", "bit_drop_Pa": "bit", "annulus_drop_Pa": "annulus", "ecd_shoe_kg_m3": "ECD at shoe",
    "ecd_bit_kg_m3": "ECD at bit", "bit_power_W": "power at bit", "impact_force_N": "impact force",
    "jet_speed_m_s": "jets", "lift_N": "hook load less",
}  # fmt: skip
CIRCUIT: Final = ("part", "name", "from_md_m", "to_md_m", "pressure_drop_Pa", "speed_m_s", "regime", "ecd_kg_m3")
CIRCUIT_WORDS: Final = {
    "name": "component", "from_md_m": "from", "to_md_m": "to", "pressure_drop_Pa": "lost", "speed_m_s": "speed",
    "ecd_kg_m3": "ECD below",
}  # fmt: skip


def loads(found: Answers, look: ChartLook, units: System) -> Section:
    """The chart with its limits and measured rows, and both as tables."""
    chart, case = found.chart, found.case
    columns = list(CHART)
    if not case.rig.block_weight:
        columns.remove("weight_indicator_N")  # the hook load
    if not (case.rig.torque_offset or case.rig.torque_per_rpm):
        columns.remove("drive_torque_N_m")  # the surface torque
    if chart[FRICTION_LABEL].nunique() < 2:
        columns.remove(FRICTION_LABEL)
    drawn = "with limits" if found.lines is not None else ""
    drawn += (" and " if drawn else "with ") + "measured points" if look.measured is not None else ""
    parts: list[Part] = [
        *map(Text, told_of(case, found.rates, units)),
        Picture(f"Loads over bit depth {drawn}".strip(), chart_figure(chart, units, case, look)),
        frame_table("Loads over bit depth", chart, columns, units, CHART_WORDS, _buckled(chart)),
    ]
    if look.measured is not None:
        parts.append(frame_table("Measured rows", look.measured, list(map(str, look.measured)), units))
    return Section("Torque and drag", tuple(parts))


def _buckled(chart: pd.DataFrame) -> tuple[str, ...]:
    return () if chart["buckled_from_md_m"].notna().any() else ("No string is buckled.",)


def margins(found: Answers, units: System) -> Section:
    """How far the string is from its limits, at the bottom and over depth."""
    assert found.margins is not None  # the caller has asked for them
    table = found.margins
    parts: list[Part] = [
        Text(
            "For each operation a load at the bit grows until a limit is reached; each step of it is a steady string. "
            "Hook loads are those of the string alone, without the block."
        )
    ]
    for margin, (title, columns) in MARGINS.items():
        of = table[table["margin"] == margin]
        if len(of):
            parts.append(frame_table(title, of, columns, units, MARGIN_WORDS))
    reasons = table[(table["reason"] != "none")]
    if len(reasons):
        parts.append(frame_table("What else is to be known", reasons, ("operation", "limit", "reason"), units))
    if found.lines is not None:
        loaded = found.lines.dropna(how="all", subset=["hookload_N", "surface_torque_N_m"])
        parts.append(frame_table("Limits over bit depth", loaded, LINES, units, MARGIN_WORDS))
    return Section("Margins", tuple(parts))


def profiles(found: Answers, units: System) -> Section:
    """Strings at the deepest possible depth: picture, and loads."""
    points = found.points
    parts: list[Part] = [
        Picture("Profiles from the top to the bit", profile_figure(points, units)),
        _loads_of(points, units),
    ]
    return Section("Profiles", tuple(parts))


def _loads_of(points: Sequence[Equilibrium], units: System) -> Table:
    """A row for every load, a column for every operation."""
    rows = (
        (
            load.label, shown(load.name, units).label,
            *(of_column(load.name, load.value(point), units) if point.answered else None for point in points),
        )
        for load in LOADS
    )  # fmt: skip
    heads = ("load", "unit", *(KINDS[point.operation].label for point in points))
    status = "; ".join(f"{KINDS[point.operation].label}: {point.status.replace('_', ' ')}" for point in points)
    bit = in_words(points[0].bit_depth, "bit_depth_m", units)
    return shown_table(heads, rows, f"Loads with the bit at {bit}", (status,))


def mud(found: Answers, units: System) -> Section:
    """Pressures of mud that is pumped, by depth and by part of the circuit."""
    import pandas as pd  # slow to import

    last = found.circulations[-1]
    table = frame_of([one.summary() for one in found.circulations])
    flow = in_words(found.flow, "flow_m3_s", units)
    bit = in_words(last.laid.string.bit_depth, "bit_depth_m", units)
    panels = losses_panels(table, last, units, [f"{flow}; friction of API RP 13D, steady, of one temperature"])
    parts: tuple[Part, ...] = (
        Picture(f"Pressures and equivalent densities, {flow}", panels_figure(panels)),
        frame_table(f"Pressures over bit depth, {flow}", table, PUMPED, units, PUMPED_WORDS),
        frame_table(f"The circuit with the bit at {bit}", pd.DataFrame(last.parts()), CIRCUIT, units, CIRCUIT_WORDS),
    )
    return Section("Hydraulics", parts)


def notes(found: Answers, units: System) -> Section:
    """Rows of the chart that are not converged, and those with notes: at which depths, what it means, what to do."""
    rows = list(_exceptions(found.chart, units))
    if found.dry and found.flow > 0:
        rows.append((Cell("hydraulics"), Cell(NONE), text("not computed"), Cell(NONE), text(found.dry)))
    if not rows:
        return Section("Notes", (Text("All rows are converged, and none has a note."),))
    depth = shown("bit_depth_m", units).label
    heads = ("operation", "friction", "status or note", f"bit depths ({depth})", "what it means, and what to do")
    return Section("Notes", (Table("", heads, tuple(rows)),))


def _exceptions(chart: pd.DataFrame, units: System) -> Iterator[tuple[Cell, ...]]:
    metre = shown("bit_depth_m", units)
    for (operation, _), of in chart.groupby(["operation", FRICTION_LABEL], sort=False):
        who = Cell(KINDS[str(operation)].label), text(told(of[FRICTION_LABEL].iloc[0], units))
        found: list[tuple[str, Any, str]] = []
        for status, rows in of.groupby("status", sort=False):
            if status != SteadyStatus.CONVERGED:
                found.append((str(status), rows, told(rows["reason"].iloc[-1], units)))
        codes = of["notes"].str.split(", ")
        for code, meaning in MEANINGS.items():
            rows = of[codes.map(lambda has, code=code: code in has)]
            if len(rows):
                found.append((code, rows, f"{meaning.headline}: {meaning.remedy}"))
        for code, rows, words in found:
            depths = rows["bit_depth_m"] * metre.factor
            span = f"{depths.min():.0f}" if len(rows) == 1 else f"{depths.min():.0f} to {depths.max():.0f}"
            yield *who, text(code.replace("_", " ")), text(f"{span} ({len(rows)} of {len(of)})"), text(words)


def along(points: Sequence[Equilibrium], units: System) -> Section:
    """The profiles in numbers."""
    parts = tuple(
        frame_table(f"Profile, {KINDS[point.operation].label}", point.profile, PROFILE, units, PROFILE_WORDS)
        for point in points
        if point.answered
    )
    return Section("Profiles in numbers", parts or (Text("No string has loads at this depth."),))


def made_with(case: Case) -> Section:
    """Versions of the program and of what its numbers depend on, and a hash of the case."""
    return Section("Versions", (facts("", [*versions().items(), ("hash of the case with its survey", case.digest)]),))
