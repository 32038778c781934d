"""Charts: rows, order, friction, bad input."""

from typing import Any

import numpy as np
import pandas as pd
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd import InputError, equilibrium, load_case, torque_drag
from fctd.case.load import with_friction
from fctd.model.operations import SteadyRates
from fctd.steady.carried_shape import Carried
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.problem import Problem
from fctd.steady.reading import Answer
from fctd.steady.steady_string import Equilibrium
from tests.cases import level_case, make_case, pipe

STATIONS = [[0, 0, 0], [300, 0, 0], [600, 50, 0], [900, 50, 0]]
COLUMNS = [
    "operation", "friction", "rotational_friction", "friction_label", "bit_depth_m", "speed_m_s", "rpm", "flow_m3_s",
    "weight_on_bit_N", "hookload_N", "surface_torque_N_m", "weight_indicator_N",
    "drive_torque_N_m", "total_contact_force_N", "buckling", "buckled_from_md_m", "buckled_to_md_m", "shape",
    "hookload_low_N", "hookload_high_N", "slack_off_spent_at", "locked_up_at", "status", "iterations", "notes",
    "reason",
]  # fmt: skip


def case_of(**more: Any) -> Any:
    intervals = [{"to_md": 500, "diameter": 0.3, "friction": 0.1}, {"to_md": 900, "diameter": 0.2159, "friction": 0.3}]
    return make_case(
        STATIONS, [pipe(None, None, segment_length=20.0)], wellbore={"intervals": intervals},
        rig={"block_weight": 1e5, "sheave_efficiency": 0.9, "torque_offset": 500.0}, **more,
    )  # fmt: skip


@settings(max_examples=12, deadline=None)
@given(
    depths=st.sets(st.integers(100, 900), min_size=1, max_size=60), threads=st.integers(2, 5), kinds=st.integers(1, 3)
)
def test_the_rows_of_a_chart_do_not_depend_on_the_number_of_threads(depths: set[int], threads: int, kinds: int) -> None:
    asked = ["trip_out", "rotate_off_bottom", "trip_in"][:kinds], sorted(map(float, depths))
    alone, together = (torque_drag(case_of(), *asked, threads=count) for count in (1, threads))
    pd.testing.assert_frame_equal(alone, together, check_exact=True)


@pytest.mark.slow
def test_rows_that_need_other_methods_are_the_same_on_several_threads() -> None:
    asked = level_case(), ["drill_sliding", "trip_in"], [float(depth) for depth in range(0, 151, 30)], [0.2, 0.5]
    alone, together = (torque_drag(*asked, threads=count) for count in (1, 3))
    assert set(alone["status"]) == {"converged", "not_possible"}
    assert (alone["shape"] == "helix").any()
    pd.testing.assert_frame_equal(alone, together, check_exact=True)


def test_a_row_per_operation_friction_and_depth() -> None:
    """In that order, each row what ``equilibrium`` gives by itself."""
    seen: list[tuple[int, int]] = []
    chart = torque_drag(
        case_of(), ["trip_out", "rotate_off_bottom"], range(500, 901, 200), friction=[0.1, 0.3],
        progress=lambda done, total: seen.append((done, total)),
    )  # fmt: skip
    assert list(chart.columns) == COLUMNS
    assert seen == [(k, 12) for k in range(1, 13)]
    assert list(chart["operation"]) == ["trip_out"] * 6 + ["rotate_off_bottom"] * 6
    assert list(chart["friction"]) == ([0.1] * 3 + [0.3] * 3) * 2
    assert list(chart["bit_depth_m"]) == [500.0, 700.0, 900.0] * 4
    assert (chart["status"] == "converged").all()
    by_friction = chart.pivot_table(index=["operation", "bit_depth_m"], columns="friction", values="hookload_N")
    assert (by_friction.loc["trip_out", 0.3] > by_friction.loc["trip_out", 0.1]).all()

    whole = torque_drag(case_of(), "trip_out", [900.0], friction=np.int64(0)).iloc[0]
    assert whole["friction"] == 0.0
    own = torque_drag(case_of(), "trip_out", [900.0]).iloc[0]
    point = equilibrium(case_of(), "trip_out", 900.0)
    assert np.isnan(own["friction"])
    assert own["hookload_N"] == point.hookload
    # Hoisting through sheaves of 90 % lowers what the dead line feels.
    assert own["weight_indicator_N"] == pytest.approx(0.9 * (point.hookload + 1e5))
    assert own["drive_torque_N_m"] == pytest.approx(point.surface_torque + 500.0)
    # Drilling lowers the block.
    for kind in ("drill_rotating", "drill_sliding"):
        down = equilibrium(case_of(), kind, 900.0)
        assert down.weight_indicator == pytest.approx((down.hookload + 1e5) / 0.9)


