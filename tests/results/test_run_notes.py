"""Notes on a run: each bound from both sides."""

import pytest

from fctd import simulate
from fctd.results import ledger, run_notes
from fctd.results.notes import Note
from fctd.results.run_notes import brakes_turning, flutters, pushes
from tests.cases import make_case, rotation, trip


def words_of(note: Note | None, code: str, excess: object) -> str:
    """Text and remedy of a note that has to be there, with its code and excess."""
    assert note is not None
    assert (note.code, note.excess) == (code, excess)
    return str(note)


@pytest.mark.parametrize(
    ("mean", "least", "block", "excess"),
    [
        (20e3, -40e3, 0.0, None),  # a wave passes the top: less than a tenth of the weight of 500 kN
        (20e3, -60e3, 0.0, 3.0),  # 10 kN beyond that, twice a hundredth of the weight
        (-4e3, -4e3, 0.0, None),  # within a hundredth of the weight
        (-15e3, -16e3, 0.0, 3.0),
        (-95e3, -140e3, 90e3, None),  # the block weighs as much
        (-185e3, -190e3, 90e3, 2.0),
    ],
)
def test_a_string_pushed_beyond_the_weight_of_the_block(
    mean: float, least: float, block: float, excess: float | None
) -> None:
    note = pushes(mean, least, block, 500e3)
    if excess is None:
        assert note is None
        return
    words = words_of(note, "push", pytest.approx(excess))
    assert f"falls to {least / 1e3:.3g} kN in a step and is {mean / 1e3:.3g} kN on the mean" in words
    assert f"can push with {block / 1e3:.3g} kN" in words


@pytest.mark.parametrize(
    ("amplitude", "frequency", "axial", "noted"),
    [
        (20e3, 15.0, 0.6, True),
        (9.9e3, 15.0, 0.6, False),  # below a fiftieth of the weight
        (20e3, 8.9, 0.6, False),  # slower than half the frequency of a segment on the wall
        (20e3, 15.0, 5.1, False),  # a low axial frequency of a short string
    ],
)
def test_a_hook_load_that_flutters(amplitude: float, frequency: float, axial: float, noted: bool) -> None:
    note = flutters(amplitude, frequency, 18.0, axial, 500e3)
    assert (note is not None) == noted
    if note is not None:
        assert (note.code, note.excess) == ("flutter", pytest.approx(2.0))
        assert "±20 kN at some 15 Hz" in note.text


def test_joint_damping_that_brakes_a_turning_string() -> None:
    assert brakes_turning(9.9, -1000.0) is None
    words = words_of(brakes_turning(50.0, -1000.0), "joint_damping", pytest.approx(5.0))
    assert "takes 50 N·m of the torque of the turning string, 5 % of it" in words
    assert brakes_turning(0.0, 0.0) is None


def test_a_ledger_that_is_off_is_noted_and_beyond_a_tenth_inaccurate() -> None:
    """A rotation that begins within three steps: the step does not resolve it."""
    result = simulate(make_case(operations=[rotation(1000, 0.01)]))
    assert result.run["energy_error"] > 0.1
    assert result.status == "inaccurate"
    assert result.message == str(result.notes[0])
    assert result.notes[0].code == "ledger"
    assert len(result.history) > 0
    slower = simulate(make_case(operations=[trip(900, 899.9, ramp=0.2)]))
    assert slower.status == "completed", slower.run["energy_error"]


@pytest.mark.parametrize(
    ("error", "noted"), [(0.0099, False), (0.0101, True), (0.5, True), (float("nan"), True), (float("inf"), True)]
)
def test_the_ledger_is_doubted_beyond_one_per_cent(error: float, noted: bool) -> None:
    assert (run_notes.ledger_off(error) is not None) == noted


