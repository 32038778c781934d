"""The sections of a report on what a case says: well, hole, string, fluids, friction, rig, assumptions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from fctd.calibration.predict import posterior_file, read_posterior
from fctd.calibration.unknowns import held
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
    LINEAR_MASS,
    PRESSURE,
    SPEED,
    STRESS,
    TEMPERATURE,
    TORQUE,
    Kind,
    System,
)
from fctd.model.capacity import Body
from fctd.model.operations import SteadyRates, rad_per_s
from fctd.model.section import section_of
from fctd.model.summary import Summary
from fctd.report.parts import Section, Text
from fctd.results.case_facts import Row, caliper_facts, fitting_facts, flow_curves, load_facts, path_facts
from fctd.results.shown_tables import NONE, Cell, Table, facts, number, short, text


def _cell(kind: Kind, value: float | None, units: System) -> Cell:
    """A value [SI], a dash for None."""
    return Cell(NONE) if value is None else number(value * kind.shown(units).factor, kind.digits_in(units))


def _facts(rows: Iterable[tuple[str, Kind, float | None, str]], units: System) -> list[tuple[Cell, ...]]:
    """Rows of a table of facts, of those that have a value: words, its kind, value [SI], and what else to say."""
    return [
        (text(words), _cell(of, value, units), text(f"{of.label(units)}{more}"))
        for words, of, value, more in rows
        if value is not None
    ]


def well(summary: Summary, units: System, company: str, by: str, date: str) -> Section:
    """General, datum, path."""
    case = summary.case
    survey = "stations in the case file" if case.wellbore.survey is None else case.wellbore.survey.name
    general: list[Row] = [
        ("well", case.name, ""), ("company", company, ""), ("prepared by", by, ""), ("date", date, ""),
        ("case file", "" if case.file is None else case.file.name, ""), ("survey", survey, ""),
        ("method", case.wellbore.survey_method.replace("_", " "), ""),
    ]  # fmt: skip
    return Section(
        "Well",
        (
            Table("General", (), tuple((text(what), text(value)) for what, value, _ in general if value)),
            _datum(case, units),
            facts("Path", path_facts(summary, units)),
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
    return Table("Datum", (), tuple(rows), (datum_of,))


def hole(case: Case, units: System) -> Section:
    """Intervals, caliper, window of densities."""
    depth, size = LENGTH.label(units), ACROSS.label(units)
    named = any(one.casing is not None for one in case.wellbore.intervals)
    heads = ("interval", "kind", f"from ({depth})", f"to ({depth})", f"diameter ({size})", *(["casing"] * named))
    rows, start = [], 0.0
    for k, one in enumerate(case.wellbore.intervals, start=1):
        ends = _cell(LENGTH, start, units), _cell(LENGTH, one.to_md, units)
        of_pipe = [text(one.casing or NONE)] * named
        rows.append((text(one.name or k), text(one.kind or NONE), *ends, _cell(ACROSS, one.diameter, units), *of_pipe))
        start = one.to_md
    parts = [Table("Intervals", heads, tuple(rows))]
    if case.wellbore.calipers is not None:
        parts.append(facts("Caliper", caliper_facts(case.wellbore.calipers, units)))
    if case.wellbore.window:
        density = DENSITY.label(units)
        of_window = (f"true vertical depth ({depth})", f"pore ({density})", f"fracture ({density})")
        window = tuple(
            (_cell(LENGTH, row.tvd, units), _cell(DENSITY, row.pore, units), _cell(DENSITY, row.fracture, units))
            for row in case.wellbore.window
        )
        parts.append(Table("Window of mud densities", of_window, window))
    return Section("Hole", tuple(parts))


def string(summary: Summary, units: System) -> Section:
    """Components from the top to the bit, what they bear, fittings, weights."""
    case, depth, size, force = summary.case, LENGTH.label(units), ACROSS.label(units), FORCE.label(units)
    inside = summary.parts
    components = case.string.components[: len(inside)][::-1]
    heads = (
        "component", f"from ({depth})", f"to ({depth})", f"outer diameter ({size})", f"inner diameter ({size})",
        f"contact diameter ({size})", f"mass ({LINEAR_MASS.label(units)})", f"in air ({force})", f"in mud ({force})",
    )  # fmt: skip
    rows = [
        (
            text(part.name), _cell(LENGTH, part.from_md, units), _cell(LENGTH, part.to_md, units),
            *(_cell(ACROSS, getattr(of, f"{which}_diameter"), units) for which in ("outer", "inner", "contact")),
            _cell(LINEAR_MASS, part.mass, units), _cell(FORCE, part.air, units), _cell(FORCE, part.buoyed, units),
        )
        for part, of in zip(inside, components, strict=True)
    ]  # fmt: skip
    bears = (
        "component", "pipe", f"yield strength ({STRESS.label(units)})", f"tension ({force})",
        f"torque ({TORQUE.label(units)})", f"make-up torque ({TORQUE.label(units)})",
        f"burst ({PRESSURE.label(units)})", f"collapse ({PRESSURE.label(units)})",
    )  # fmt: skip
    capacities = []
    for of in components:
        section = section_of(of, case.mud.density)
        body = Body(2 * section.outer, 2 * section.inner, section.yield_strength)
        capacities.append((
            text(of.name), text(of.pipe or NONE), _cell(STRESS, section.yield_strength, units),
            _cell(FORCE, body.tension, units), _cell(TORQUE, body.torsion, units),
            _cell(TORQUE, section.make_up, units), _cell(PRESSURE, section.burst, units),
            _cell(PRESSURE, section.collapse, units),
        ))  # fmt: skip
    note = "Of the body at yield, each load by itself; make-up torque is the largest that is recommended, where known."
    parts = [
        Table(f"String, the bit at {_cell(LENGTH, summary.bit_depth, units).text} {depth}", heads, tuple(rows)),
        Table("Capacities", bears, tuple(capacities), (note,)),
    ]
    if rows_of := fitting_facts(case, units):
        parts.append(facts("Fittings", rows_of))
    parts.append(facts("Weights", load_facts(summary, units)))
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
    rows = [*_facts(given, units), (text("lower end"), Cell(""), text(case.end))]
    rows += facts("", flow_curves(mud, units)).rows
    lacks = mud.curve is None and not any(row.curve is not None for row in (*mud.inside, *mud.outside))
    notes = ("The case gives no rheology: steady loads do not depend on it without flow.",) if lacks else ()
    parts.append(Table("Mud", (), tuple(rows), notes))
    if mud.fann is not None and mud.fit is not None:
        readings = ("rev/min", "read (degrees)", "fitted (degrees)")
        pairs = zip(mud.fann.items(), mud.fit.misfit, strict=True)
        read = tuple((short(speed), short(value), number(value + miss, 1)) for (speed, value), miss in pairs)
        parts.append(Table("Viscometer", readings, read))
    sides = [(side, row) for side in ("inside", "outside") for row in getattr(mud, side)]
    if sides:
        heads = ("side", f"down to ({LENGTH.label(units)})", f"density ({DENSITY.label(units)})", "plug below")
        by_depth = tuple(
            (
                text(side), _cell(LENGTH, row.to_md, units), _cell(DENSITY, row.density, units),
                text("yes" if getattr(row, "plug", False) else NONE),
            )
            for side, row in sides
        )  # fmt: skip
        parts.append(Table("Fluids by depth", heads, by_depth))
    if case.temperature:
        warmer = (f"true vertical depth ({LENGTH.label(units)})", f"change ({TEMPERATURE.label(units)})")
        changes = tuple(
            (_cell(LENGTH, row.tvd, units), _cell(TEMPERATURE, row.change, units)) for row in case.temperature
        )
        parts.append(Table("Change of temperature", warmer, changes))
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
    rows = []
    for k, unknown in enumerate(posterior.unknowns):
        now = held(unknown.name, case)
        spread = math.sqrt(float(posterior.covariance[k, k]))
        found = short(float(posterior.best[k])), short(spread, 2), short(float(now[0])) if now else Cell(NONE)
        rows.append((text(unknown.name), *found, text(unknown.unit)))
    yield Table("Calibration", ("unknown", "calibrated", "standard deviation", "in this case", "unit"), tuple(rows))


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
        (text(words), short(value), text(more))
        for words, value, more in (
            ("sheave efficiency", of.sheave_efficiency, ""),
            ("design factor", limits.design_factor, "of tension, stress and pressure"),
            ("share of the make-up torque", limits.torque_share, "that may be used"),
        )
    ]
    return Section("Rig and limits", (Table("", (), tuple(rows)),))


def assumptions(
    case: Case, rates: Mapping[str, SteadyRates], drive: Mapping[str, Any], segments: str, warnings: Sequence[str],
    units: System,
) -> Section:  # fmt: skip
    """What the numbers rest on: the model, rates with their origin, probable mistakes of the input.

    drive : rates of the command; segments : how the string is cut, in words; warnings : in sentences, in the units.
    """
    hole_of, contact = case.wellbore, case.contact
    stiffness = (
        f"{hole_of.stiffness:.3g} N/m at a contact" if hole_of.stiffness is not None
        else f"{hole_of.stiffness_per_length:.3g} N/m for each metre"
    )  # fmt: skip
    lies = "0, concentric" if case.mud.eccentricity == 0 else str(case.mud.eccentricity)
    chosen: list[tuple[str, str, Any, str]] = [
        ("friction law", contact.friction_law, contact, "friction_law"),
        ("shape of the hole", hole_of.geometry, hole_of, "geometry"),
        ("stiffness of the wall", stiffness, hole_of, "stiffness" if hole_of.stiffness else "stiffness_per_length"),
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
    """Speed, rotation and flow of each operation, and where they are from."""
    own = {operation.kind for operation in case.operations}
    given = any(value is not None for value in drive.values())
    rows = tuple(
        (
            Cell(KINDS[kind].label), _cell(SPEED, abs(rate.speed), units), number(rate.spin / rad_per_s(1.0), 1),
            _cell(FLOW, rate.flow, units), text("options, else " * given + ("case" if kind in own else "default")),
        )
        for kind, rate in rates.items()
    )  # fmt: skip
    heads = ("operation", f"speed ({SPEED.label(units)})", "rotation (rev/min)", f"flow ({FLOW.label(units)})", "from")
    return Table("Rates", heads, rows)