def test_friction_by_kind_of_interval() -> None:
    """The rows are those of a case with these factors, and a label says which they are."""

    def well(cased: float, below: float) -> Any:
        rows = [(500, 0.3, "cased", cased), (700, 0.25, "cased", cased), (900, 0.2159, "open", below)]
        keys = ("to_md", "diameter", "kind", "friction")
        intervals = [dict(zip(keys, row, strict=True)) for row in rows]
        return make_case(STATIONS, [pipe(None, None, segment_length=20.0)], wellbore={"intervals": intervals})

    chart = torque_drag(well(0.1, 0.1), "trip_out", [900.0], [{"cased": 0.2, "open": 0.4}, 0.3, {"open": 0.4}])
    assert chart["friction_label"].tolist() == ["cased 0.20, open 0.40", "0.3", "open 0.40"]
    assert chart["friction"].isna().tolist() == [True, False, True]
    for row, case in zip(chart.to_dict("records"), (well(0.2, 0.4), well(0.3, 0.3), well(0.1, 0.4)), strict=True):
        assert row["hookload_N"] == equilibrium(case, "trip_out", 900.0).hookload
    assert (chart["rotational_friction"].fillna(-1) == chart["friction"].fillna(-1)).all()
    own = torque_drag(case_of(), "trip_out", [900.0])
    assert own["friction_label"].tolist() == ["case's own: 0.1 down to 500 m, 0.3 below"]


