"""The gate before any speed: what an engine's string must do before its time means anything.

A string without a wall, held at its top, is laid out without stretch and released.  The wave that tells the pipe of its
top runs down at the speed of sound in steel; all pipe below falls freely until it arrives.  Then the string swings
about the length at which it hangs, w L²/2EA longer than its pipe.  Both are exact, need nothing but the interface of
all engines, and are measured at 0 and 4 km of depth, where places in single precision are 0.24 mm apart.  In a level
hole, straight and with a bend, a turning pipe shows wall and friction (``friction_law.py``).  An engine without a wall
is held to the rules of the released string alone.
"""

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Literal, NamedTuple

import numpy as np
import pandas as pd

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.mechanics import state
from fctd.mechanics.moving_string import STILL
from fctd.mechanics.topdrive import GRAVITY, Motion
from fctd.model.drillstring import String
from fctd.simulation.features import refuse
from fctd.simulation.preparation import prepare
from fctd.simulation.run import Run
from fctd.simulation.simulate import Simulation
from references.engines import EngineRun, Stepper, StringEngine, Window
from references.engines.checks import DEEPEST, axial_period
from references.engines.free_bodies import FreeBodies
from references.engines.friction_law import LEAD, sliding_in, straight, with_bend
from references.engines.run import hann_means

DEPTHS = (0.0, 4000.0)  # of the released string's top [m]
LENGTH, SEGMENTS = 1000.0, 40  # segments as long as those of the timed chain, and so the same steps
# Two periods of the swing are read in parts, few enough that an engine takes its own steps in each.  Sound runs down
# the string in five parts, so that in FREE of them, 0.15 s, the bit falls freely.
PARTS, FREE = 40, 4
AZIMUTH, BEND, SECONDS = 30.0, 15.0, 1.0  # of the straight hole, of the bend [deg]; of a window [s], one revolution
STEPS = 20  # over which a string in motion is watched
PASSED = "passed"

# A first-order integrator misses the fall by the share of a step in its time, FCTD by 2.5 %.
MOST_FALL_ERROR, MOST_STRETCH_ERROR = 0.05, 0.01
# Of friction: over μN, against the sliding [deg].  Sound engines have 0.9989 to 1.0003 of μN in holes of three azimuths
# and of three bends, Bullet 0.96 and MuJoCo's default settings 0.95, which fail by their lean.
LEAST_SHARE, MOST_SHARE, MOST_LEAN = 0.94, 1.01, 15.0
LEAST_FORCE, LEAST_SPEED = 1.0, 1e-3  # of a string in motion: sum of its contact forces [N], its fastest surface [m/s]


class Rule(NamedTuple):
    """A rule of the gate: its name, the number measured, its bound and unit, and what it asks, in a sentence.

    at_wall : whether it is about the wall, and says nothing of the times of a string that hangs freely.
    """

    name: str
    value: float
    kind: Literal["at_most", "at_least"]
    bound: float
    unit: str
    asks: str
    at_wall: bool = False

    @property
    def passed(self) -> bool:
        """Whether the bound is met; a value that is not finite meets none."""
        within = self.value <= self.bound if self.kind == "at_most" else self.value >= self.bound
        return bool(np.isfinite(self.value) and within)

    def __str__(self) -> str:
        bound = f"{self.kind.replace('_', ' ')} {self.bound:g}"
        # With as many digits as tell the value from its bound.
        digits = next((k for k in range(3, 7) if f"{self.value:.{k}g}" != f"{self.bound:.{k}g}"), 3)
        return f"{self.name}: {self.value:.{digits}g} {self.unit}".rstrip() + f" ({bound})"


