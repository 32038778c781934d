"""Statements about the ways into a case and out of it: units, overrides, options, arguments, commands and files."""

import functools
import json
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from fctd.app.rows import Rows
from fctd.calibration.forward import Forward
from fctd.calibration.rows import Row as MeasuredRow
from fctd.case.key_quantities import quantities_of
from fctd.case.load import load_case
from fctd.case.operations import KINDS
from fctd.case.raw_case import parse_override
from fctd.model.operations import steady_rates
from fctd.steady.carried_shape import Carried
from fctd.steady.equilibrium import equilibrium
from fctd.steady.margins import Loaded
from fctd.steady.torque_drag import chart_rows
from tests.equivalence.answers import EXACT, ROUNDING, Answers, apart, base, changed, plain, same, some_kinds
from tests.equivalence.dice import Dice
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.table import applies, statement
from tests.strategies import toml, write_case

# Units whose text says what another unit is by a rounded number.
FIELD = ("ft", "in", "lbf", "klbf", "ft*lbf", "psi", "ksi", "ppg", "lb/ft", "gpm", "ft/min", "degF", "deg", "cP")


def in_units(raw: Raw, dice: Dice, only: tuple[str, ...] = ()) -> Raw:
    """The tables with every quantity as a text in a drawn unit of its dimension, of those in ``only`` where it can."""

    def text(key: str, value: Any) -> Any:
        if isinstance(value, bool | str) or not isinstance(value, int | float):
            return value
        found = quantities_of(key)
        if len({one.dimension.unit for one in found}) != 1:
            return value
        dimension = found[0].dimension
        units = [unit for unit in only if unit in dimension.units][:1] or list(dimension.units)
        unit = dice.pick(units)
        one = found[0].read(f"1 {unit}")
        return f"{value / one!r} {unit}"

    def rewrite(table: Any, key: str) -> Any:
        if isinstance(table, dict):
            return {name: rewrite(value, f"{key}.{name}" if key else name) for name, value in table.items()}
        if isinstance(table, list) and key not in ("wellbore.stations", "wellbore.caliper.rows"):
            return [rewrite(item, key) for item in table]
        return text(key, table)

    written: Raw = rewrite(raw, "")
    rows = written["wellbore"]["stations"]
    feet = dice.chance(0.5)
    written["wellbore"]["stations"] = [[f"{row[0] / 0.3048!r} ft" if feet else row[0], *row[1:]] for row in rows]
    return written


@statement("SI = field units = any unit of the table")
def units(drawn: Drawn) -> None:
    """Every quantity as a text, in units of the field or in any."""
    dice = drawn.dice(11)
    only = FIELD if dice.chance(0.4) else ()
    same(drawn, load_case(in_units(drawn.raw, dice, only)), ROUNDING)


@statement("a case = its file = its defaults written out")
def file_of_case(drawn: Drawn) -> None:
    """Tables as TOML, and the case that validation filled in."""
    if drawn.dice(12).chance(0.5):
        import tomllib

        same(drawn, load_case(tomllib.loads(write_case(drawn.raw))), EXACT)
    else:
        same(drawn, load_case(drawn.case.model_dump(exclude_none=True)), EXACT)


@statement("a key in the case = --set = override in Python")
def overrides(drawn: Drawn) -> None:
    """Some keys taken out of the tables and set again, as texts of the command line or as values."""
    dice = drawn.dice(13)
    keys = [key for key in flat(drawn.raw) if settable(key)]
    chosen = [dice.pick(keys) for _ in range(4)]
    typed = dict(parse_override(f"{key}={toml(flat(drawn.raw)[key])}") for key in chosen)
    values = {key: flat(drawn.raw)[key] for key in chosen}

    def remove(raw: Raw) -> None:
        for key in chosen:
            *path, last = key.replace("[", ".").replace("]", "").split(".")
            table: Any = raw
            for part in path:
                table = table[int(part)] if part.isdecimal() else table[part]
            if optional(key):
                table.pop(last, None)

    raw = json.loads(json.dumps(drawn.raw))
    remove(raw)
    same(drawn, load_case(raw, typed if dice.chance(0.5) else values), EXACT)


def flat(table: Any, prefix: str = "") -> dict[str, Any]:
    """Values by their dotted keys with indices; lists of numbers are values."""
    found: dict[str, Any] = {}
    items = table.items() if isinstance(table, dict) else enumerate(table)
    for name, value in items:
        key = f"{prefix}[{name}]" if isinstance(table, list) else f"{prefix}.{name}" if prefix else name
        tables = isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], dict))
        found |= flat(value, key) if tables else {key: value}
    return found