def test_friction_that_differs_along_and_around_the_hole() -> None:
    """Drag has the one, torque the other; rows beside it in the chart, with equal factors, stay as they are."""
    case, kinds = case_of(), ["trip_out", "rotate_off_bottom", "back_ream"]
    sets: list[Any] = [0.3, "0.3/0.1", "0.1/0.3", 0.1, "0.3/0.2999999"]
    chart = torque_drag(case, kinds, [700.0, 900.0], sets, rpm=15.0)
    assert chart["friction_label"].unique().tolist() == ["0.3", "0.3/0.1", "0.1/0.3", "0.1", "0.3/0.3"]
    assert chart["friction"].iloc[:10].tolist() == [0.3, 0.3, 0.3, 0.3, 0.1, 0.1, 0.1, 0.1, 0.3, 0.3]
    assert chart["rotational_friction"].iloc[:8].tolist() == [0.3, 0.3, 0.1, 0.1, 0.3, 0.3, 0.1, 0.1]
    assert (chart["status"] == "converged").all()
    alone = torque_drag(case, kinds, [700.0, 900.0], [0.3, 0.1], rpm=15.0)
    equal = chart[chart["friction_label"].isin(["0.3", "0.1"])].reset_index(drop=True)
    pd.testing.assert_frame_equal(equal, alone, check_exact=True)
    columns = ["hookload_N", "surface_torque_N_m"]
    rows = chart.pivot_table(index=["operation", "bit_depth_m"], columns="friction_label", values=columns)
    hook, torque = rows["hookload_N"], rows["surface_torque_N_m"]
    drawn = hook.loc["trip_out"]  # without rotation
    for label, along, around in (("0.3/0.1", "0.3", "0.1"), ("0.1/0.3", "0.1", "0.3")):
        np.testing.assert_allclose(drawn[label], drawn[along], rtol=1e-9)
        np.testing.assert_allclose(
            torque.loc["rotate_off_bottom", label], torque.loc["rotate_off_bottom", around], rtol=1e-4
        )
    # A string that turns slowly as it slides has most of the larger one, more of it than by components.
    assert (hook.loc["back_ream", "0.3/0.1"] > hook.loc["back_ream", "0.3"]).all()
    assert (torque.loc["back_ream", "0.1/0.3"] > torque.loc["back_ream", "0.3"]).all()
    np.testing.assert_allclose(hook["0.3/0.3"], hook["0.3"], rtol=1e-6)
    changed = with_friction(case, "0.3/0.1")
    assert equilibrium(changed, "back_ream", 900.0, rpm=15.0).hookload == hook.loc[("back_ream", 900.0), "0.3/0.1"]
    own = torque_drag(changed, "back_ream", [900.0], rpm=15.0)
    assert own["friction_label"].tolist() == ["0.3/0.1"]
    assert own["hookload_N"].iloc[0] == hook.loc[("back_ream", 900.0), "0.3/0.1"]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ({"bit_depths": []}, "bit_depths = []: expected at least one bit depth"),
        ({"bit_depths": [500, 400]}, 'bit_depths = "400 m": expected finite bit depths, each below the one before'),
        ({"bit_depths": [500, 500]}, 'bit_depths = "500 m": expected finite bit depths'),
        ({"bit_depths": [500, float("nan")]}, "expected finite bit depths"),
        ({"bit_depths": [500, float("inf")]}, "expected finite bit depths"),
        ({"bit_depths": [950, 960]}, 'bit_depth = "950 m": expected a depth below string.top_md, 0 m, within'),
        ({"operation": []}, "expected at least one kind of operation"),
        ({"operation": ["trip_in", "wiggle"]}, 'operation = "wiggle": expected one of the kinds'),
        ({"friction": -0.1}, "friction = -0.1: expected a friction factor at least 0"),
        (
            {"friction": [0.2, 20]},
            "friction = 20: expected a friction factor at least 0 and at most 5 (20 looks like '0.2')",
        ),
        ({"friction": []}, "friction = []: expected at least one friction factor"),
        ({"speed": -1.0}, "speed = -1.0: expected a speed above 0"),
        ({"bit_depths": [[500.0]]}, "bit_depths = [[500.0]]: expected a list of bit depths"),
        ({"bit_depths": "bottom"}, 'bit_depths = "bottom": expected a length such as'),
        ({"bit_depths": [500, "600 kg"]}, 'bit_depths[1] = "600 kg": expected a length such as'),
        ({"friction": "0.2"}, 'friction = "0.2": expected a friction factor'),
        ({"friction": [0.1, "0.2"]}, 'friction = "0.2": expected a friction factor'),
        ({"friction": {"cased": 0.2}}, 'wellbore.intervals[0].kind is missing: expected "cased" or "open"'),
        ({"friction": {"casing": 0.2}}, 'friction = {"casing": 0.2}: expected one of the kinds cased, open'),
    ],
)
def test_bad_input_is_refused(call: dict[str, Any], expected: str) -> None:
    arguments: dict[str, Any] = {"operation": "trip_in", "bit_depths": [500.0]} | call
    with pytest.raises(InputError) as error:
        torque_drag(case_of(), **arguments)
    assert expected in str(error.value)


def test_an_error_names_the_case_file(tmp_path: Any) -> None:
    file = tmp_path / "well.toml"
    file.write_text(
        'name = "w"\n[wellbore]\nstations = [[0,0,0],[900,0,0]]\n[[wellbore.intervals]]\nto_md = 900\n'
        'diameter = 0.2\nfriction = 0.2\n[[string.components]]\nname = "pipe"\nouter_diameter = 0.1\n'
        "inner_diameter = 0.05\nsegment_length = 30\n"
    )
    with pytest.raises(InputError, match=r"well\.toml: bit_depth = \"1000 m\""):
        torque_drag(load_case(file), "trip_in", [1000.0])


