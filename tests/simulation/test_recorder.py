"""The records of a run, from sums and losses set by hand."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from fctd import open_result, simulate
from fctd.mechanics import state, topdrive
from fctd.mechanics.topdrive import GRAVITY, Motion
from fctd.model.section import section_of
from fctd.results.buckling import NOT_BUCKLED
from fctd.results.columns import TABLES
from fctd.results.notes import MEANINGS
from fctd.simulation.preparation import prepare
from fctd.simulation.recorder import Recorder
from fctd.simulation.settling import settle, start_from_rest
from tests.cases import make_case, pipe, rotation, trip

RIG = {"block_weight": 1e4, "sheave_efficiency": 0.5, "torque_offset": 50.0}


def recorder_of(components: list[dict[str, Any]], profile_at: tuple[float, ...] = (), wall: bool = False) -> Recorder:
    """A string in vertical hole at the start of a trip out of 10 m, at rest and unstretched."""
    sections = {"rig": RIG, "record": {"profile_at": profile_at}, "contact": {"enabled": wall}}
    run, _ = prepare(make_case(components=components, operations=[trip(1000, 990)], **sections))
    start_from_rest(run)
    return Recorder(run)


def test_numbers_of_a_run() -> None:
    """Means over the interval, the speed of the run, and the largest residual of the ledger over the work."""
    recorder = recorder_of([pipe(None, 10)])
    run = recorder.run
    for end in (0.5, 2.0):
        run.advance(Motion(0.0, 1.0, 0.0, 0.0, 0.0, 0.0), end - recorder.last_time)
        recorder.record(0, recorder.run.drain())
    recorder.ledger[0]["residual_J"], recorder.ledger[1]["residual_J"] = -3.0, 1.0
    recorder.ledger[1]["lost_mud_J"] = 1e6
    numbers = recorder.result("completed", "", 4.0, 1e-7).run
    assert numbers["simulated_s"] == pytest.approx(2.0)
    assert (numbers["wall_s"], numbers["real_time_factor"]) == (4.0, pytest.approx(0.5))
    assert (numbers["segments"], numbers["contact"], numbers["settling_residual"]) == (10, "cylinders", 1e-7)
    assert (numbers["steps"], numbers["step_s"]) == (run.steps, run.step)
    assert numbers["pieces_of_hole"] == len(run.hole.pieces)
    assert recorder.result("completed", "", 0.5, 1e-7).run["real_time_factor"] == pytest.approx(4.0)
    assert numbers["energy_error"] == pytest.approx(3.0 / numbers["work_J"])
    assert numbers["work_J"] == pytest.approx(1e6, rel=1e-2)
    idle = Recorder(run).result("unsettled", "", 0.0, float("nan"))
    assert np.isnan([idle.run["real_time_factor"], idle.run["work_J"], idle.run["energy_error"]]).all()
    assert len(idle.profile) == len(idle.history) == len(idle.energy) == 0


def test_a_row_of_history_is_sums_over_its_span() -> None:
    recorder = recorder_of([pipe(300, 6), pipe(None, 1)])
    S, top, n = recorder.run.S, recorder.run.top, recorder.run.segments
    for span in (2.0, 4.0):
        sums = {
            state.SUM_FRICTION_TORQUE: 3.0,
            state.SUM_R_MU_N: 5.0,
            state.SUM_MUD_TORQUE: 7.0,
            state.SUM_NORMAL: 11.0,
        }
        for offset, value in sums.items():
            state.row(S, offset, n)[:] = value
        top[topdrive.TOP_TIME] += span
        top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] = 400.0, 40.0
        recorder.record(0, recorder.run.drain())
        assert not any(state.row(S, offset, n).any() for offset in sums)
        assert not top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]].any()
        row = recorder.history[-1]
        assert row["operation"] == "trip_out"
        expected = {
            "time_s": top[topdrive.TOP_TIME], "bit_depth_m": 1000.0, "bit_md_m": 1000.0, "hookload_N": 400 / span,
            "surface_torque_N_m": 40 / span, "weight_indicator_N": 0.5 * (400 / span + 1e4),
            "drive_torque_N_m": 40 / span + 50, "sum_r_ft_N_m": 3 * n / span, "sum_r_mu_fn_N_m": 5 * n / span,
            "mud_torque_N_m": 7 * n / span, "total_contact_force_N": 11 * n / span, "contact_count": 0,
        }  # fmt: skip
        assert row["buckling"] == "none"
        # No step was taken: the extremes are the means, and the bit's rotation is unknown.
        assert row["hookload_min_N"] == row["hookload_max_N"] == row["hookload_N"]
        assert row["surface_torque_min_N_m"] == row["surface_torque_max_N_m"] == row["surface_torque_N_m"]
        unknown = ("top_rpm", "bit_rpm", "bit_still_s")
        assert np.isnan([row[name] for name in unknown]).all()
        extremes = {name for name in row if "_min_" in name or "_max_" in name}
        others = {"operation", "lateral_speed_m_s", *NOT_BUCKLED.columns(), *unknown, *extremes}
        assert {name: row[name] for name in row if name not in others} == pytest.approx(expected)
        assert list(row) == [column.name for column in TABLES["history"] if column.name in row]


def test_points_in_the_wall_are_counted() -> None:
    recorder = recorder_of([pipe(None, 10)])
    S, n = recorder.run.S, recorder.run.segments
    recorder.run.top[topdrive.TOP_TIME] = 1.0
    state.row(S, state.HOLE, n)[:], state.row(S, state.RADIUS, n)[:] = 0.125, 0.0625
    # The third one is at the wall and not in it.
    state.row(S, state.PX, n)[:] = [0.0, 0.03, 0.0625, 0.063, 0.07, -0.063, -0.03, 0.0, 0.0, 0.063]
    recorder.record(0, recorder.run.drain())
    assert recorder.history[-1]["contact_count"] == 4


def test_the_bit_in_a_hole_that_turns() -> None:
    """Laid on the axis without stretch, it is where its depth says."""
    stations = [[0, 0, 0], [400, 60, 70], [1000, 60, 130]]
    run, _ = prepare(make_case(stations, [pipe(None, 40)], [rotation(900, 5)]))
    recorder = Recorder(run)
    run.top[topdrive.TOP_TIME] = 1.0
    recorder.record(0, run.drain())
    assert recorder.history[0]["bit_md_m"] == pytest.approx(900.0, abs=0.1)


def test_the_ledger_by_hand() -> None:
    """The residual is the top drive's work and the fed pipe's energy, minus the stored and the lost energy."""
    recorder = recorder_of([pipe(None, 10)])
    S, top, n = recorder.run.S, recorder.run.top, recorder.run.segments
    lost = {"friction": state.LOST_FRICTION, "contact": state.LOST_CONTACT, "mud": state.LOST_MUD,
            "joints": state.LOST_JOINT}  # fmt: skip
    for k, offset in enumerate(lost.values(), start=1):
        state.row(S, offset, n)[:] = 10.0**k
    state.row(S, state.VZ, n)[:] = 0.3
    top[[topdrive.TOP_TIME, topdrive.TOP_WORK, topdrive.FED_ENERGY]] = 1.0, 7e5, 2e5
    recorder.record(0, recorder.run.drain())
    (row,) = recorder.ledger
    # Of the 109 m at the top, which are fed, the top drive itself carries half.
    kinetic = 0.5 * 0.09 * 7850 * np.pi / 4 * (0.127**2 - 0.07**2) * (1000 - 0.5 * 109)
    expected = {"time_s": 1.0, "top_drive_work_J": 7e5, "fed_pipe_J": 2e5, "kinetic_J": kinetic, "gravity_J": 0.0}
    expected |= {f"lost_{name}_J": n * 10.0**k for k, name in enumerate(lost, start=1)}
    expected["residual_J"] = kinetic + n * 11110.0 - 9e5
    assert {name: row[name] for name in expected} == pytest.approx(expected, abs=1e-6)


def test_a_profile_is_kept_where_the_bit_passes_its_depth() -> None:
    recorder = recorder_of([pipe(300, 6), pipe(None, 1)], profile_at=(1000.0, 996.0, 995.0, 992.0, 990.0))
    top = recorder.run.top
    kept = []
    for depth in (999.0, 996.5, 994.0, 993.0, 992.0005, 991.0):
        top[topdrive.TOP_LENGTH] = depth - 300.0
        top[topdrive.TOP_TIME] += 1.0
        recorder.record(0, recorder.run.drain())
        kept.append(sorted(recorder.profiles))
    recorder.run.case = make_case(operations=[trip(1000, 990), rotation(990, 5)])
    top[topdrive.TOP_TIME] += 1.0
    recorder.record(1, recorder.run.drain())
    # The first at once, two in one step, one within a millimetre, and the last not at all.
    assert kept == [[1.0], [1.0], [1.0, 3.0], [1.0, 3.0], [1.0, 3.0, 5.0], [1.0, 3.0, 5.0]]
    assert recorder.wanted == [990.0]
    result = recorder.result("completed", "", 1.0, 0.0)
    assert list(result.profile.columns[:2]) == ["bit_depth_m", "operation"]
    assert list(result.profile.index) == list(range(len(result.profile)))
    assert list(result.profile["operation"].unique()) == ["trip_out", "rotate_off_bottom"]
    assert list(result.profile["bit_depth_m"].unique()) == pytest.approx([999.0, 994.0, 992.0005, 991.0])


@pytest.mark.parametrize("long", [False, True])
def test_a_profile_has_the_means_of_its_interval(long: bool) -> None:
    recorder = recorder_of([pipe(300, 6), pipe(None, 1) if long else pipe(None, 14)])
    # In the trip the uppermost segment is the one that is fed.
    assert recorder.run.string.long_segment
    S, top, n = recorder.run.S, recorder.run.top, recorder.run.segments
    top[[topdrive.TOP_TIME, topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] = 1.0, 77.0, 7.0
    recorder.record(0, recorder.run.drain())  # an interval before
    top[topdrive.TOP_TIME] = 3.0
    for offset in (state.SUM_TENSION, state.SUM_TORQUE, state.SUM_NORMAL):
        state.row(S, offset, n)[:] = offset + np.arange(n)
    top[[topdrive.SUM_HOOKLOAD, topdrive.SUM_TOP_TORQUE]] = 400.0, 40.0
    # The lowest segment turned by 0.1 rad against the one above it.
    S[state.AX + n], S[state.AZ + n] = np.sin(0.1), np.cos(0.1)
    recorder.record(0, recorder.run.drain())
    profile = recorder.result("completed", "", 1.0, 0.0).profile
    assert list(profile["operation"].unique()) == ["trip_out"]
    assert len(profile) == n + 1
    # A row for the top and one per contact point, which carries what the joint below it does; the bit carries none.
    below = np.arange(1, n)
    tension = [200.0, *(state.SUM_TENSION + below) / 2, 0.0]
    torque = [20.0, *(state.SUM_TORQUE + below) / 2, 0.0]
    np.testing.assert_allclose(profile["effective_tension_N"], tension)
    np.testing.assert_allclose(profile["torque_N_m"], torque)
    np.testing.assert_allclose(profile["contact_force_N"], [0.0, *(state.SUM_NORMAL + np.arange(n)) / 2])
    bending = np.zeros(n + 1)
    bending[n - 1] = S[state.K_BEND + n] * 0.1
    np.testing.assert_allclose(profile["bending_moment_N_m"], bending, rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("wall", [True, False])
def test_a_string_in_tension_above_and_in_compression_below_is_buckled_where_it_has_a_wall(wall: bool) -> None:
    """A push of 1 MN through the lower 500 m; without a wall no buckling is looked for."""
    recorder = recorder_of([pipe(None, 10)], wall=wall)
    S, top, n = recorder.run.S, recorder.run.top, recorder.run.segments
    top[topdrive.TOP_TIME] = 1.0
    state.row(S, state.SUM_TENSION, n)[:] = np.where(np.arange(n) < n // 2, 1e6, -1e6)
    recorder.record(0, recorder.run.drain())
    row = recorder.history[-1]
    assert row["buckling"] == ("helical" if wall else "none")
    if wall:
        assert 500 <= row["buckled_from_md_m"] < row["buckled_to_md_m"] <= 1000


@pytest.mark.parametrize(("friction", "mode"), [(0.05, "none"), (0.4, "helical")])
def test_every_record_says_where_the_string_is_buckled(friction: float, mode: str, tmp_path: Path) -> None:
    """A string that is pushed into 800 m of level hole: its vertical part buckles, and segments of 20 m cannot."""
    hole = {"geometry": "arcs", "intervals": [{"to_md": 1500, "diameter": 0.2159, "friction": friction}]}
    stations = [[0, 0, 0], [200, 0, 0], [500, 90, 0], [1500, 90, 0]]
    parts = [pipe(1300, None, segment_length=20), pipe(None, 1)]
    result = simulate(make_case(stations, parts, [trip(1318, 1320, speed=0.5, ramp=1.0)], wellbore=hole))
    last, profile = result.history.iloc[-1], result.profile
    assert result.history["buckling"].iloc[-1] == mode
    rows = profile["md_m"][profile["buckling"] != "none"]
    noted = [note for note in result.notes if note.code == "buckling"]
    if mode == "none":
        assert np.isnan([last["buckled_from_md_m"], last["buckled_to_md_m"]]).all()
        assert len(rows) == len(noted) == 0
        return
    assert (last["buckled_from_md_m"], last["buckled_to_md_m"]) == (rows.min(), rows.max())
    (note,) = noted
    assert note.remedy == MEANINGS["buckling"].remedy
    assert "segments of 20 m cannot bend that way; segments of at most" in note.text
    result.save(tmp_path)
    kept = open_result(tmp_path)
    assert kept.notes == result.notes
    assert kept.history["buckling"].tolist() == result.history["buckling"].tolist()


def test_the_steps_of_a_record() -> None:
    """Turned at 60 rev/min for 20 s in hole without a wall: top and bit turn alike but for the swing of the torsion."""
    result = simulate(make_case(operations=[rotation(1000, 20, ramp=5)], contact={"enabled": False}))
    history = result.history
    for load, unit in (("hookload", "N"), ("surface_torque", "N_m")):
        mean, low, high = (history[f"{load}{end}_{unit}"] for end in ("", "_min", "_max"))
        assert ((low <= mean) & (mean <= high)).all()
        assert (low < high).any()
    assert history["top_rpm"].iloc[-10:].to_numpy() == pytest.approx(60.0)
    assert history["bit_rpm"].iloc[-10:].to_numpy() == pytest.approx(60.0, rel=0.01)
    assert history["bit_rpm"].iloc[-10:].mean() == pytest.approx(60.0, rel=1e-3)  # three swings
    assert history["bit_still_s"].iloc[0] > 0.2
    assert not history["bit_still_s"].iloc[-10:].any()


@pytest.mark.parametrize("density", [0.0, 1400.0, 2000.0])
@pytest.mark.parametrize(
    ("operation", "length"), [(rotation(3500, 1.0, rpm=1.0, ramp=0.5), 3500.0), (trip(1000, 2000), 1000.0)]
)
def test_the_bit_lies_deeper_by_weight_and_higher_by_pressure(
    density: float, operation: dict[str, Any], length: float
) -> None:
    """wL²/2EA − (1 − 2ν) ∫p/E of 5 in pipe; the tally of a trip is laid out where the trip ends."""
    part = pipe(None, None, segment_length=50.0, inner=0.10861)
    case = make_case(
        [[0, 0, 0], [3600, 0, 0]], [part], [operation], mud={"density": density}, wellbore={"geometry": "arcs"},
        rig={"feed": "stands"},
    )  # fmt: skip
    of = section_of(case.string.components[0], density)
    exact = of.weight * length**2 / (2 * of.EA) - 0.4 * density * GRAVITY * length**2 / 2 / 206.8e9
    run, _ = prepare(case)
    settle(run)
    assert Recorder(run)._bit_md() - length == pytest.approx(exact, abs=3e-4)
