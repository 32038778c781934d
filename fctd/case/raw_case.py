"""A case as it is written: nested tables before validation, their dotted keys, overrides, and what is wrong in them."""

import copy
import os
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from fctd.case.errors import MISSING, InputError, join_key, naming
from fctd.case.friction import pick, split_factor
from fctd.case.input_file import read_toml
from fctd.case.named_items import by_index
from fctd.case.operation_names import kind_named
from fctd.case.text import is_utf8

# Keys of files: their names need not be UTF-8, and a typed one is relative to the current folder.
FRICTION: Final = "friction", "rotational_friction"
FILE_KEYS: Final = "wellbore.survey", "wellbore.caliper.log"


def split_key(key: str) -> list[str | int]:
    """ "operations[0].speed" or "operations.0.speed" as ["operations", 0, "speed"]; "" as [].

    Raises InputError for a text that is not a dotted key.
    """
    if not re.fullmatch(r"(?:(?:^|\.)[\w-]+|\[[0-9]+\])*", key):
        raise InputError("a dotted key such as wellbore.overlap or operations[0].speed", value=key)
    parts = re.findall(r"[\w-]+", key)
    return [int(part) if re.fullmatch("[0-9]{1,9}", part) else part for part in parts]


def look_up(data: Any, *parts: str | int) -> object:
    """The value down a path of nested dicts and lists; MISSING where there is none or None."""
    for part in parts:
        if not _has_item(data, part):
            return MISSING
        data = data[part]
    return MISSING if data is None else data


def set_key(table: dict[str, Any], key: str, value: object) -> None:
    """Set a dotted key of nested dicts and lists; tables on the way are made, list items are not.

    None in a table counts as absent (`known_keys`); for an item of a list it removes the item.
    Raises InputError for a key whose table or list item does not exist.
    """
    *parents, last = split_key(key) or [key]
    place: Any = table
    items = ""
    for part in parents:
        if isinstance(place, dict) and place.get(part) is None:
            place[part] = {}
        if isinstance(place, list) and place and not _has_item(place, part):
            items = f", the items are counted from 0 to {len(place) - 1}"
        place = place[part] if _has_item(place, part) else None
    if isinstance(place, list) and isinstance(last, int) and last < len(place) and value is None:
        del place[last]
    elif isinstance(place, dict) or _has_item(place, last):
        place[last] = copy.deepcopy(value)
    else:
        raise InputError(f"a value for a key that exists{items}", key=key, value=value)


def _has_item(data: Any, part: str | int) -> bool:
    """Whether a dict or list has this key or index."""
    if isinstance(data, list | tuple):
        return isinstance(part, int) and part < len(data)
    return isinstance(data, Mapping) and part in data


def parse_override(text: str) -> tuple[str, Any]:
    """Key and value of "key=value": a TOML value, else a plain string, or None where the value is empty.

    Raises InputError for a text of another form.
    """
    key, sign, written = (part.strip() for part in text.partition("="))
    if not (key and sign):
        raise InputError("key=value", value=text)
    if not written:
        return key, None
    if key not in FILE_KEYS and not is_utf8(written):  # only file names need not be UTF-8
        raise InputError("a value in UTF-8", key=key, value=written)
    try:
        table = tomllib.loads(f"value = {written}")
    except (ValueError, RecursionError):
        return key, written
    return key, table["value"] if table.keys() == {"value"} else written


def apply_override(raw: dict[str, Any], key: str, value: Any) -> None:
    """Set or delete one dotted key of an unvalidated case, in which a component or an interval may have its name."""
    key = by_index(raw, key)
    name, _, kind = key.partition(".")
    if name in FRICTION:  # of all intervals or those of a kind, "friction.open"
        for i, factor in _of_intervals(raw, {kind: value} if kind else value):
            if name == "friction":
                _set_friction(raw, i, factor)
            else:
                set_key(raw, f"wellbore.intervals[{i}].{name}", factor)
    elif key in FILE_KEYS and isinstance(value, str | os.PathLike) and os.path.exists(value):
        set_key(raw, key, os.path.abspath(value))  # a typed path is relative to the current folder
    else:
        set_key(raw, key, value)


