"""Rows of the steady solver in time: whether the string comes to stand in a steady shape, or keeps moving sideways."""

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd import Case, InputError, Simulation
from fctd.case.operations import KINDS
from fctd.mechanics import state
from fctd.mechanics.faults import UnstableError
from fctd.model.operations import rad_per_s

# Speed of the top where the string slides [m/s], on which Coulomb friction does not hang; length fed [m], at most a
# share of the depth; time in which a string turns [s], and at least so many turns.
SPEED, FED, SHARE = 0.2, 20.0, 0.05
DURATION, TURNS = 60.0, 20.0
# Lateral speed of the segments at the start [m/s].  The modes of strings that leave their balance grow in 0.1 to 4 s.
# Ten times as fast a push throws some strings, which stand, against the wall, where they roll without slipping.
PUSHED = 0.01
DAMPING = 20.0  # lateral [N s/m²], which lets the string come to rest
LAST = 0.25  # of the records that are read
INTERVAL = 0.25  # of the records [s]
# A string keeps moving if a segment moves sideways, on the mean of the last records, with more than this share of the
# speed at which the string slides along the wall.  Strings that follow the bends of their hole reach 4 %, those that
# roll 12 % and more.
MOVING = 0.05
# So does one that goes slowly round the hole: a point moves across the hole by this share of its clearance in the last
# records, while the string is fed by less than this share of its shortest segment and so does not follow the hole.
SHIFTED, HARDLY_FED = 0.25, 0.05
# Points this close to the wall, as a share of the clearance, go round with a string that rolls; least clearance [m].
NEAR_WALL, NARROWEST = 0.9, 1e-4


class Stepped(NamedTuple):
    """How a row ends in time.

    status : of the run, or why there is none; hookload [N], torque [N m] : means of the last records; sideways : speed
    across the string's own axis, of the segment that moves most, over that at which the string slides; shifted : move
    across the hole of the point that moves most, over its clearance, NaN where the string follows the hole; round_it :
    mean rate at which the points on the wall go round the hole [rad/s].
    """

    status: str
    hookload: float
    torque: float
    sideways: float
    shifted: float
    round_it: float

    @property
    def moves(self) -> bool:
        """Whether the string has no steady shape."""
        return self.sideways > MOVING or self.shifted > SHIFTED


class _Record(NamedTuple):
    """The string at a time: its loads, and a row per segment.

    across (n,), along : speeds of ``_speeds``; offset (n, 3) : of the contact points from the hole's axis [m];
    clearance (n,) [m]; axis (n, 3) : of the segments.
    """

    hookload: float
    torque: float
    across: NDArray[np.float64]
    along: float
    offset: NDArray[np.float64]
    clearance: NDArray[np.float64]
    axis: NDArray[np.float64]


def step(case: Case, kind: str, depth: float, rates: dict[str, float]) -> Stepped:
    """Run the operation of a row in time, from a string at rest to one that slides or turns at its rates."""
    spin, operation = rates.get("rpm", 0.0), _operation(kind, depth, rates)
    bit = case.bit.model_dump(exclude_defaults=True) if KINDS[kind].on_bottom else {}
    if bit:
        bit |= {"rock": {"law": "given"}, "motor": {"flow": "2000 L/min", "revolutions_per_liter": 0.05}}
    changes = {"operations": [operation], "bit": bit, "record": {"interval": INTERVAL}}
    table = damped(case).model_dump(exclude_defaults=True) | changes
    try:
        simulation = Simulation(Case.model_validate(table))
        simulation.start()
        _push_aside(simulation)
        records = [_record(simulation, row["hookload_N"], row["surface_torque_N_m"]) for row in simulation]
    except (InputError, UnstableError) as error:
        return Stepped(f"not run: {error}", *[np.nan] * 5)
    last = records[-max(int(LAST * len(records)), 1) :]
    slides = max(float(np.mean([at.along for at in last])), rad_per_s(spin) * _radius(simulation))
    least = min(len(at.across) for at in last)  # a stand may have been added at the top
    sideways = float(np.mean([at.across[-least:] for at in last], axis=0).max()) / slides
    fed = operation.get("speed", 0.0) * INTERVAL * len(last)
    shifted, round_it = np.nan, np.nan
    if fed < HARDLY_FED * float(simulation.run.string.length.min()):
        clearance = np.maximum(last[-1].clearance[-least:], NARROWEST)
        moved = np.max([np.linalg.norm(at.offset[-least:] - last[-1].offset[-least:], axis=1) for at in last], axis=0)
        shifted, round_it = float((moved / clearance).max()), _round_it(last, least)
    hookload, torque = (float(np.mean([at[k] for at in last])) for k in (0, 1))
    return Stepped(str(simulation.status), hookload, torque, sideways, shifted, round_it)