@pytest.mark.parametrize(("error", "status"), [(0.02, "completed"), (0.099, "completed"), (0.101, "inaccurate")])
def test_a_run_is_inaccurate_beyond_a_tenth_of_the_work(
    error: float, status: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(ledger, "error", lambda energy: error)
    result = simulate(make_case(operations=[rotation(1000, 0.1)]))
    assert (result.status, result.notes[0].code) == (status, "ledger")


def test_how_far_a_ledger_is_off() -> None:
    note = run_notes.ledger_off(0.05)
    assert note is not None
    assert (note.code, note.text, note.place) == ("ledger", "the energy ledger is off by 5 %", None)
    assert note.excess == pytest.approx(5.0)


def test_ringing_beyond_its_bound() -> None:
    assert run_notes.rings(1e3, 2.5, 1500.0, 1e3) is None
    assert run_notes.rings(float("nan"), 2.5, 1500.0, 1e3) is None
    words = words_of(run_notes.rings(3e3, 2.5, 1500.0, 1e3), "ringing", 3.0)
    for number in ("2.50 Hz", "near 1500 m", "±3 kN"):
        assert number in words


@pytest.mark.parametrize(
    ("last", "mean", "before", "excess"),
    [
        (10.4e3, 10e3, 10e3, None),  # within 5 %
        (11.1e3, 10e3, 10e3, 2.2),  # the last record is 11 % above its mean
        (10e3, 10e3, 8e3, 4.0),  # still winding up
        (12.0, 8.0, 2.0, None),  # noise: a lever of less than 1 mm of 500 kN
    ],
)
def test_a_torque_that_is_not_steady(last: float, mean: float, before: float, excess: float | None) -> None:
    note = run_notes.torque_swings(last, mean, before, 3.64, 5e5)
    if excess is None:
        assert note is None
        return
    words = words_of(note, "torque", pytest.approx(excess))
    assert f"{last / 1e3:.3g} kN·m, its mean over the last torsional period of 3.64 s 10 kN·m" in words
    assert "mean of its operation" in words


@pytest.mark.parametrize(
    ("swing", "mean", "before", "excess"),
    [
        (24e3, 500e3, 498e3, None),  # within 5 %
        (50e3, 500e3, 500e3, 2.0),  # swings on
        (5e3, 500e3, 400e3, 4.0),  # still rising
        (4e3, 20e3, 20e3, None),  # a fifth of the hook load, but nothing beside the weight of 800 kN
        (16e3, 20e3, 20e3, 2.0),
    ],
)
def test_a_hook_load_that_is_not_steady(swing: float, mean: float, before: float, excess: float | None) -> None:
    note = run_notes.hookload_swings(swing, mean, before, 1.56, 800e3)
    if excess is None:
        assert note is None
        return
    words = words_of(note, "hookload", pytest.approx(excess))
    assert f"swings by ±{swing / 1e3:.3g} kN" in words
    assert "axial period of 1.56 s" in words
    assert "mean of its operation" in words


def test_a_string_whirls_where_it_moves_sideways_and_hardly_slides() -> None:
    """At half the speed of its surface, with a tenth of the torque of sliding."""
    words = words_of(run_notes.whirls(1.0, 2.0, 500.0, 5000.0), "whirl", pytest.approx(0.5 / run_notes.SIDEWAYS))
    assert "50 % of the speed of its surface, and friction has 10 % of the torque" in words
    assert run_notes.whirls(0.2, 2.0, 500.0, 5000.0) is None  # hardly sideways
    assert run_notes.whirls(1.0, 2.0, 4800.0, 5000.0) is None  # slides
    assert run_notes.whirls(1.0, 2.0, 0.0, 0.0) is None  # without friction


def test_a_run_deeper_in_the_wall_than_its_step_holds_for_gets_a_note() -> None:
    assert run_notes.too_deep(0.005, 0.005) is None
    words = words_of(run_notes.too_deep(0.0075, 0.005), "wall", pytest.approx(1.5))
    assert "7.5 mm deep" in words
    assert "largest_penetration" in words


def test_a_bit_that_drills_nothing_is_told_what_its_wear_flats_carry() -> None:
    note = run_notes.drilled_nothing(0.0, 40e3, 54e3)
    assert note is not None
    assert "at most 40 kN" in note.text
    assert "up to 54 kN" in note.text
    assert run_notes.drilled_nothing(1e-6, 40e3, 54e3) is None
    assert run_notes.drilled_nothing(0.0, 60e3, 54e3) is None  # it had no time to


def test_segments_too_long_for_a_winding_hole_get_a_note() -> None:
    assert run_notes.winds_too_much("", 1.0, 1.25) is None
    words_of(run_notes.winds_too_much("segments are too long", 2.5, 1.25), "tortuosity", 2.0)