def test_a_depth_that_does_not_fit_is_a_row_with_its_reason() -> None:
    """Too shallow, in the hole, too wide for the hole below 600 m, and beyond the survey."""
    hole = [{"to_md": 600, "diameter": 0.3, "friction": 0.2}, {"to_md": 900, "diameter": 0.12, "friction": 0.2}]
    case = make_case(
        [[0, 0, 0], [900, 0, 0]], [pipe(None, None, 0.15, segment_length=20.0)], wellbore={"intervals": hole}
    )
    chart = torque_drag(case, ["trip_in", "trip_out"], [0.0, 500.0, 700.0, 1000.0], friction=[0.1, 0.2])
    assert chart["status"].tolist() == 4 * ["not_possible", "converged", "not_possible", "not_possible"]
    lost = chart["status"] == "not_possible"
    assert chart.loc[lost, "hookload_N":"total_contact_force_N"].isna().all(axis=None)
    assert (chart.loc[lost, "iterations"] == 0).all()
    assert (chart["shape"] == "none").all()
    assert chart["reason"].tolist()[:2] == ['bit_depth = "0 m": expected a depth below string.top_md, 0 m, within '
                                            "survey and intervals, 900 m", "none"]  # fmt: skip
    assert "contact_diameter" in chart["reason"][2]
    assert type(chart["status"][0]) is str


def test_a_row_that_cannot_be_laid_out_does_not_end_the_chart(monkeypatch: pytest.MonkeyPatch) -> None:
    """As a resolved string may be, of which only the solver finds out."""
    first = Solver.first

    def none_at_800(solver: Solver, kind: str, rates: SteadyRates, laid: LaidString, answer: Answer) -> Any:
        return None if laid.string.bit_depth == 800 else first(solver, kind, rates, laid, answer)

    def refuse(solver: Solver, problem: Problem, above: Carried | None) -> Equilibrium:
        raise InputError("at most 10 segments", key="string.components")

    monkeypatch.setattr(Solver, "first", none_at_800)
    monkeypatch.setattr(Solver, "solve_problem", refuse)
    chart = torque_drag(case_of(), "trip_out", [700.0, 800.0, 850.0])
    assert chart["status"].tolist() == ["converged", "not_possible", "converged"]
    assert chart["reason"][1] == "string.components is missing: expected at most 10 segments"


def test_a_row_without_loads_has_the_reason_of_the_solver() -> None:
    """In a wall of 1 kN/m a string lies deeper than the hole is wide."""
    case = case_of()
    soft = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"stiffness": 1e3})})
    row = torque_drag(soft, "trip_out", [900.0]).iloc[0]
    point = equilibrium(soft, "trip_out", 900.0)
    assert row["status"] == "diverged"
    assert row["reason"] == point.message
    assert "deeper in the wall" in point.message


def test_a_resolved_row_has_both_shapes_also_where_it_begins_with_those_above() -> None:
    """At 2.6 times the sinusoidal limit a helix and snaking are both balances; the helix has the lower energy."""
    chart = torque_drag(level_case(), ["drill_sliding", "trip_in"], [120.0, 150.0], friction=[0.2, 0.5])
    row = chart.iloc[3]
    assert (row["status"], row["shape"], row["buckling"]) == ("converged", "helix", "helical")
    assert row["hookload_N"] == row["hookload_low_N"] < row["hookload_high_N"] < -300e3
    assert (chart["shape"][4:] == "none").all()
    assert chart.loc[4:, "hookload_low_N":"locked_up_at"].isna().all(axis=None)
    alone = torque_drag(level_case(), "drill_sliding", [150.0], friction=0.5).iloc[0]
    assert row["iterations"] < 0.6 * alone["iterations"]
    assert row["hookload_N"] == pytest.approx(alone["hookload_N"], rel=2e-3)


def test_a_string_that_no_push_moves_has_no_loads_but_says_where_it_locked_up() -> None:
    chart = torque_drag(level_case(rig={"block_weight": 3.5e5}), "drill_sliding", [80.0], friction=4.0)
    (row,) = chart.to_dict("records")
    assert (row["status"], row["buckling"]) == ("locked_up", "unknown")
    loads = chart.loc[:, "hookload_N":"total_contact_force_N"]
    assert loads.isna().all(axis=None)
    assert 0 < row["slack_off_spent_at"] < row["locked_up_at"] < 1
    spent, locked = (f"{100 * row[name]:.3g} %" for name in ("slack_off_spent_at", "locked_up_at"))
    assert row["reason"] == f"slack-off is spent at {spent}, the string is locked up at {locked} of the friction"
