"""Random wells that can be drilled, with their strings, the same for the same seed."""

from random import Random
from typing import Any, NamedTuple

from fctd.case.operations import KINDS
from validation.parts.random_paths import path
from validation.parts.recorded_kinds import RECORDED_KINDS


class Pipe(NamedTuple):
    """Outer, inner and contact diameter [in]."""

    outer: float
    inner: float
    contact: float


# Open hole, the bore of the casing above it, and what is run there [in]: drill pipe, collars, casing or tubing.
HOLES: dict[float, tuple[float, list[Pipe], list[Pipe], list[Pipe]]] = {
    17.5: (18.73, [Pipe(5, 4.276, 6.625), Pipe(6.625, 5.965, 8)], [Pipe(9.5, 3, 9.5), Pipe(8, 2.8125, 8)],
           [Pipe(13.375, 12.415, 14.375)]),
    12.25: (12.415, [Pipe(5, 4.276, 6.625), Pipe(5.5, 4.778, 7)], [Pipe(8, 2.8125, 8)], [Pipe(9.625, 8.681, 10.625)]),
    8.5: (8.681, [Pipe(5, 4.276, 6.625), Pipe(4, 3.34, 5.25)], [Pipe(6.5, 2.8125, 6.5)],
          [Pipe(7, 6.184, 7.656), Pipe(2.875, 2.441, 3.668)]),
    6.0: (6.184, [Pipe(3.5, 2.764, 4.75), Pipe(2.875, 2.151, 4.125)], [Pipe(4.75, 2.25, 4.75)],
          [Pipe(4.5, 3.958, 5), Pipe(2.375, 1.995, 3.063)]),
}  # fmt: skip
HEAVY = 3.0  # inner diameter of heavy-weight pipe [in], where it leaves a wall


def well(rng: Random, simulated: bool = False) -> dict[str, Any]:
    """A case of well and string; coarse, and with a short operation, where it is to be simulated."""
    stations = path(rng, spacing=rng.choice([10.0, 30.0, 30.0, 60.0]))
    depth = stations[-1][0]
    size = rng.choice(list(HOLES))
    hole: dict[str, Any] = {
        "stations": stations,
        "survey_method": "minimum_curvature",
        "geometry": rng.choice(["cylinders", "arcs"]),
        "intervals": _intervals(rng, depth, size),
    }
    if hole["geometry"] == "cylinders" and rng.random() < 0.2:
        hole["survey_method"] = "average_angle"
    if rng.random() < 0.3:
        hole["stiffness_per_length"] = rng.choice([1e6, 1e7])
    elif rng.random() < 0.3:
        hole["stiffness"] = rng.choice([1e6, 1e8])
    top = rng.choice([0.0, 0.0, 0.0, round(rng.uniform(0, 0.3) * depth, 1)])
    case: dict[str, Any] = {
        "name": "plausible",
        "wellbore": hole,
        "string": {"top_md": top, "components": _string(rng, size, simulated)},
        "mud": {"density": rng.choice([0.0, round(rng.uniform(950, 2200))]), "viscosity": 0},
        "bit": {"weight_on_bit": round(rng.uniform(0, 1.5e5), -3), "torque": round(rng.uniform(0, 1.5e4), -2)},
        "contact": {"friction_law": rng.choice(["coulomb", "coulomb", "paper"])},
    }
    if rng.random() < 0.4:
        case["mud"] |= {"axial_damping": rng.choice([0.0, 5.0]), "rotational_damping": rng.choice([0.0, 0.2])}
    if rng.random() < 0.4:
        case["rig"] = {"block_weight": "60 klbf", "sheave_efficiency": 0.97, "torque_offset": "0.5 kN*m"}
    if simulated:
        case["bit"] = {}
        case["mud"]["lateral_damping"] = 50.0
        case["operations"] = [_short(rng, top, depth)]
    return case


def _intervals(rng: Random, depth: float, size: float) -> list[dict[str, Any]]:
    """Cased hole and open hole below it, or all of one size."""
    cased = round(rng.uniform(0.2, 0.9) * depth, 1)
    casing = {"to_md": cased, "diameter": f"{HOLES[size][0]} in", "friction": round(rng.uniform(0, 0.4), 3)}
    bottom = {"to_md": depth, "diameter": f"{size} in", "friction": round(rng.uniform(0, 0.6), 3)}
    return rng.choice([[bottom], [casing, bottom], [casing, bottom]])


def _component(name: str, pipe: Pipe, segment: float, length: float | None = None) -> dict[str, Any]:
    diameters = {f"{key}_diameter": f"{value:g} in" for key, value in pipe._asdict().items()}
    part = {"name": name, **diameters, "segment_length": segment}
    return part if length is None else part | {"length": length}


def _string(rng: Random, size: float, coarse: bool) -> list[dict[str, Any]]:
    """From the bit up: an assembly with collars and drill pipe, or casing, liner or tubing alone."""
    _, pipes, collars, casings = HOLES[size]
    segment = rng.choice([20.0, 25.0] if coarse else [9.0, 10.0, 12.5, 20.0, 27.0, 30.0])
    if rng.random() < 0.3:
        return [_component("casing", rng.choice(casings), segment)]
    pipe, collar = rng.choice(pipes), rng.choice(collars)
    parts = []
    if not coarse and rng.random() < 0.4:
        bent = {"bend": f"{rng.uniform(0.5, 1.5):.2f} deg", "toolface": f"{rng.randrange(360)} deg"}
        parts.append(_component("motor", collar, 2.0, 8.0) | (bent if rng.random() < 0.5 else {}))
        parts.append(_component("stabiliser", collar._replace(contact=size - 0.125), 1.5, 1.5))
    parts.append(
        _component("collars", collar, segment if coarse else rng.choice([5.0, 9.0]), round(rng.uniform(20, 200), 1))
    )
    if rng.random() < 0.6 and pipe.inner > HEAVY:
        heavy = Pipe(pipe.outer, HEAVY, pipe.contact)
        parts.append(_component("heavy-weight pipe", heavy, segment, round(rng.uniform(50, 300), 1)))
    return [*parts, _component("drill pipe", pipe, segment)]


def _short(rng: Random, top: float, depth: float) -> dict[str, Any]:
    """An operation of a few seconds that ends at or near total depth."""
    kind = rng.choice([kind for kind in RECORDED_KINDS if not KINDS[kind].on_bottom])
    operation: dict[str, Any] = {"kind": kind, "ramp_time": 2.0}
    if kind != "trip_in" and kind != "trip_out":
        operation["rpm"] = rng.choice([30, 60, 120])
    if kind == "rotate_off_bottom":
        return operation | {"at_md": round(rng.uniform(0.5, 1) * (depth - top) + top, 2), "duration": 5.0}
    ends = [round(depth - rng.uniform(0, 50), 2)]
    ends.append(round(ends[0] - rng.uniform(0.5, 3), 2))
    if kind == "trip_in":
        ends.reverse()
    return operation | {"from_md": ends[0], "to_md": ends[1], "speed": 0.5}