def _round_it(records: list[_Record], n: int) -> float:
    """Mean rate at which the points on the wall go round the hole [rad/s], of the lowest n segments; 0 without any."""
    swept, spent = 0.0, 0.0
    for before, after in pairwise(records):
        a, b, along = before.offset[-n:], after.offset[-n:], after.axis[-n:]
        near = [np.linalg.norm(at.offset[-n:], axis=1) > NEAR_WALL * at.clearance[-n:] for at in (before, after)]
        angle = np.arctan2((along * np.cross(a, b)).sum(axis=1), (a * b).sum(axis=1))
        swept += float(angle[near[0] & near[1]].sum())
        spent += INTERVAL * float((near[0] & near[1]).sum())
    return swept / spent if spent > 0 else 0.0


def damped(case: Case) -> Case:
    """A case in the mud of the strings in time."""
    table = case.model_dump(exclude_defaults=True)
    return Case.model_validate(table | {"mud": table.get("mud", {}) | {"lateral_damping": DAMPING}})


def _operation(kind: str, depth: float, rates: dict[str, float]) -> dict[str, Any]:
    """The operation that ends at a depth, with a speed at which it is soon done."""
    spin = rates.get("rpm", 0.0)
    if kind == "rotate_off_bottom":
        duration = max(DURATION, 60 * TURNS / spin)
        return {"kind": kind, "at_md": depth, "duration": duration, "rpm": spin, "ramp_time": 2.0}
    ways = KINDS[kind].direction
    # Turning and sliding together, friction hangs on the ratio of their speeds.
    speed = SPEED if not spin else rates["speed"]
    fed = min(FED, SHARE * depth)
    if spin:
        fed = min(fed, speed * max(DURATION, 60 * TURNS / spin))
    start = depth if ways < 0 else depth - fed
    turning = {"rpm": spin} if spin else {}
    return {
        "kind": kind, "from_md": start, "to_md": start + ways * fed, "speed": speed, "ramp_time": 2.0,
    } | turning  # fmt: skip


def _push_aside(simulation: Simulation) -> None:
    """Give every segment a lateral speed of its own: a string without imperfection stays in a balance that is none."""
    S, n = simulation.run.S, simulation.run.segments
    velocity = np.random.default_rng(0).normal(0.0, PUSHED, (3, n))
    axis = np.stack([state.row(S, of, n) for of in _AXIS])
    for of, row in zip(_VELOCITY, velocity - (velocity * axis).sum(axis=0) * axis, strict=True):
        state.row(S, of, n)[:] += row


_VELOCITY, _AXIS = (state.VX, state.VY, state.VZ), (state.AX, state.AY, state.AZ)
_OFFSET = (state.PX, state.PY, state.PZ)


def _record(simulation: Simulation, hookload: float, torque: float) -> _Record:
    S, n = simulation.run.S, simulation.run.segments
    offset, axis = (np.column_stack([state.row(S, of, n) for of in rows]) for rows in (_OFFSET, _AXIS))
    clearance = state.row(S, state.HOLE, n) - state.row(S, state.RADIUS, n)
    return _Record(hookload, torque, *_speeds(simulation), offset, clearance, axis)


def _speeds(simulation: Simulation) -> tuple[NDArray[np.float64], float]:
    """Speeds of the segments across the string's axis (n,), and their mean speed along it [m/s]."""
    S, n = simulation.run.S, simulation.run.segments
    velocity, axis = (np.stack([state.row(S, of, n) for of in rows]) for rows in (_VELOCITY, _AXIS))
    along = (velocity * axis).sum(axis=0)
    return np.linalg.norm(velocity - along * axis, axis=0), float(np.abs(along).mean())


def _radius(simulation: Simulation) -> float:
    return float(state.row(simulation.run.S, state.RADIUS, simulation.run.segments).mean())
