"""Rows of the steady solver in time: whether the string comes to stand in a steady shape, or keeps moving sideways."""

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
DURATION, TURNS = 20.0, 20.0
PUSHED = 0.1  # lateral speed of the segments at the start [m/s]
DAMPING = 20.0  # lateral [N s/m²], which lets the string come to rest
LAST = 0.25  # of the records that are read
# A string keeps moving if a segment moves sideways, on the mean of the last records, with more than this share of the
# speed at which the string slides along the wall.  Strings that follow the bends of their hole reach 4 %, those that
# roll 12 % and more.
MOVING = 0.05


class Stepped(NamedTuple):
    """How a row ends in time.

    status : of the run, or why there is none; hookload [N], torque [N m] : means of the last records; sideways : speed
    across the string's own axis, of the segment that moves most, over that at which the string slides.
    """

    status: str
    hookload: float
    torque: float
    sideways: float

    @property
    def moves(self) -> bool:
        """Whether the string has no steady shape."""
        return self.sideways > MOVING


def step(case: Case, kind: str, depth: float, rates: dict[str, float]) -> Stepped:
    """Run the operation of a row in time, from a string at rest to one that slides or turns at its rates."""
    spin, operation = rates.get("rpm", 0.0), _operation(kind, depth, rates)
    mud = case.mud.model_dump(exclude_defaults=True) | {"lateral_damping": DAMPING}
    bit = case.bit.model_dump(exclude_defaults=True) if KINDS[kind].on_bottom else {}
    if bit:
        bit |= {"rock": {"law": "given"}, "motor": {"flow": "2000 L/min", "revolutions_per_liter": 0.05}}
    changes = {"operations": [operation], "mud": mud, "bit": bit, "record": {"interval": 0.25}}
    table = case.model_dump(exclude_defaults=True) | changes
    try:
        simulation = Simulation(Case.model_validate(table))
        simulation.start()
        _push_aside(simulation)
        records = [(row["hookload_N"], row["surface_torque_N_m"], *_speeds(simulation)) for row in simulation]
    except (InputError, UnstableError) as error:
        return Stepped(f"not run: {error}", np.nan, np.nan, np.nan)
    hookload, torque, across, along = zip(*records[-max(int(LAST * len(records)), 1) :], strict=True)
    slides = max(float(np.mean(along)), rad_per_s(spin) * _radius(simulation))
    least = min(len(row) for row in across)  # a stand may have been added at the top
    sideways = float(np.mean([row[-least:] for row in across], axis=0).max()) / slides
    return Stepped(str(simulation.status), float(np.mean(hookload)), float(np.mean(torque)), sideways)


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


def _speeds(simulation: Simulation) -> tuple[NDArray[np.float64], float]:
    """Speeds of the segments across the string's axis (n,), and their mean speed along it [m/s]."""
    S, n = simulation.run.S, simulation.run.segments
    velocity, axis = (np.stack([state.row(S, of, n) for of in rows]) for rows in (_VELOCITY, _AXIS))
    along = (velocity * axis).sum(axis=0)
    return np.linalg.norm(velocity - along * axis, axis=0), float(np.abs(along).mean())


def _radius(simulation: Simulation) -> float:
    return float(state.row(simulation.run.S, state.RADIUS, simulation.run.segments).mean())
