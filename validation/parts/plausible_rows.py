"""Strings as rigs run them, from coiled tubing to 13⅜ in casing, in wells of 100 to 9,000 m: the same for a seed.

A string stands for several rows of a chart: every operation that its class can do, and some of them again with less
friction.
"""

from collections.abc import Iterator
from random import Random
from typing import Any, NamedTuple

from validation.parts.random_paths import path
from validation.parts.random_wells import Pipe

SHALLOWEST, DEEPEST = 100.0, 9000.0  # bit depths [m]
TRIPS = ("trip_in", "trip_out")
TURNING = (*TRIPS, "rotate_off_bottom", "back_ream")
DRILLING = (*TURNING, "drill_rotating", "drill_sliding")
SLIDING = (*TRIPS, "drill_sliding")  # of coiled tubing, which cannot turn
REPEATED = ("trip_in", "rotate_off_bottom", "trip_out")  # with less friction
LESS = 0.7  # of the friction


class Kind(NamedTuple):
    """A class of strings [in]: hole and casing above it, parts from the bit up with lengths [m], the pipe above them.

    weights : on bit [kN]; operations : that it can do.
    """

    hole: float
    casing: float
    parts: tuple[tuple[str, Pipe, float, float], ...]
    pipe: Pipe
    weights: tuple[float, float]
    operations: tuple[str, ...]


def _collars(outer: float, inner: float, least: float, most: float) -> tuple[str, Pipe, float, float]:
    return "collars", Pipe(outer, inner, outer), least, most


def _heavy(outer: float, inner: float, joint: float) -> tuple[str, Pipe, float, float]:
    return "heavy-weight pipe", Pipe(outer, inner, joint), 50, 250


CLASSES: dict[str, Kind] = {
    "2 in coiled tubing": Kind(
        4.75, 4.892, (_collars(3.125, 1.25, 8, 20),), Pipe(2, 1.688, 2), (1, 10), SLIDING),
    "2 7/8 in coiled tubing": Kind(
        6.0, 6.184, (_collars(4.75, 2.25, 8, 20),), Pipe(2.875, 2.499, 2.875), (2, 20), SLIDING),
    "2 7/8 in drill pipe": Kind(
        4.75, 4.892, (_collars(3.5, 1.5, 30, 150),), Pipe(2.875, 2.151, 4.125), (10, 50), DRILLING),
    "3 1/2 in drill pipe": Kind(
        6.0, 6.184, (_collars(4.75, 2.25, 30, 150), _heavy(3.5, 2.0625, 4.75)), Pipe(3.5, 2.764, 4.75), (20, 80),
        DRILLING),
    "4 in drill pipe": Kind(
        6.75, 7.0, (_collars(4.75, 2.25, 30, 150), _heavy(4, 2.5625, 5.25)), Pipe(4, 3.34, 5.25), (20, 100), DRILLING),
    "5 in drill pipe": Kind(
        8.5, 8.681, (_collars(6.5, 2.8125, 30, 200), _heavy(5, 3, 6.5)), Pipe(5, 4.276, 6.625), (20, 150), DRILLING),
    "5 7/8 in drill pipe": Kind(
        12.25, 12.415, (_collars(8, 2.8125, 30, 150), _heavy(5.875, 4, 7)), Pipe(5.875, 5.153, 7), (30, 200), DRILLING),
    "6 5/8 in drill pipe": Kind(
        17.5, 18.73, (_collars(9.5, 3, 30, 100), _collars(8, 2.8125, 30, 100), _heavy(6.625, 4.5, 8)),
        Pipe(6.625, 5.965, 8), (50, 250), DRILLING),
    "4 1/2 in liner on 3 1/2 in drill pipe": Kind(
        6.0, 6.184, (("liner", Pipe(4.5, 3.958, 5), 200, 1200),), Pipe(3.5, 2.764, 4.75), (0, 0), TURNING),
    "7 in casing": Kind(8.5, 8.681, (), Pipe(7, 6.184, 7.656), (0, 0), TURNING),
    "9 5/8 in casing": Kind(12.25, 12.415, (), Pipe(9.625, 8.681, 10.625), (0, 0), TURNING),
    "13 3/8 in casing": Kind(17.5, 18.73, (), Pipe(13.375, 12.415, 14.375), (0, 0), TRIPS),
}  # fmt: skip