def examine(engine: StringEngine) -> list[Rule]:
    """All rules that apply to an engine with its options, in seconds.

    An error that an engine raises is a broken rule, and the last one.  InputError where it cannot run these cases.
    """
    rules = []
    try:
        for rule in chain(_released(engine), _sliding(engine) if "wall" in engine.honours else ()):
            rules.append(rule)
    except InputError:
        raise
    except Exception as error:  # whatever it raises on a string that has come apart, the other engines go on
        name = f"runs that {type(error).__name__} ended ({error})"
        rules.append(Rule(name, 1, "at_most", 0, "", "an engine ends the runs that it begins"))
    return rules


def verdict(rules: list[Rule], *, touching: bool = True) -> str:
    """``passed``, or ``failed`` with the numbers of the rules that are broken; touching : the string that is timed."""
    broken = [str(rule) for rule in rules if not rule.passed and (touching or not rule.at_wall)]
    return f"failed: {'; '.join(broken)}" if broken else PASSED


def table(found: Mapping[str, list[Rule]]) -> pd.DataFrame:
    """The rules of each engine, by the engine's name in tables, a row for each rule."""
    rows = [
        {"engine": name, "rule": rule.name, "value": rule.value, "bound": rule.bound, "kind": rule.kind,
         "unit": rule.unit, "passed": rule.passed, "asks": rule.asks}
        for name, rules in found.items()
        for rule in rules
    ]  # fmt: skip
    return pd.DataFrame(rows)


def hanging(top: float) -> Case:
    """The case of a string that hangs without a wall from ``top`` [m], in air."""
    pipe = {"name": "pipe", "outer_diameter": 0.102, "inner_diameter": 0.06, "length": LENGTH, "segments": SEGMENTS}
    end = top + LENGTH + 100
    return Case.model_validate(
        {
            "name": "released string",
            "wellbore": {
                "stations": [[0, 0, 0], [end, 0, 0]],
                "intervals": [{"to_md": end, "diameter": 0.3112, "friction": 0}],
            },
            "string": {"top_md": top, "components": [pipe]},
            "mud": {"density": 0, "viscosity": 0},
            "contact": {"enabled": False},
            "operations": [{"kind": "rotate_off_bottom", "at_md": top + LENGTH, "duration": 1, "rpm": 60}],
        }
    )


def fall_and_stretch(engine: StringEngine, top: float) -> tuple[float, float]:
    """Fall of the bit before the wave arrives over ½gt², and mean stretch of the string over w L²/2EA; exact is 1.

    top [m] : depth from which it hangs.
    """
    lowered, interval, string = _lowered(engine, top, PARTS - 1)
    expected = float(string.weight[0]) * LENGTH**2 / (2 * float(string.of("EA")[0]))
    mean = hann_means(pd.DataFrame({"lowered_m": lowered}))["lowered_m"]
    return _fallen(lowered, interval), float(mean / expected)


def fall(engine: StringEngine, top: float) -> float:
    """The fall of ``fall_and_stretch`` alone, which takes a tenth of the time."""
    lowered, interval, _ = _lowered(engine, top, FREE)
    return _fallen(lowered, interval)


def _fallen(lowered: np.ndarray, interval: float) -> float:
    """Fall of the bit before the wave arrives over ½gt²."""
    return float(lowered[FREE - 1] / (0.5 * GRAVITY * (FREE * interval) ** 2))


def _lowered(engine: StringEngine, top: float, parts: int) -> tuple[np.ndarray, float, String]:
    """How far the bit is below its place at the release [m], at the ends of the first parts; their length [s]; the
    string."""
    run, _ = prepare(hanging(top))
    refuse(run, engine.honours, f"engine {engine.name}")
    run.refresh()
    interval, bit = 2 * axial_period(run) / PARTS, state.Z + run.segments
    start, stepper, found = float(run.S[bit]), engine.begin(run), []
    try:
        for _ in range(parts):
            stepper.advance(STILL, interval)
            stepper.refresh()
            found.append(float(run.S[bit]) - start)
    finally:
        stepper.close()
    return np.array(found), interval, run.string


