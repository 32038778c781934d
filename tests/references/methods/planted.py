"""Methods and engines with planted faults, in a hole of 240 m."""

import contextlib
import signal
import time
from importlib.metadata import EntryPoint
from typing import Any

import numpy as np
import pytest

from fctd.arena.exact_hole import ExactHole
from fctd.arrays import Array, Contacts
from fctd.case.load import Case
from references import contact, engines, registry
from references.contact.own import ArcOptions, Arcs
from tests.references.engines.faulty import Faulty, FaultyStepper, slippery
from tests.references.wells import bent_case

OFF = 3.0  # [deg] by which the normals of the faulty method are off


def well(**more: Any) -> Case:
    """The bent hole of 240 m, whose string turns."""
    turning = {"kind": "rotate_off_bottom", "at_md": 200, "duration": 5, "rpm": 60, "ramp_time": 0.2}
    case = bent_case()
    raw = case.model_dump(exclude_none=True, exclude={"file"})
    return Case.model_validate(raw | {"operations": [turning], "mud": {"density": 1200, "viscosity": 0}} | more)


class Leaning(Arcs):
    """The arcs, whose normals are OFF around the axis."""

    name = "leaning"

    def __init__(self, case: Case, options: Any) -> None:
        super().__init__(case, ArcOptions())
        self.exact = ExactHole(case.wellbore)

    def query(self, points: Array, radii: Array) -> Contacts:
        hits = super().query(points, radii)
        along = self.exact.at(hits.md)[1]
        turn = np.radians(OFF)
        normal = np.cos(turn) * hits.normal + np.sin(turn) * np.cross(along, hits.normal)
        return hits._replace(normal=normal / np.linalg.norm(normal, axis=1)[:, None])


class Lost(Arcs):
    """The arcs, with a penetration that is no number at contacts."""

    name = "lost"

    def query(self, points: Array, radii: Array) -> Contacts:
        hits = super().query(points, radii)
        return hits._replace(penetration=np.where(hits.penetration > 0, np.nan, hits.penetration))


class Raising(Arcs):
    """A method that raises in its query."""

    name = "raising"

    def query(self, points: Array, radii: Array) -> Contacts:
        raise ZeroDivisionError("of mine")


class Deaf(Arcs):
    """A method that catches a Ctrl-C, and goes on."""

    name = "deaf"
    asked = 0

    def __init__(self, case: Case, options: Any) -> None:
        super().__init__(case, ArcOptions())

    def query(self, points: Array, radii: Array) -> Contacts:
        Deaf.asked += 1
        with contextlib.suppress(BaseException):
            if Deaf.asked == 100:
                signal.raise_signal(signal.SIGINT)
        return super().query(points, radii)


class Slow(Arcs):
    """A method whose first query lasts, or each point of all of them."""

    name = "slow"
    first, each = 0.5, 0.0  # [s]

    def __init__(self, case: Case, options: Any) -> None:
        super().__init__(case, ArcOptions())

    def query(self, points: Array, radii: Array) -> Contacts:
        until = time.process_time() + self.first + self.each * len(points)
        self.first = 0.0
        while time.process_time() < until:
            pass
        return super().query(points, radii)


class Slippery(Faulty):
    """FCTD as an engine with FACTOR of the friction."""

    name = "slippery"

    def __init__(self, options: Any) -> None:
        super().__init__(at_start=slippery)


class LateStepper(FaultyStepper):
    """A stepper that begins with half a second of work."""

    late = 0.5  # [s]

    def advance(self, motion: Any, duration: float) -> None:
        until, self.late = time.process_time() + self.late, 0.0
        while time.process_time() < until:
            pass
        super().advance(motion, duration)


class Starting(Faulty):
    """FCTD as an engine that compiles at first."""

    name = "starting"

    def __init__(self, options: Any) -> None:
        super().__init__(stepper=LateStepper)


def plant(monkeypatch: pytest.MonkeyPatch, **more: str) -> None:
    """Register the methods and the engine as plugins; more : further methods, "module:class" by name."""
    methods = {name: f"{__name__}:{name.title()}" for name in ("leaning", "lost", "raising")} | more
    points = {
        contact.REGISTRY.group: [EntryPoint(name, value, contact.REGISTRY.group) for name, value in methods.items()],
        engines.REGISTRY.group: [
            EntryPoint(name, f"{__name__}:{name.title()}", engines.REGISTRY.group) for name in ("slippery", "starting")
        ],
    }
    monkeypatch.setattr(registry, "_entry_points", lambda group: tuple(points[group]))