def interval_kinds(raw: Mapping[str, Any]) -> list[object]:
    """The kind of each interval, MISSING without one; casing of the catalogue is cased, as validation fills it in."""
    intervals = look_up(raw, "wellbore", "intervals")
    if not isinstance(intervals, list):
        return []
    kinds = [look_up(interval, "kind") for interval in intervals]
    cased = [look_up(interval, "casing") is not MISSING for interval in intervals]
    return ["cased" if kind is MISSING and of else kind for kind, of in zip(kinds, cased, strict=True)]


def _of_intervals(raw: Mapping[str, Any], value: Any) -> Iterator[tuple[int, Any]]:
    """Index of each interval that a factor for all, or factors by kind, are of, and its factor."""
    kinds = interval_kinds(raw)
    if not isinstance(value, Mapping):
        yield from enumerate([value] * len(kinds))
        return
    picked = pick(value, kinds)
    yield from ((i, factor) for i, factor in enumerate(picked) if factor is not None)


def _set_friction(raw: dict[str, Any], i: int, factor: object) -> None:
    """Set the kinetic factors of an interval, and scale its static one along."""
    at, interval = f"wellbore.intervals[{i}]", look_up(raw, "wellbore", "intervals", i)
    try:
        along, around = split_factor(factor)
    except InputError as error:
        raise InputError(error.expected, key="friction", value=factor) from None
    static = scaled_static(interval, along)
    set_key(raw, f"{at}.friction", along)
    if around is not None or look_up(interval, "rotational_friction") is not MISSING:
        set_key(raw, f"{at}.rotational_friction", around)
    if static is not MISSING:
        set_key(raw, f"{at}.static_friction", static)


def scaled_static(interval: object, factor: object) -> object:
    """The static factor of an unvalidated interval, scaled to a new kinetic factor; MISSING without one."""
    kinetic, static = (look_up(interval, key) for key in ("friction", "static_friction"))
    if not all(isinstance(value, int | float) for value in (kinetic, static, factor)) or not kinetic:
        return static  # where one of them is no number, validation says so
    return static * factor / kinetic  # type: ignore[operator]


def without_stations(raw: Mapping[str, Any]) -> dict[str, Any]:
    """A case without the long list that it may have."""
    hole = look_up(raw, "wellbore")
    return {**raw, "wellbore": {**hole, "stations": None}} if isinstance(hole, dict) else dict(raw)


# Tables of a case, the keys of lengths in them that say nothing of steps or tolerances, and units of the field.
_LENGTHS: Final = {
    ("wellbore", "intervals"): ("to_md", "diameter"),
    ("string", "components"): (
        "length", "outer_diameter", "inner_diameter", "contact_diameter", "segment_length",
    ),
    ("operations",): ("at_md", "from_md", "to_md"),
    ("rig",): ("stand_length", "derrick_height", "slip_length", "surface_length", "surface_bore"),
}  # fmt: skip
_FIELD: Final = re.compile(r"(?:ft|feet|foot|in|inch|inches|'|\"|″|′)\.?\s*$", re.IGNORECASE)


def bare_lengths(raw: Mapping[str, Any]) -> list[str]:
    """Keys of lengths without a unit, where most lengths are in feet and inches and none in SI."""
    bare, field_units = [], 0
    for path, keys in _LENGTHS.items():
        found = look_up(raw, *path)
        tables = {join_key(*path, i): of for i, of in enumerate(found)} if isinstance(found, list) else {path[0]: found}
        for place, table in tables.items():
            for key in keys:
                value = look_up(table, key)
                if isinstance(value, str) and not _FIELD.search(value):
                    return []
                field_units += isinstance(value, str)
                if isinstance(value, int | float) and value:
                    bare.append(f"{place}.{key}")
    stations = look_up(raw, "wellbore", "stations")
    depths = [look_up(station, 0) for station in stations] if isinstance(stations, list) else []
    if any(isinstance(depth, int | float) and depth for depth in depths):
        bare.append("wellbore.stations")
    return bare if len(bare) < field_units else []