def _released(engine: StringEngine) -> Iterator[Rule]:
    for top in DEPTHS:
        fallen, stretch = fall_and_stretch(engine, top)
        yield Rule(f"error of the fall at {top:g} m", abs(fallen - 1), "at_most", MOST_FALL_ERROR, "",
                   "pipe that nothing holds falls by ½gt²")  # fmt: skip
        yield Rule(f"error of the stretch at {top:g} m", abs(stretch - 1), "at_most", MOST_STRETCH_ERROR, "",
                   "a hanging string is w L²/2EA longer than its pipe")  # fmt: skip


def _sliding(engine: StringEngine) -> Iterator[Rule]:
    runs = [engine.run(case, Window(LEAD, SECONDS)) for case in (straight(AZIMUTH), with_bend(BEND))]
    found = [sliding_in(run) for run in runs]
    yield Rule("depth in the wall over the clearance", _worst(map(_deepest, runs)), "at_most", DEEPEST, "",
               "the string stays in its hole", at_wall=True)  # fmt: skip
    yield Rule("power of the wall's friction", _worst(map(_power, runs)), "at_most", 0.0, "W",
               "friction takes energy from a string that slides, in every tenth of a second", at_wall=True)  # fmt: skip
    yield Rule("largest friction over μN", _worst(each.share for each in found), "at_most", MOST_SHARE, "",
               f"Coulomb's law: 1, in a level hole, straight or with a bend of {BEND:g}°", at_wall=True)  # fmt: skip
    yield Rule("least friction over μN", -_worst(-each.share for each in found), "at_least", LEAST_SHARE, "",
               "Coulomb's law: 1, in the same holes; a string without friction is cheap", at_wall=True)  # fmt: skip
    yield Rule("lean of friction from the sliding", _worst(abs(np.degrees(each.lean)) for each in found), "at_most",
               MOST_LEAN, "°", "Coulomb's law: 0, in the same holes", at_wall=True)  # fmt: skip
    turning = Simulation(straight(AZIMUTH), window=(LEAD, SECONDS))
    turning.start()
    stepper = engine.begin(turning.run)
    try:
        yield from in_motion(turning.run, stepper, turning.intervals[-1].motion, touching=True)
    finally:
        stepper.close()


def in_motion(run: Run, stepper: Stepper, motion: Motion, *, touching: bool) -> Iterator[Rule]:
    """That a string moves, and ``touching`` its wall, over the next steps: a string that sleeps costs nothing."""
    if isinstance(stepper, FreeBodies):
        stepper.watch = touching
    run.drain()
    before = run.time
    stepper.advance(motion, STEPS * stepper.step)
    stepper.refresh()
    n = run.segments
    speeds, spins = (
        np.linalg.norm([state.row(run.S, row, n) for row in rows], axis=0)
        for rows in ((state.VX, state.VY, state.VZ), (state.WX, state.WY, state.WZ))
    )
    fastest = float((speeds + state.row(run.S, state.RADIUS, n) * spins).max())
    yield Rule("speed of the timed string", fastest, "at_least", LEAST_SPEED, "m/s", "what is timed moves")
    if touching:
        force = float(run.drain().normal.sum()) / (run.time - before)
        yield Rule("contact force of the timed string", force, "at_least", LEAST_FORCE, "N",
                   "what is timed in contact touches its wall", at_wall=True)  # fmt: skip


def _worst(values: Iterable[float]) -> float:
    """The largest; nan where one of them is nan."""
    return float(np.max(list(values)))


def _deepest(run: EngineRun) -> float:
    return float(run.checks.loc[run.checks["check"] == "end points inside the hole", "value"].iloc[0])


def _power(run: EngineRun) -> float:
    """Largest power of friction on the string between records [W], below 0 where it takes energy; nan without any."""
    lost, times = np.append(0.0, run.energy["lost_friction_J"]), np.append(LEAD, run.energy["time_s"])
    given = -np.diff(lost) / np.diff(times)
    return float(given.max()) if len(given) else np.nan
