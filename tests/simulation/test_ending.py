"""What is said at the end of a run."""

import numpy as np
import pandas as pd
import pytest

from fctd import equilibrium, simulate
from fctd.model.torsion import period_of
from fctd.results.notes import Note
from fctd.simulation.ending import spans_of, torque_note
from fctd.simulation.preparation import prepare
from tests.cases import make_case, pipe


def test_the_torque_at_the_end_is_judged_by_means_over_torsional_periods() -> None:
    """A swing of 10 % about 12 kN·m: a note from short records, none from records of a whole period."""
    stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [1500, 90, 0]]
    turning = {"kind": "rotate_off_bottom", "at_md": 1500, "duration": 60, "rpm": 60}
    run, phases = prepare(make_case(stations, [pipe(None, 60)], operations=[turning]))
    period, span = period_of(run.string), spans_of(run, phases)[-1]

    def note(interval: float) -> Note | None:
        ends = interval * np.arange(1, int(5.25 * period / interval) + 1)
        swings = np.diff(np.append(1.0, np.cos(2 * np.pi * ends / period))) * -period / (2 * np.pi * interval)
        table = {"time_s": ends, "surface_torque_N_m": 12e3 * (1 + 0.1 * swings), "hookload_N": 5e5}
        return torque_note(run, span, pd.DataFrame(table | {"top_rpm": 60.0}))

    assert note(period) is None
    found = note(period / 10)
    assert found is not None
    assert found.code == "torque"
    assert f"torsional period of {period:.3g} s 12 kN·m, and over the one before 12 kN·m" in found.text


@pytest.mark.parametrize(("torque_limit", "told"), [(None, False), ("60 N*m", True)])
def test_a_top_that_turns_more_slowly_than_planned_has_a_note(torque_limit: str | None, told: bool) -> None:
    """Mud alone holds the string, with 94 N m at 60 rev/min; 60 N m turn it at 38."""
    turning = {"kind": "rotate_off_bottom", "at_md": 500, "duration": 150, "rpm": 60, "ramp_time": 1}
    control = {"inertia": 100.0} | ({"torque_limit": torque_limit} if torque_limit else {})
    rig = {"drive": "speed_control", "control": control}
    mud = {"density": 1200.0, "rotational_damping": 0.03}
    result = simulate(make_case([[0.0, 0, 0], [600, 0, 0]], [pipe(None, 10)], operations=[turning], rig=rig, mud=mud))
    notes = [note for note in result.notes if note.code == "torque"]
    assert bool(notes) == told
    if told:
        assert "the top turns at 38.2 of 60 rev/min" in notes[0].text


def test_spans_are_those_of_the_schedule() -> None:
    """A ramp of 1 s at the beginning of 60 s of rotation: steady from there to the end."""
    turning = {"kind": "rotate_off_bottom", "at_md": 500, "duration": 60, "rpm": 60, "ramp_time": 1}
    run, phases = prepare(make_case([[0.0, 0, 0], [600, 0, 0]], [pipe(None, 10)], operations=[turning]))
    (span,) = spans_of(run, phases)
    assert (span.start, span.steady_from, span.steady_to, span.end) == (0.0, 1.0, 60.0, 60.0)
    assert span.rpm == 60.0


@pytest.mark.parametrize("inside", [1100.0, 1900.0])
def test_a_fluid_that_falls_freely_has_a_note(inside: float) -> None:
    """The heavier one, at the rate that the steady string tells."""
    turning = {"kind": "rotate_off_bottom", "at_md": 500, "duration": 2, "rpm": 10, "ramp_time": 1}
    mud = {"density": 1200.0, "viscosity": 0.03, "float": True, "inside": [{"density": inside}]}
    case = make_case([[0.0, 0, 0], [600, 0, 0]], [pipe(None, 10)], operations=[turning], mud=mud)
    found = [note.text for note in simulate(case).notes if note.code == "falling"]
    assert found == [note.text for note in equilibrium(case, "rotate_off_bottom", 500.0).notes]
    assert len(found) == (inside > 1200)