class Drawn(NamedTuple):
    """A string to solve: its class, the case as a table, the bit depth [m], operations with their rates.

    rates : operation to speed [m/s] and rpm, as arguments of ``steady_rates``.
    """

    kind: str
    case: dict[str, Any]
    bit_depth: float
    rates: dict[str, dict[str, float]]


def drawn(seed: int, index: int) -> Drawn:
    """The string of a seed and an index; classes follow each other."""
    rng = Random(f"plausible rows:{seed}:{index}")
    name = list(CLASSES)[index % len(CLASSES)]
    kind = CLASSES[name]
    stretch = rng.uniform(1.0, 1.25)
    stations = [[round(md * stretch, 2), *angles] for md, *angles in path(rng, deepest=DEEPEST / stretch)]
    depth = round(rng.uniform(max(SHALLOWEST, 0.1 * stations[-1][0]), stations[-1][0]), 1)
    if rng.random() < 0.05:
        depth = round(rng.uniform(SHALLOWEST, 2 * SHALLOWEST), 1)
    weight = round(rng.uniform(*kind.weights)) * 1e3
    return Drawn(
        name,
        {
            "name": name,
            "wellbore": {
                "stations": stations,
                "survey_method": "minimum_curvature",
                "geometry": rng.choice(["cylinders", "arcs"]),
                "intervals": _intervals(rng, kind, stations[-1][0]),
            },
            "string": {"components": list(_components(rng, kind))},
            "mud": {"density": round(rng.uniform(1000, 2000)), "viscosity": 0},
            "rig": {"block_weight": round(rng.uniform(0, 3e5), -4)},
            # PDC bits take some 0.15 m of the hole's radius times the weight on bit.
            "bit": {"weight_on_bit": weight, "torque": round(weight * rng.uniform(0.1, 0.2) * kind.hole * 0.0254)},
        },
        depth,
        {operation: _rates(rng, operation) for operation in kind.operations},
    )


def _rates(rng: Random, operation: str) -> dict[str, float]:
    if operation in TRIPS:
        return {"speed": round(rng.uniform(0.05, 0.6), 2)}
    rpm = {"rpm": float(rng.randrange(30, 181, 10))}
    if operation == "rotate_off_bottom":
        return rpm
    if operation == "back_ream":
        return rpm | {"speed": round(rng.uniform(0.02, 0.2), 2)}
    rate = {"speed": round(rng.uniform(3, 60) / 3600, 5)}
    return rate if operation == "drill_sliding" else rate | rpm


def _intervals(rng: Random, kind: Kind, depth: float) -> list[dict[str, Any]]:
    cased = {"to_md": round(rng.uniform(0.1, 0.9) * depth, 1), "diameter": f"{kind.casing} in"}
    cased["friction"] = round(rng.uniform(0.1, 0.3), 2)
    bottom = {"to_md": depth, "diameter": f"{kind.hole} in", "friction": round(rng.uniform(0.15, 0.45), 2)}
    return [cased, bottom]


def _components(rng: Random, kind: Kind) -> Iterator[dict[str, Any]]:
    """Parts and pipe in inches; segments as a user gives them, or the engine's own."""
    segment = rng.choice([None, 10.0, 20.0, 30.0])
    rows = [(name, pipe, round(rng.uniform(least, most), 1)) for name, pipe, least, most in kind.parts]
    for name, pipe, length in [*rows, ("pipe", kind.pipe, None)]:
        part: dict[str, Any] = {f"{key}_diameter": f"{value:g} in" for key, value in pipe._asdict().items()}
        part["name"] = name
        if length is not None:
            part["length"] = length
        if segment is not None:
            part["segment_length"] = min(segment, 10.0) if name == "collars" else segment
        yield part
