"""The sections of a report on what a case says: well, hole, string, fluids, friction, rig, assumptions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from fctd.calibration.predict import posterior_file, read_posterior
from fctd.calibration.unknowns import held
from fctd.case import message
from fctd.case.friction import FrictionSet
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.systems import (
    ACROSS,
    AREA,
    DENSITY,
    FLOW,
    FORCE,
    LENGTH,
    PRESSURE,
    ROTATION,
    SPEED,
    STRESS,
    TEMPERATURE,
    TORQUE,
    Kind,
    System,
    signed,
    told,
)
from fctd.model.operations import SteadyRates
from fctd.model.section import bearing, section_of
from fctd.model.summary import Summary
from fctd.report.parts import Section, Text
from fctd.results.case_facts import (
    caliper_facts,
    fitting_facts,
    flow_curves,
    hole_table,
    load_facts,
    path_facts,
    string_table,
)
from fctd.results.doing import does, unlike
from fctd.results.shown_tables import (
    NONE,
    Cell,
    Fact,
    Head,
    Table,
    facts,
    number,
    quantities,
    quantity,
    short,
    shown_table,
    text,
)


def _facts(rows: Iterable[tuple[str, Kind, float | None, str]], units: System) -> list[Fact]:
    """Facts of those quantities that have a value: words, kind, value [SI], and what else to say."""
    return [
        (words, quantity(of, value, units), f"{of.label(units)}{more}")
        for words, of, value, more in rows
        if value is not None
    ]


def well(summary: Summary, units: System, company: str, by: str, date: str) -> Section:
    """General, datum, path."""
    case = summary.case
    survey = "stations in the case file" if case.wellbore.survey is None else case.wellbore.survey.name
    general = {
        "well": case.name, "company": company, "prepared by": by, "date": date,
        "case file": "" if case.file is None else case.file.name, "survey": survey,
        "method": case.wellbore.survey_method.replace("_", " "),
    }  # fmt: skip
    return Section(
        "Well",
        (
            facts("General", ((what, value) for what, value in general.items() if value)),
            _datum(case, units),
            path_facts(summary, units),
        ),
    )


def _datum(case: Case, units: System) -> Table | Text:
    datum = case.datum
    rows = _facts(
        [
            ("rotary table", LENGTH, datum.elevation, " above mean sea level"),
            ("air gap", LENGTH, datum.air_gap, " from the sea to the rotary table"),
            ("water depth", LENGTH, datum.water_depth, ""),
            ("sea bed", LENGTH, datum.sea_bed, " below the rotary table"),
        ],
        units,
    )
    datum_of = "Depths count from the rotary table downwards."
    if not rows:
        return Text(f"{datum_of} The case does not give its elevation (table [datum]).")
    return replace(facts("Datum", rows), notes=(datum_of,))


def hole(case: Case, units: System) -> Section:
    """Intervals, caliper, window of densities."""
    parts = [hole_table(case, units, casings=any(one.casing is not None for one in case.wellbore.intervals))]
    if case.wellbore.calipers is not None:
        parts.append(caliper_facts(case.wellbore.calipers, units))
    if case.wellbore.window:
        of_window = ("true vertical depth", LENGTH), ("pore", DENSITY), ("fracture", DENSITY)
        window = [(row.tvd, row.pore, row.fracture) for row in case.wellbore.window]
        parts.append(quantities("Window of mud densities", of_window, window, units))
    return Section("Hole", tuple(parts))


def string(summary: Summary, units: System) -> Section:
    """Components from the top to the bit, what they bear, fittings, weights."""
    case = summary.case
    bears = (
        ("component", None), ("pipe", None), ("yield strength", STRESS), ("tension", FORCE), ("torque", TORQUE),
        ("make-up torque", TORQUE), ("burst", PRESSURE), ("collapse", PRESSURE),
    )  # fmt: skip
    capacities = []
    for of in case.string.components[: len(summary.parts)][::-1]:
        section = section_of(of, case.mud.density)
        body = bearing(section)
        most = body.tension, body.torsion, section.make_up, section.burst, section.collapse
        capacities.append((of.name, of.pipe, section.yield_strength, *most))
    note = "Of the body at yield, each load by itself; make-up torque is the largest that is recommended, where known."
    title = f"String, the bit at {quantity(LENGTH, summary.bit_depth, units).text} {LENGTH.label(units)}"
    parts = [
        replace(string_table(summary, units, sizes=True), title=title),
        quantities("Capacities", bears, capacities, units, (note,)),
    ]
    if (fittings := fitting_facts(case, units)).rows:
        parts.append(fittings)
    # The screen has the units of weights as people type them.
    weights = tuple((what, value, text(signed(more.text))) for what, value, more in load_facts(summary, units).rows)
    parts.append(Table("Weights", (), weights))
    return Section("String", tuple(parts))


def fluids(case: Case, units: System) -> Section:
    """Densities, flow curves, readings, fluids by depth, temperature, nozzles."""
    mud, parts = case.mud, []
    given = [
        ("mud density", DENSITY, None if mud.given else mud.density, "" if mud.density else ", air"),
        ("pressure inside at surface", PRESSURE, mud.inside_pressure or None, ""),
        ("pressure outside at surface", PRESSURE, mud.outside_pressure or None, ""),
        ("total flow area of the nozzles", AREA, case.bit.nozzle_area or None, ""),
    ]
    known = facts("Mud", [*_facts(given, units), ("lower end", Cell(""), case.end)])
    lacks = mud.curve is None and not any(row.curve is not None for row in (*mud.inside, *mud.outside))
    notes = ("The case gives no rheology: steady loads do not depend on it without flow.",) if lacks else ()
    parts.append(replace(known, rows=known.rows + flow_curves(mud, units).rows, notes=notes))
    if mud.fann is not None and mud.fit is not None:
        pairs = zip(mud.fann.items(), mud.fit.misfit, strict=True)
        read = ((short(speed), short(value), number(value + miss, 1)) for (speed, value), miss in pairs)
        parts.append(shown_table(["rev/min", Head("read", "degrees"), Head("fitted", "degrees")], read, "Viscometer"))
    sides = [(side, row) for side in ("inside", "outside") for row in getattr(mud, side)]
    if sides:
        heads = ("side", None), ("down to", LENGTH), ("density", DENSITY), ("plug below", None)
        by_depth = [
            (side, row.to_md, row.density, "yes" if getattr(row, "plug", False) else None) for side, row in sides
        ]
        parts.append(quantities("Fluids by depth", heads, by_depth, units))
    if case.temperature:
        warmer = ("true vertical depth", LENGTH), ("change", TEMPERATURE)
        changes = [(row.tvd, row.change) for row in case.temperature]
        parts.append(quantities("Change of temperature", warmer, changes, units))
    return Section("Fluids", tuple(parts))


def friction(case: Case, given: Sequence[FrictionSet]) -> Section:
    """The factors of a case, and where they are from.

    given : sets of the command, of which the case has the first.
    """
    static = any(one.static_friction is not None for one in case.wellbore.intervals)
    heads = ("interval", "kind", "along", "around", *(["at rest"] * static))
    rows = tuple(
        (
            text(one.name or k), text(one.kind or NONE), short(one.friction), short(one.friction_around),
            *([short(one.friction if one.static_friction is None else one.static_friction)] * static),
        )
        for k, one in enumerate(case.wellbore.intervals, start=1)
    )  # fmt: skip
    own = tuple(
        (text(part.name), text(part.repeat_key.replace("_", " ")), short(part.fittings.friction))
        for part in case.string.components
        if part.fittings is not None and part.fittings.friction is not None
    )
    parts: list[Any] = [Table("Factors by interval", heads, rows), *_origin(case, given)]
    if own:
        parts.append(Table("Own factors of fittings", ("component", "fittings", "friction"), own))
    return Section("Friction", tuple(parts))


def _origin(case: Case, given: Sequence[FrictionSet]) -> Iterator[Text | Table]:
    """Where the factors are from; raises InputError for a posterior beside the case that cannot be read."""
    if given:
        labels = "; ".join(one.label for one in given)
        first = ", of which the first is used outside the chart" if len(given) > 1 else ""
        yield Text(f"Factors of the option --friction, in place of those of the case: {labels}{first}.")
        return
    beside = None if case.file is None else posterior_file(case.file)
    if beside is None or not beside.is_file():
        yield Text("Factors of the case file. No calibration lies beside it, so that they are assumed.")
        return
    posterior = read_posterior(beside)
    yield Text(f"Calibrated by fctd calibrate: {beside.name}.")
    rows = (
        (
            unknown.name, short(float(posterior.best[k])), short(math.sqrt(float(posterior.covariance[k, k])), 2),
            short(float(now[0])) if (now := held(unknown.name, case)) else None, unknown.unit,
        )
        for k, unknown in enumerate(posterior.unknowns)
    )  # fmt: skip
    heads = "unknown", "calibrated", "standard deviation", "in this case", "unit"
    yield shown_table(heads, rows, "Calibration")


def rig(case: Case, units: System) -> Section:
    """What the rig adds and bears, loads at the bit, how much of the string may be used."""
    of, bit, limits = case.rig, case.bit, case.limits
    given = [
        ("block weight", FORCE, of.block_weight or None, ", added to the hook load"),
        ("friction of the guides", FORCE, of.guide_friction or None, ""),
        ("hoist capacity", FORCE, of.hoist_capacity, ", block included"),
        ("largest torque of the drive", TORQUE, of.largest_torque, ""),
        ("torque offset", TORQUE, of.torque_offset or None, ""),
        ("slip length", ACROSS, of.slip_length, ""),
        ("weight on bit", FORCE, bit.weight_on_bit, " while drilling"),
        ("bit torque", TORQUE, bit.torque, " while drilling"),
        ("overpull of a stuck bit", FORCE, bit.overpull or None, ""),
        ("overpull to be left", FORCE, limits.overpull_margin or None, " at the hook"),
    ]
    rows = _facts(given, units)
    rows += [
        (words, short(value), more)
        for words, value, more in (
            ("sheave efficiency", of.sheave_efficiency, ""),
            ("design factor", limits.design_factor, "of tension, stress and pressure"),
            ("share of the make-up torque", limits.torque_share, "that may be used"),
        )
    ]
    return Section("Rig and limits", (facts("", rows),))


def assumptions(
    case: Case, rates: Mapping[str, SteadyRates], drive: Mapping[str, Any], segments: str, warnings: Sequence[str],
    units: System,
) -> Section:  # fmt: skip
    """What the numbers rest on: the model, rates with their origin, probable mistakes of the input.

    drive : rates of the command; segments : how the string is cut, in words; warnings : in sentences, in the units.
    """
    hole_of, contact = case.wellbore, case.contact
    stiffness = (
        f"{message.quantity(hole_of.stiffness, 'N/m', '.3g')} at a contact" if hole_of.stiffness is not None
        else message.quantity(hole_of.stiffness_per_length or 0.0, "N/m/m", ".3g")
    )  # fmt: skip
    lies = "0, concentric" if case.mud.eccentricity == 0 else str(case.mud.eccentricity)
    chosen: list[tuple[str, str, Any, str]] = [
        ("friction law", contact.friction_law, contact, "friction_law"),
        ("shape of the hole", hole_of.geometry, hole_of, "geometry"),
        (
            "stiffness of the wall",
            told(message.Message(stiffness), units),
            hole_of,
            "stiffness" if hole_of.stiffness else "stiffness_per_length",
        ),
        ("where the string buckles", case.solver.buckling, case.solver, "buckling"),
        ("eccentricity of the pipe in the annulus", lies, case.mud, "eccentricity"),
    ]
    rows = [
        (text(what), text(value.replace("_", " ")), text("case" if key in of.model_fields_set else "default"))
        for what, value, of, key in chosen
    ]
    rows.append((text("segments"), text(segments), text(_cut(case))))
    model = (
        "Steady strings: inertia, jars and shocks are left out. The string is a chain of rigid segments with the "
        "stiffness of the pipe at its joints, and touches the wall at the ends of its segments."
    )
    parts: list[Any] = [
        Text(model),
        Table("Model", ("assumption", "value", "from"), tuple(rows)),
        _rates(case, rates, drive, units),
    ]
    found = tuple((text(warning),) for warning in warnings)
    parts.append(Table("Probable mistakes of the input", ("warning",), found) if found else Text("No warnings."))
    return Section("Assumptions", tuple(parts))


def _cut(case: Case) -> str:
    return "default" if any(part.cut_by_default for part in case.string.components) else "case"


def _rates(case: Case, rates: Mapping[str, SteadyRates], drive: Mapping[str, Any], units: System) -> Table:
    """What the string does in each operation, where that is from, and what they differ in."""
    own = {operation.kind for operation in case.operations}
    given = "options, else " * any(value is not None for value in drive.values())

    def source(kind: str) -> str:
        lent = rates[kind].flow and drive.get("flow") is None
        return given + ("case" if kind in own else "default, flow of the case" if lent else "default")

    acts = {kind: does(case, kind, rate) for kind, rate in rates.items()}
    rows = (
        (
            KINDS[kind].label, of["speed_m_s"], number(of["rpm"], 1), of["flow_m3_s"], of["weight_on_bit_N"],
            source(kind),
        )
        for kind, of in acts.items()
    )  # fmt: skip
    heads = (
        ("operation", None), ("speed", SPEED), ("rotation", ROTATION), ("flow", FLOW), ("weight on bit", FORCE),
        ("from", None),
    )  # fmt: skip
    return quantities("Rates", heads, rows, units, tuple(unlike(case, rates, units)))