def settable(key: str) -> bool:
    """Whether a key can be set alone: readings of a viscometer and stations are set as a whole."""
    return ".fann." not in key and key != "wellbore.stations"


def optional(key: str) -> bool:
    """Whether a case without the key is read, and takes the key afterwards."""
    return key.startswith(("rig.", "bit.", "limits.", "datum."))


@statement("friction in the case = option = argument")
def friction_choice(drawn: Drawn) -> None:
    """One factor for all, a pair, or factors by kind."""
    dice = drawn.dice(14)
    along, around = dice.number(0.1, 0.4, 2), dice.number(0.1, 0.4, 2)
    by_kind = dice.chance(0.4) and all(row.kind for row in drawn.case.wellbore.intervals)
    pair = dice.chance(0.4)
    one: Any = f"{along}/{around}" if pair else along
    chosen: Any = {drawn.case.wellbore.intervals[0].kind: one} if by_kind else one

    def write(raw: Raw) -> None:
        for row in raw["wellbore"]["intervals"]:
            if by_kind and drawn.case.wellbore.intervals[0].kind != (row.get("kind") or "cased"):
                continue
            for key in ("rotational_friction", "static_friction", "decay_speed"):
                row.pop(key, None)
            row |= {"friction": along} | ({"rotational_friction": around} if pair else {})

    kind = dice.pick(list(KINDS))
    written = Answers(changed(drawn, write), drawn.depth)
    row = chart_rows(drawn.case, kind, drawn.depth, chosen, threads=1)[0]
    like_row(written, kind, row)
    set_case = load_case(drawn.raw, {"friction": chosen})
    like_row(written, kind, chart_rows(set_case, kind, drawn.depth, threads=1)[0])
    alone = equilibrium(drawn.case, kind, drawn.depth, friction=chosen)
    assert_equal("equilibrium", alone.hookload, row["hookload_N"])


def like_row(answers: Answers, kind: str, row: dict[str, Any]) -> None:
    """Raise AssertionError unless a row of a chart has the loads of a steady string to the bit."""
    point = answers[kind]
    assert str(point.status) == row["status"], f"{kind}: {point.status} and {row['status']}"
    for name, column in COLUMNS.items():
        value = getattr(point, name) if point.answered else math.nan
        assert_equal(f"{kind}: {column}", value, row[column])
    assert point.buckling.mode == row["buckling"]


COLUMNS = {
    "hookload": "hookload_N", "surface_torque": "surface_torque_N_m", "weight_indicator": "weight_indicator_N",
    "drive_torque": "drive_torque_N_m", "total_contact_force": "total_contact_force_N",
}  # fmt: skip


def assert_equal(what: str, one: float, other: float) -> None:
    """Raise AssertionError unless two numbers are the same, or none."""
    assert one == other or (math.isnan(one) and math.isnan(other)), f"{what} {one!r} and {other!r}"


@statement("row of a chart = equilibrium; order of rows (unbuckled)")
def chart_order(drawn: Drawn) -> None:
    """Operations in any order beside other depths, on one thread or several."""
    dice, answers = drawn.dice(15), base(drawn)
    kinds = sorted(KINDS, key=lambda _: dice.number(0, 1))
    depths = [drawn.depth - 60.0, drawn.depth - 13.0, drawn.depth]
    # A resolved row, which is seldom unbuckled, begins with the one above it.
    applies(all(answers[kind].buckling.mode == answers[kind].shape == "none" for kind in kinds))
    for row in chart_rows(drawn.case, kinds, depths, threads=dice.pick([1, 1, 2])):
        if row["bit_depth_m"] == drawn.depth:
            like_row(answers, row["operation"], row)


@statement("a chart kept and resumed = straight through")
def resumed(drawn: Drawn) -> None:
    """Rows of the first depths from another process, with the shapes of its last resolved rows."""
    dice = drawn.dice(17)
    kinds = [dice.pick(list(KINDS)), "trip_in"]
    depths = [drawn.depth - 60.0, drawn.depth - 13.0, drawn.depth]
    whole = chart_rows(drawn.case, kinds, depths, threads=1)
    kept: list[list[dict[str, Any]]] = []
    above: dict[str, Carried] = {}
    chart_rows(drawn.case, kinds, depths[: dice.whole(1, 2)], threads=1, above=above, keep=kept.append)
    rest = chart_rows(drawn.case, kinds, depths, threads=1, known=kept, above=above)
    equal_rows(whole, rest)


