"""The case as it is written: dotted keys, and overrides."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.calibration.setup import read_setup
from fctd.case.errors import MISSING, InputError, join_key
from fctd.case.load import load_case
from fctd.case.raw_case import look_up, parse_override, set_key, split_key
from fctd.sweep.spec import read_sweep
from tests.case.test_load import refusal

# --- keys ------------------------------------------------------------------------------------------

names = st.text("abcdefghijklmnopqrstuvwxyz_", min_size=1, max_size=8)


@given(parts=st.lists(st.tuples(names, st.lists(st.integers(0, 99), max_size=2)), min_size=1, max_size=4))
def test_a_key_is_split_as_it_was_joined(parts: list[tuple[str, list[int]]]) -> None:
    path = [part for name, indices in parts for part in (name, *indices)]
    assert split_key(join_key(*path)) == path
    assert split_key(".".join(map(str, path))) == path


def test_keys_by_hand() -> None:
    assert join_key("operations", 0, "speed") == "operations[0].speed"
    assert join_key("string", "components[1].length") == "string.components[1].length"
    assert join_key("operations", "") == "operations"
    assert (join_key(), split_key("")) == ("", [])


def test_setting_and_looking_up() -> None:
    """Tables on the way are made, items of lists are not; what is set is a copy."""
    data: dict[str, Any] = {"parts": [{"length": 1}, {"length": 2}]}
    value = [3]
    set_key(data, "parts[1].length", value)
    set_key(data, "mud.density", 1200)
    value.append(4)
    assert data == {"parts": [{"length": 1}, {"length": [3]}], "mud": {"density": 1200}}
    assert look_up(data, "parts", 1, "length") == [3]
    assert look_up(data, "parts", 2, "length") is look_up(data, "mud", "colour") is MISSING
    set_key(data, "parts[0]", None)
    assert data["parts"] == [{"length": [3]}]
    with pytest.raises(InputError, match="a value for a key that exists, the items are counted from 0 to 0"):
        set_key(data, "parts[1].length", 3)


# --- overrides -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("overrides", "read", "value"),
    [
        ({"operations[0].speed": "60 ft/min"}, ["operations", 0, "speed"], 0.3048),
        ({"operations.0.speed": "60 ft/min"}, ["operations", 0, "speed"], 0.3048),
        # An optional table is made.
        ({"mud.density": "1.2 sg"}, ["mud", "density"], 1200.0),
        # None deletes, so that alternatives can be switched.
        (
            {"string.components[0].segments": None, "string.components[0].segment_length": "5 m"},
            ["string", "components", 0, "segment_length"], 5.0,
        ),
        # The friction of every interval; numpy's numbers.
        ({"friction": 0.17}, ["wellbore", "intervals", 0, "friction"], 0.17),
        ({"friction": np.float64(0.25)}, ["wellbore", "intervals", 1, "friction"], 0.25),
        ({"string.components[0].segments": np.int64(7)}, ["string", "components", 0, "segments"], 7),
    ],
)  # fmt: skip
def test_an_override_is_a_value_of_the_case(
    case_file: Path, overrides: dict[str, Any], read: list[str | int], value: float
) -> None:
    found: Any = load_case(case_file, overrides)
    for part in read:
        found = found[part] if isinstance(part, int) else getattr(found, part)
    assert found == pytest.approx(value, rel=1e-14)


def test_override_does_not_keep_the_callers_objects(case_file: Path) -> None:
    mud = {"density": 1000}
    assert load_case(case_file, {"mud": mud, "mud.density": 1100}).mud.density == 1100.0
    assert mud == {"density": 1000}


def test_none_removes_a_list_item(case_file: Path) -> None:
    assert len(load_case(case_file, {"operations[3]": None}).operations) == 3


def test_friction_by_kind_sets_the_intervals_of_that_kind(case_file: Path) -> None:
    kinds = {"wellbore.intervals[0].kind": "cased", "wellbore.intervals[1].kind": "open"}
    hole = load_case(case_file, kinds | {"friction": {"open": 0.4}}).wellbore
    assert [interval.friction for interval in hole.intervals] == [0.2, 0.4]
    # Casing of the catalogue is cased without being told so.
    of_casing = {"wellbore.intervals[0].casing": "13 3/8 in 68 N-80", "wellbore.intervals[1].kind": "open"}
    hole = load_case(case_file, of_casing | {"friction": {"cased": 0.15, "open": 0.4}}).wellbore
    assert [interval.friction for interval in hole.intervals] == [0.15, 0.4]
    error = refusal(case_file, {"friction": {"open": 0.4}})
    assert (error.key, error.expected) == (
        "wellbore.intervals[0].kind", '"cased" or "open", since friction is given by kind',
    )  # fmt: skip
    error = refusal(case_file, kinds | {"friction": {"open": "rough"}})
    assert (error.key, error.value) == ("wellbore.intervals[1].friction", "rough")


def test_casing_of_the_catalogue_is_of_the_kind_cased(case_file: Path) -> None:
    """Its table gives no kind; friction by kind finds it as it does in the case that is validated."""
    upper = {"to_md": 1000.0, "casing": "9 5/8 in 47 N-80", "friction": 0.2}
    rows = [upper, {"to_md": "3000 m", "diameter": "8.5 in", "friction": 0.3, "kind": "open"}]
    hole = load_case(case_file, {"wellbore.intervals": rows, "friction": {"cased": 0.15, "open": 0.4}}).wellbore
    assert [interval.friction for interval in hole.intervals] == [0.15, 0.4]


def test_a_pair_of_friction_factors(case_file: Path) -> None:
    """One number sets both directions, a pair each, and the key of its own the one around the hole."""

    def factors(*overrides: dict[str, Any]) -> list[tuple[float, float | None]]:
        merged = {key: value for override in overrides for key, value in override.items()}
        intervals = load_case(case_file, merged).wellbore.intervals
        return [(interval.friction, interval.rotational_friction) for interval in intervals]

    assert factors({"friction": "0.3/0.2"}) == [(0.3, 0.2)] * 2
    assert factors({"friction": "0.3/0.3"}) == [(0.3, None)] * 2
    assert factors({"friction": "0.3/0.2"}, {"rotational_friction": 0.1}) == [(0.3, 0.1)] * 2
    assert factors({"wellbore.intervals[1].rotational_friction": 0.1, "friction": 0.4}) == [(0.4, None)] * 2
    kinds = {"wellbore.intervals[0].kind": "cased", "wellbore.intervals[1].kind": "open"}
    assert factors(kinds, {"friction": {"open": "0.4/0.25"}}) == [(0.2, None), (0.4, 0.25)]
    assert factors(kinds, {"rotational_friction": {"cased": 0.15}})[0] == (0.2, 0.15)
    with_static = {"contact.friction_law": "karnopp", "wellbore.intervals[0].static_friction": 0.3}
    first = load_case(case_file, with_static | {"friction": "0.4/0.1"}).wellbore.intervals[0]
    assert (first.static_friction, first.friction_around) == (pytest.approx(0.6), 0.1)
    for value in ("0.3/", "0.3/low", "0.3/-0.1"):
        assert refusal(case_file, {"friction": value}).key == "friction"
    error = refusal(case_file, {"rotational_friction": -0.1})
    assert (error.key, error.expected[:18]) == ("wellbore.intervals[0].rotational_friction", "a friction factor ")


@pytest.mark.parametrize(
    ("key", "expected"),
    [
        ("operations[9].speed", "a key that exists"),
        ("operations[9]", "a key that exists"),
        ("operations.first", "a key that exists"),
        ("name.first", "a key that exists"),
        ("operations[", "a dotted key such as"),
        ("mud..density", "a dotted key such as"),
    ],
)
def test_override_of_a_path_that_is_not_there(case_file: Path, key: str, expected: str) -> None:
    error = refusal(case_file, {key: 3})
    assert str(case_file) in str(error)
    assert key in str(error)
    assert expected in str(error)


@pytest.mark.parametrize("value", [3, None])
def test_override_of_an_unknown_key(case_file: Path, value: object) -> None:
    error = refusal(case_file, {"wellbore.overlp": value})
    assert (error.key, error.expected) == ("wellbore.overlp", "the key overlap")


@pytest.mark.parametrize(
    ("text", "key", "value"),
    [
        ("mud.density=1200", "mud.density", 1200),
        ("mud.density = 1.2e3", "mud.density", 1200.0),
        ("wellbore.overlap=0.2 m", "wellbore.overlap", "0.2 m"),
        ('wellbore.overlap="0.2 m"', "wellbore.overlap", "0.2 m"),
        ("wellbore.geometry=arcs", "wellbore.geometry", "arcs"),
        ("record.profile_at=[100, '1 km']", "record.profile_at", [100, "1 km"]),
        ("name=a=b", "name", "a=b"),
        ("name=1\nmud.density=3", "name", "1\nmud.density=3"),
        ("wellbore.chord_tolerance=", "wellbore.chord_tolerance", None),
    ],
)
def test_parse_override(text: str, key: str, value: object) -> None:
    assert parse_override(text) == (key, value)


@pytest.mark.parametrize("text", ["mud.density", "=3", ""])
def test_parse_override_refuses(text: str) -> None:
    with pytest.raises(InputError, match="expected key=value"):
        parse_override(text)


SETUP = "[unknowns.a]\nbounds = [1, [2]]"
SWEEP = 'name = "s"\ncase = "c"\nmethod = "grid"\nwork = {operations = ["trip_in"], depths = [1, "x"]}'


@pytest.mark.parametrize(
    ("read", "text", "keys"),
    [(read_setup, SETUP, {"unknowns.a.bounds[1]"}), (read_sweep, SWEEP, {"work.depths", "work.depths[1]"})],
)
def test_names_of_the_members_of_unions_are_no_keys(
    read: Callable[[Path], object], text: str, keys: set[str], tmp_path: Path
) -> None:
    """pydantic puts them into the path of an error."""
    path = tmp_path / "file.toml"
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read(path)
    assert {caught.value.key, *(other.key for other in caught.value.more)} == keys


def test_an_override_by_name(case_file: Path) -> None:
    """Of a component and an interval, and of a factor by the kind of interval."""
    kinds = {"wellbore.intervals[0].kind": "cased", "wellbore.intervals.Open Hole.kind": "open"}
    case = load_case(case_file, kinds | {"string.components.Collar.length": "80 m", "friction.open": 0.31})
    assert case.string.components[0].length == 80.0
    assert [interval.friction for interval in case.wellbore.intervals] == [0.2, 0.31]