def with_bare_lengths(error: InputError, raw: Mapping[str, Any]) -> InputError:
    """The error, with the lengths that may be its cause: the rule that they break names another key."""
    said = [error.key, *(other.key for other in error.more)]
    more = [
        InputError(
            "a length with its unit: bare, it is in metres, and the other lengths are in feet and inches",
            key=key,
            value=look_up(raw, *split_key(key)),
        )
        for key in bare_lengths(raw)
        if key not in said
    ]
    return InputError(error.expected, key=error.key, value=error.value, more=[*error.more, *more])


_EXPECTED: Final = {
    "missing": "a bare number",  # inside a list of fixed length: tables check their keys themselves
    "too_long": "at most {max_length} values",
    "tuple_type": "a list",
    "dict_type": "a table of keys and values",
    "model_type": "a table of keys and values",
    "model_attributes_type": "a table of keys and values",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "string_type": "a text in quotes",
    "path_type": "a file name in quotes",
}


Model = TypeVar("Model", bound=BaseModel)


def read_model(model: type[Model], path: Path, what: str, context: Mapping[str, Any] | None = None) -> Model:
    """The tables of a TOML file as a model; what : the file in messages, as "a setup".

    Raises InputError, which names file, key and value.
    """
    with naming(path):
        return checked(model, read_toml(path, what), context)


def checked(model: type[Model], raw: object, context: Mapping[str, Any] | None = None) -> Model:
    """Tables as a model; raises InputError with the first problem, and the others in its `more`."""
    try:
        return model.model_validate(raw, context=context)
    except ValidationError as failure:
        raise _explained(failure, raw) from None


def _explained(failure: ValidationError, raw: object) -> InputError:
    written: list[InputError] = []
    derived: list[InputError] = []
    for detail in failure.errors(include_url=False):
        parts = list(_written_parts(detail["loc"], raw))
        error = _from_detail(detail)
        # A default computed from a bad value is bad too; the line of the bad value is enough.
        follows = error.value is not MISSING and look_up(raw, *parts) is MISSING
        uncalled = detail["type"] == "default_factory_not_called"
        (derived if follows or uncalled else written).append(error.at(join_key(*parts)))
    first, *more = written or derived
    return InputError(first.expected, key=first.key, value=first.value, more=more)


def _written_parts(path: Sequence[str | int], raw: object) -> Iterator[str | int]:
    """The parts of pydantic's path without the members of unions: the kind of a table, a type where no table stands."""
    place = raw
    for part in path:
        kind = place.get("kind") if isinstance(place, Mapping) else MISSING
        of_union = part in (kind, kind_named(kind)) if isinstance(place, Mapping) else place is not MISSING
        if isinstance(part, int) or not of_union:
            yield part
            place = look_up(place, part)


def _from_detail(detail: ErrorDetails) -> InputError:
    """One problem; its key is relative to the table that pydantic validated."""
    written, context = detail["input"], detail.get("ctx", {})
    error = context.get("error")
    if isinstance(error, InputError):
        # A rule across keys names only the key: the value is read from the table.
        value = look_up(written, *split_key(error.key)) if error.value is MISSING else error.value
        return InputError(error.expected, key=error.key, value=value)
    expected = _EXPECTED.get(detail["type"], detail["msg"].removeprefix("Input should be "))
    if detail["type"] == "tuple_type" and isinstance(written, Mapping):
        expected = "a list of tables, the name of each in double brackets: [[name]]"
    value = MISSING if detail["type"] == "missing" else written
    return InputError(expected.format(**context), value=value)