@functools.cache
def page() -> Rows:
    """The rows of a page, whose memory serves one case after the other."""
    return Rows()


@statement("row of the page = row of the chart")
def of_page(drawn: Drawn) -> None:
    """Those columns that a page draws; no resolved row begins with the shape of another depth."""
    kinds, depths = list(some_kinds(drawn)), [drawn.depth - 60.0, drawn.depth]
    found = page().solve(drawn.case, base(drawn).solver.hole, kinds, depths)
    rows = [row for depth in depths for row in chart_rows(drawn.case, kinds, depth, threads=1)]
    rows.sort(key=lambda row: kinds.index(row["operation"]))
    equal_rows(found, rows, but=("friction",))


def equal_rows(some: Sequence[dict[str, Any]], others: Sequence[dict[str, Any]], but: Sequence[str] = ()) -> None:
    """Raise AssertionError unless rows are equal to the bit, in the columns that the first ones have."""
    assert len(some) == len(others)
    for one, other in zip(some, others, strict=True):
        at = f"{one['operation']} at {one['bit_depth_m']}"
        for name, value in one.items():
            same_number = isinstance(value, float) and math.isnan(value) and math.isnan(other[name])
            equal = name in but or value == other[name] or same_number
            assert equal, f"{at}: {name} {value!r} and {other[name]!r}"


@statement("rates of the case = arguments")
def rates(drawn: Drawn) -> None:
    """Speed, rotation and flow of the case's operation, or of the call."""
    rows = {row["kind"]: row for row in drawn.raw.get("operations", [])}
    applies(rows)
    kind = drawn.dice(16).pick(sorted(rows))
    row, of = rows[kind], KINDS[kind]
    bare = {key: value for key, value in drawn.raw.items() if key != "operations"}
    given: dict[str, Any] = {"flow": row.get("flow", 0.0)}
    if of.direction:
        given["speed"] = row["speed"]
    applies(of.turns or not row.get("rpm"))  # by an option no trip turns
    if of.may_turn:
        given["rpm"] = row.get("rpm", 0.0)
    found = equilibrium(load_case(bare), kind, drawn.depth, **given)
    own = base(drawn)[kind]
    assert own.status == found.status
    if own.answered:  # where a string lies across its hole is that of the rotation of the case
        scale = base(drawn).weight
        loads = [{name: getattr(of, name) / scale for name in COLUMNS} for of in (own, found)]
        apart(*loads, ROUNDING, f"{kind}: ")


@statement("limits' loads = equilibrium")
def of_limits(drawn: Drawn) -> None:
    """What a margin begins with: the string of the operation with its own loads at the bit."""
    answers = base(drawn)
    applies(drawn.raw.get("solver", {}).get("buckling") is None and not drawn.has("helical_force"))
    for kind in ("trip_out", "trip_in", "rotate_off_bottom"):
        own = answers[kind]
        if not plain(own):
            continue
        free = Loaded(answers.solver, kind, steady_rates(drawn.case, kind), answers.laid).free
        if kind == "trip_out":
            held = changed(drawn, lambda raw: raw.get("bit", {}).pop("overpull", None) and None)
            own = Answers(held, drawn.depth)[kind]
        scale = answers.weight
        loads = [{"hook load": of.hookload / scale, "torque": of.surface_torque / scale} for of in (own, free)]
        apart(*loads, ROUNDING, f"{kind}: ")


@statement("calibrate's forward model = equilibrium")
def of_calibration(drawn: Drawn) -> None:
    """What the rig would read at the case's own values."""
    from fctd.calibration.setup import Setup

    answers = base(drawn)
    kinds = [kind for kind in ("trip_out", "trip_in", "rotate_off_bottom") if plain(answers[kind])]
    applies(kinds and not drawn.has("overpull"))
    rows = [measured(kind, drawn) for kind in kinds]
    forward = Forward(rows, {"": drawn.case}, [], Setup())
    found = forward.evaluate(np.zeros(0))
    for reading, value in zip(forward.readings, found.value, strict=True):
        own = answers[kinds[reading.row]]
        expected = own.weight_indicator if reading.load == "hookload" else own.drive_torque
        scale = answers.weight if reading.load == "hookload" else 0.1 * answers.weight
        apart({reading.load: expected / scale}, {reading.load: float(value) / scale}, ROUNDING, f"{own.operation}: ")


def measured(kind: str, drawn: Drawn) -> MeasuredRow:
    """A row of readings of an operation, of which the model computes what the rig reads."""
    return MeasuredRow(kind, "", drawn.depth, kind, steady_rates(drawn.case, kind))
