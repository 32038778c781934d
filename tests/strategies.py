"""Inputs of the case tests: wrong values, and Hypothesis strategies."""

import json
from functools import cache
from typing import Any

from hypothesis import strategies as st

WRONG_VALUES: list[Any] = [
    "-1 m",
    "3 parsecs",
    "2 kg",
    "m",
    "",
    "nan m",
    "1,2 m",
    -1,
    0,
    float("nan"),
    float("inf"),
    10**400,
    True,
    [],
    {},
    [[1]],
    {"a": 1},
]


def toml(value: object) -> str:
    """A value as TOML; tables are written inline."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{json.dumps(key)} = {toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(toml, value)) + "]"
    return repr(value) if isinstance(value, float) else json.dumps(value)


def write_case(raw: dict[str, Any]) -> str:
    """Write a complete case file."""
    return "".join(f"{json.dumps(key)} = {toml(value)}\n" for key, value in raw.items())


# Hypothesis looks a strategy over when it is first drawn from: those that are made anew for each draw cost most of
# the tests' time.  What is drawn is the same.
@cache
def positive(low: float, high: float) -> st.SearchStrategy[float]:
    """A number with few digits, so that failures read well."""
    return st.floats(low, high).map(lambda number: float(f"{number:.6g}"))


@cache
def lengths(low: float, high: float) -> st.SearchStrategy[float | str]:
    """A length [m] as a bare number or with one of several units."""

    def written(metres: float, unit: tuple[str, float]) -> str:
        return f"{metres / unit[1]!r} {unit[0]}"

    units = st.sampled_from([("m", 1.0), ("mm", 1e-3), ("ft", 0.3048), ("in", 0.0254)])
    return positive(low, high) | st.builds(written, positive(low, high), units)


def optional(keys: dict[str, st.SearchStrategy[Any]]) -> st.SearchStrategy[dict[str, Any]]:
    """A table with any of these keys."""
    return st.fixed_dictionaries({}, optional=keys)


HOLE_OPTIONS = optional({"overlap": lengths(0, 1)})
PIPE_OPTIONS = optional(
    {
        "contact_diameter": lengths(0.16, 0.18),
        "linear_mass": st.just("19.5 lb/ft"),
        "youngs_modulus": st.just("206.8 GPa"),
        "poisson_ratio": positive(0, 0.5),
        "density": positive(2000, 9000),
        "axial_stiffness": positive(1e6, 1e10),
        "bending_stiffness": positive(1e4, 1e8),
        "torsional_stiffness": st.just("1e6 N*m^2"),
        "shear_stiffness": st.just("1e5 kN"),
    }
)
RAMP = optional({"ramp_time": st.just("5 s")})
TOP = optional({"top_md": lengths(0, 100)})
TABLES = optional(
    {
        "mud": optional(
            {
                "density": st.sampled_from(["1200 kg/m^3", "10 ppg", 1300]),
                "axial_damping": positive(0, 50),
                "lateral_damping": st.just("5 N*s/m^2"),
                "rotational_damping": st.just("0.1 N*s"),
            }
        ),
        "rig": optional(
            {
                "block_weight": st.just("60 klbf"),
                "sheave_efficiency": positive(0.5, 1),
                "torque_offset": st.just("-0.5 kN*m"),
            }
        ),
        "contact": optional({"friction_law": st.sampled_from(["coulomb", "paper"]), "damping": positive(0, 1e6)}),
        "solver": optional(
            {"step": st.sampled_from(["auto", "largest", "1 ms", 0.002]), "joint_damping": positive(0, 0.01)}
        ),
        "record": optional({"interval": st.just("0.5 s"), "profile_at": st.lists(lengths(100, 3000), max_size=3)}),
    }
)


@cache
def interval_options(stiffness: str | None) -> st.SearchStrategy[dict[str, Any]]:
    """Optional keys of an interval, with the same kind of stiffness as the hole."""
    unit = {"stiffness": "N/m", "stiffness_per_length": "N/m/m"}
    own = {stiffness: positive(1e4, 1e9).map(lambda k: f"{k!r} {unit[stiffness]}")} if stiffness else {}
    return optional({"name": st.text("abc åé\"'\\", max_size=5), "rotational_friction": positive(0, 1), **own})


@st.composite
def wellbores(draw: st.DrawFn) -> dict[str, Any]:
    """A hole to 3000 m with one interval or two."""
    depths = sorted(draw(st.sets(st.integers(1, 2999), max_size=5)))
    angles = st.tuples(positive(0, 180), positive(-360, 720))
    stations = [[md, *draw(angles)] for md in (0, *depths, 3000)]
    kind = draw(st.sampled_from(["stiffness", "stiffness_per_length"]))
    hole: dict[str, Any] = {
        "stations": stations,
        **draw(st.sampled_from([{}, {"chord_tolerance": "1 mm"}, {"cylinder_length": 5}])),
        **draw(st.sampled_from([{}, {"geometry": "arcs"}, {"survey_method": "average_angle"}])),
        **draw(HOLE_OPTIONS),
    }
    if draw(st.booleans()):
        hole[kind] = draw(positive(1e4, 1e9))
    bottoms: list[Any] = draw(st.sampled_from([["3000 m"], [1000, 3000.0]]))
    hole["intervals"] = [
        {
            "to_md": to_md,
            "diameter": draw(lengths(0.2, 0.5)),
            "friction": draw(positive(0, 1)),
            **draw(interval_options(kind if kind in hole else None)),
        }
        for to_md in bottoms
    ]
    return hole


@st.composite
def components(draw: st.DrawFn, last: bool) -> dict[str, Any]:
    """A run of pipe."""
    part = {
        "name": draw(st.text("abc 3½", max_size=8)),
        "outer_diameter": draw(lengths(0.1, 0.15)),
        "inner_diameter": draw(lengths(0, 0.09)),
        **draw(st.sampled_from([{"segments": 20}, {"segment_length": "10 m"}])),
        **draw(PIPE_OPTIONS),
    }
    if not last or draw(st.booleans()):
        part["length"] = draw(lengths(10, 3000))
    return part


@st.composite
def operation_lists(draw: st.DrawFn) -> list[dict[str, Any]]:
    """Operations that follow one another between 101 and 2999 m."""
    operations: list[dict[str, Any]] = []
    md = draw(st.integers(1000, 2000))
    for _ in range(draw(st.integers(0, 4))):
        kind = draw(st.sampled_from(["trip_in", "trip_out", "rotate_off_bottom", "back_ream"]))
        operation: dict[str, Any] = {"kind": kind, **draw(RAMP)}
        start = "at_md" if kind == "rotate_off_bottom" else "from_md"
        if not operations or draw(st.booleans()):
            operation[start] = f"{md} m"
        if kind == "rotate_off_bottom":
            operation |= {"duration": "1 min", "rpm": draw(st.integers(1, 200))}
        else:
            md = draw(st.integers(md + 1, 2999) if kind == "trip_in" else st.integers(101, md - 1))
            operation |= {"to_md": md, "speed": draw(positive(0.01, 2))}
            if kind == "back_ream":
                operation["rpm"] = 60
        operations.append(operation)
        if not 200 < md < 2900:
            break
    return operations


@st.composite
def cases(draw: st.DrawFn) -> dict[str, Any]:
    """A complete case as read from its TOML file."""
    runs = draw(st.integers(0, 2))
    raw = {
        "name": draw(st.text("abc-é", min_size=1, max_size=8)),
        "wellbore": draw(wellbores()),
        "string": {
            "components": [*(draw(components(last=False)) for _ in range(runs)), draw(components(last=True))],
            **draw(TOP),
        },
        "operations": draw(operation_lists()),
    }
    return raw | draw(TABLES)


def places(data: object) -> list[tuple[Any, Any]]:
    """Every (table or list, key or index) of nested data."""
    found: list[tuple[Any, Any]] = []
    items = data.items() if isinstance(data, dict) else enumerate(data) if isinstance(data, list) else ()
    for key, item in items:
        found += [(data, key), *places(item)]
    return found


@st.composite
def corrupted_cases(draw: st.DrawFn) -> dict[str, Any]:
    """A case with one key or item deleted, misspelt, negated or given a wrong value."""
    raw = draw(cases())
    table, key = draw(st.sampled_from(places(raw)))
    how = draw(st.sampled_from(["delete", "misspell", "negate", "replace"]))
    if how == "delete" or (how == "misspell" and isinstance(table, list)):
        del table[key]
    elif how == "misspell":
        table[key[:-1] + draw(st.sampled_from(["", "x", ".", " y", '"']))] = table.pop(key)
    elif how == "negate" and isinstance(table[key], str):
        table[key] = f"-{table[key]}"
    elif how == "negate" and isinstance(table[key], int | float):
        table[key] = -table[key]
    else:
        table[key] = draw(st.sampled_from(WRONG_VALUES) | st.text(max_size=8).filter(str.isprintable))
    return raw
