"""The gate before any speed: sound engines pass it or fail as measured, and an offence of each kind fails its rule."""

from typing import Any

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.mechanics import state, topdrive
from fctd.mechanics.topdrive import Motion
from fctd.simulation.run import Run
from references import engines
from references.engines import friction_law, gate
from tests.references.engines.faulty import Faulty, FaultyStepper, through_the_wall

FALLS = [f"error of the {what} at {top:g} m" for top in gate.DEPTHS for what in ("fall", "stretch")]
LEAN = "lean of friction from the sliding"


def broken(engine: Any) -> list[str]:
    return [rule.name for rule in gate.examine(engine) if not rule.passed]


@pytest.mark.parametrize(
    ("name", "options", "failed"),
    [
        ("fctd", {}, []),
        pytest.param("mujoco", {}, [], marks=pytest.mark.slow),
        pytest.param("elastica", {}, [], marks=pytest.mark.slow),
        # Friction along two fixed directions: right in a straight hole to which they are turned, not in a bend.
        pytest.param("bullet", {}, [LEAN], marks=pytest.mark.slow),
        # A pyramid of friction.
        pytest.param("mujoco", {"settings": "default"}, [LEAN], marks=pytest.mark.slow),
        # A ball joint does not stretch; the chain has no wall, so that nothing else is asked.
        ("mujoco_chain", {}, FALLS),
    ],
)
def test_engines_pass_or_fail_as_measured(name: str, options: dict[str, Any], failed: list[str]) -> None:
    rules = gate.examine(engines.build(name, **options))
    assert [rule.name for rule in rules if not rule.passed] == failed
    assert gate.verdict(rules).startswith("failed: " if failed else gate.PASSED)
    assert len(rules) == (4 if name == "mujoco_chain" else 11)


def test_a_sound_string_falls_and_stretches_exactly() -> None:
    """½gt² but for a first-order integrator's share of a step in the time; w L²/2EA but for rounding."""
    fallen, stretched = gate.fall_and_stretch(engines.build("fctd", step=1e-3), 4000.0)
    assert fallen == pytest.approx(1 + 1e-3 / 0.156, abs=1e-3)
    assert gate.fall(engines.build("fctd", step=1e-3), 4000.0) == fallen
    assert stretched == pytest.approx(1, abs=1e-4)


def softer(run: Run) -> None:
    state.row(run.S, state.K_AXIAL, run.segments)[:] *= 0.98


def factors(by: float) -> Faulty:
    """An engine with another friction factor than that of the case."""

    def fault(run: Run) -> None:
        state.row(run.S, state.FRICTION, run.segments)[:] = by * friction_law.FACTOR

    return Faulty(fault, at_start=fault)


def dragged(run: Run) -> None:
    """Friction along the hole of 0.4 times that across it, with μN kept."""
    normal = float(state.row(run.S, state.SUM_NORMAL, run.segments).sum())
    run.top[topdrive.SUM_HOOKLOAD] += 0.37 * friction_law.FACTOR * normal
    state.row(run.S, state.SUM_FRICTION_TORQUE, run.segments)[:] *= 0.9


@pytest.mark.parametrize(
    ("engine", "failed"),
    [
        (Faulty(at_start=softer), {"error of the stretch at 0 m", "error of the stretch at 4000 m"}),
        (Faulty(through_the_wall), {"depth in the wall over the clearance"}),
        (factors(-1.0), {"power of the wall's friction"}),
        (factors(1.02), {"largest friction over μN"}),
        (factors(0.93), {"least friction over μN"}),
        (Faulty(dragged), {LEAN}),
    ],
)
def test_an_offence_breaks_its_rule(engine: Faulty, failed: set[str]) -> None:
    assert failed <= set(broken(engine))


class PositionBased(FaultyStepper):
    """Places in single precision, from which velocities are derived in every step, as position-based engines do."""

    def advance(self, motion: Motion, duration: float) -> None:
        steps = max(int(np.ceil(duration / self.step - 1e-9)), 1)
        rows = ((state.X, state.VX), (state.Y, state.VY), (state.Z, state.VZ))
        for _ in range(steps):
            before = [state.row(self._run.S, place, self._run.segments).copy() for place, _ in rows]
            super().advance(motion, duration / steps)
            for (place, speed), was in zip(rows, before, strict=True):
                now = state.row(self._run.S, place, self._run.segments)
                now[:] = now.astype(np.float32)
                state.row(self._run.S, speed, self._run.segments)[:] = (now - was) * steps / duration


class Asleep(FaultyStepper):
    """Bodies that sleep while the clock goes on."""

    def advance(self, motion: Motion, duration: float) -> None:
        self._run.top[topdrive.TOP_TIME] += duration
        for row in (state.VX, state.VY, state.VZ, state.WX, state.WY, state.WZ):
            state.row(self._run.S, row, self._run.segments)[:] = 0.0


def test_positions_in_single_precision_do_not_fall_at_depth() -> None:
    """At the bit, 5 km down, they are 0.49 mm apart, and gh² is below half of that in FCTD's step h."""
    assert "error of the fall at 4000 m" in broken(Faulty(stepper=PositionBased))
    assert abs(gate.fall(Faulty(stepper=PositionBased), 4000.0)) < 0.5


def test_a_string_that_sleeps_is_found() -> None:
    names = broken(Faulty(stepper=Asleep))
    assert {"speed of the timed string", "contact force of the timed string", "error of the fall at 0 m"} <= set(names)
    assert "largest friction over μN" in names  # no number, since there is no contact force


def test_an_error_of_an_engine_breaks_a_rule_and_a_wrong_case_is_refused() -> None:
    def gives_up(run: Run) -> None:
        raise FloatingPointError("no more")

    rules = gate.examine(Faulty(gives_up))
    assert gate.verdict(rules) == "failed: runs that FloatingPointError ended (no more): 1 (at most 0)"
    with_wall_alone = Faulty()
    with_wall_alone.honours = {"wall", "incline"}  # type: ignore[misc]
    with pytest.raises(InputError, match="without a wall"):
        gate.examine(with_wall_alone)


@pytest.mark.parametrize(("name", "step"), [("fctd", "10.8 ms"), ("bullet", "12 ms")])
@pytest.mark.filterwarnings("ignore")  # of numbers that overflow
def test_an_engine_that_is_unstable_fails(name: str, step: str) -> None:
    rules = {rule.name: rule.passed for rule in gate.examine(engines.build(name, step=step))}
    assert not rules["error of the stretch at 0 m"]
    assert not rules["depth in the wall over the clearance"]


def test_a_rule_that_is_broken_says_what_was_measured() -> None:
    rule = gate.Rule("lean", 19.8, "at_most", 15.0, "°", "Coulomb's law")
    assert gate.verdict([rule]) == "failed: lean: 19.8 ° (at most 15)"
    assert gate.verdict([rule._replace(value=np.nan)]) == "failed: lean: nan ° (at most 15)"
    assert gate.verdict([rule._replace(value=15.0)]) == gate.PASSED
    assert gate.verdict([rule._replace(at_wall=True)], touching=False) == gate.PASSED
    assert gate.verdict([rule], touching=False).startswith("failed")
    table = gate.table({"one": [rule], "two": [rule._replace(value=1.0)]})
    assert table[["engine", "passed"]].to_numpy().tolist() == [["one", False], ["two", True]]


def test_a_broken_rule_shows_as_many_digits_as_tell_it_from_its_bound() -> None:
    rule = gate.Rule("share", 0.89991, "at_least", 0.9, "", "friction is μN")
    assert not rule.passed
    assert str(rule) == "share: 0.8999 (at least 0.9)"
