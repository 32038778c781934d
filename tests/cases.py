"""Small cases that the engine's tests build on."""

import tomllib
from pathlib import Path
from typing import Any

from fctd.case.load import Case
from fctd.model.wellbore import Wellbore, build_wellbore


def make_case(
    stations: list[list[float]] | None = None,
    components: list[dict[str, Any]] | None = None,
    operations: list[dict[str, Any]] | None = None,
    top_md: float = 0.0,
    wellbore: dict[str, Any] | None = None,
    **sections: dict[str, Any],
) -> Case:
    """A case from keyword sections: a vertical 1000 m hole and one pipe by default."""
    stations = stations or [[0, 0, 0], [1000, 0, 0]]
    hole = {
        "stations": stations,
        "intervals": [{"to_md": stations[-1][0], "diameter": 0.2159, "friction": 0.2}],
        **(wellbore or {}),
    }
    return Case.model_validate(
        {
            "name": "test",
            "wellbore": hole,
            "string": {"top_md": top_md, "components": components or [pipe(1000, 20)]},
            "operations": operations or [],
            **sections,
        }
    )


def level_case(**more: Any) -> Case:
    """150 m of 5 inch pipe, slid into a level hole with 300 kN on bit, which is 2.6 times the sinusoidal limit.

    Its buckled string is resolved.  The rig's block weight, 2 MN, allows any push.
    """
    intervals = [{"to_md": 170.0, "diameter": 0.2159, "friction": 0.5}]
    given: dict[str, Any] = {
        "components": [pipe(None, None, inner_diameter=0.1086, segment_length=10.0)],
        "wellbore": {"intervals": intervals, "stiffness_per_length": 1e6},
        "mud": {"density": 1200.0},
        "rig": {"block_weight": 2e6},
        "bit": {"weight_on_bit": 300e3},
        "solver": {"buckling": "resolve"},
    }
    return make_case([[0, 90, 0], [170, 90, 0]], **(given | more))


def hole_of(stations: list[list[float]], **wellbore: Any) -> Wellbore:
    """The hole of such a case."""
    return build_wellbore(make_case(stations, wellbore=wellbore))


def pipe(
    length: float | None, segments: int | None, outer: float = 0.127, inner: float = 0.07, **more: Any
) -> dict[str, Any]:
    """A component of 5 inch drill pipe, or of another outer diameter [m]; None leaves a key out."""
    given = {"name": "pipe", "length": length, "outer_diameter": outer, "inner_diameter": inner, "segments": segments}
    return {key: value for key, value in given.items() if value is not None} | more


def rotation(at: float, duration: float, rpm: float = 60.0, ramp: float = 5.0) -> dict[str, Any]:
    """An operation: rotate off bottom."""
    return {"kind": "rotate_off_bottom", "at_md": at, "duration": duration, "rpm": rpm, "ramp_time": ramp}


def trip(start: float, end: float, speed: float = 0.2, ramp: float = 5.0) -> dict[str, Any]:
    """An operation: trip in or out, whichever leads from start to end."""
    kind = "trip_in" if end > start else "trip_out"
    return {"kind": kind, "from_md": start, "to_md": end, "speed": speed, "ramp_time": ramp}


def case_files(folder: Path) -> list[Path]:
    """The case files of a folder, without its sweeps, which name a case."""
    return [path for path in folder.glob("*.toml") if "case" not in tomllib.loads(path.read_text(encoding="utf-8"))]
