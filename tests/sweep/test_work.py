"""The work of a sample: rows of charts, equilibria, refinements and runs, and their depths."""

from dataclasses import replace
from pathlib import Path
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest

from fctd import simulate, torque_drag
from fctd.case.errors import InputError
from fctd.case.load import Case, load_case
from fctd.steady.equilibrium import equilibrium
from fctd.sweep.spec import WorkSpec
from fctd.sweep.work import WORK, Row, Task, TooLongError, misfit, task_of
from validation.parts.small_sweep import case_file

RUN = """
[record]
interval = "0.5 s"
[[operations]]
kind = "rotate_off_bottom"
at_md = "600 m"
rpm = 60
duration = "4 s"
ramp_time = "1 s"
"""


def task(case: Case, **spec: object) -> Task:
    return task_of(WorkSpec.model_validate(spec), case)


def rows(case: Case, tick: object = None, **spec: object) -> list[Row]:
    of = task(case, **spec)
    return WORK[of.spec.kind](case, of, (lambda: None) if tick is None else tick)  # type: ignore[arg-type]


def test_a_chart_has_the_rows_of_the_command(tmp_path: Path) -> None:
    case = load_case(case_file(tmp_path))
    found = rows(case, operations=["trip_in", "trip_out"], depths="600:900:150")
    wanted = torque_drag(case, ["trip_in", "trip_out"], [600, 750, 900])
    pd.testing.assert_frame_equal(pd.DataFrame(found), wanted, check_exact=True, check_dtype=False)


def test_an_equilibrium_has_the_loads_and_extremes_of_its_profile(tmp_path: Path) -> None:
    case = load_case(case_file(tmp_path))
    (row,) = rows(case, kind="equilibrium", operations=["trip_out"], bit_depth="850 m")
    point = equilibrium(case, "trip_out", 850.0)
    assert row["hookload_N"] == point.hookload
    assert row["max_von_mises_Pa"] == point.profile["von_mises_Pa"].max()
    assert row["status"] == "converged"


def test_a_refinement_is_one_row(tmp_path: Path) -> None:
    case = load_case(case_file(tmp_path))
    (row,) = rows(case, kind="refine", operations=["trip_out"], bit_depth="600 m", tolerance=0.05)
    assert row["status"] == "within_tolerance"
    assert 0 < row["error"] < 0.05


def test_a_run_has_a_row_for_each_operation_with_the_severity_of_its_stick_slip(tmp_path: Path) -> None:
    """Half of the bit's swing over the mean rotation of the top, in the last half of the operation."""
    case = load_case(case_file(tmp_path, RUN))
    (row,) = rows(case, kind="simulate")
    late = simulate(case).history.query("time_s > 2.01")
    assert late["time_s"].tolist() == pytest.approx([2.5, 3.0, 3.5, 4.0])
    swing = np.ptp(late["bit_rpm"])
    assert swing > 1
    assert row["stick_slip_severity"] == pytest.approx(swing / 2 / late["top_rpm"].mean())
    assert row["operation"] == "rotate_off_bottom"
    assert row["status"] == "completed"


def test_a_string_that_fits_at_no_depth_is_told_of_the_first(tmp_path: Path) -> None:
    case = load_case(case_file(tmp_path))
    unfit = Task(WorkSpec(operations=("trip_in",), depths=(1000.0, 1100.0)), (1000.0, 1100.0))
    assert "1000 m" in str(misfit(case, unfit))
    assert misfit(case, replace(unfit, depths=(1000.0, 800.0))) is None


def test_a_run_needs_operations(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="operations of the case"):
        task(load_case(case_file(tmp_path)), kind="simulate")


@pytest.mark.parametrize(
    "spec",
    [
        {"operations": ["trip_in"], "depths": "600:900:50"},
        {"kind": "equilibrium", "operations": ["trip_in"], "bit_depth": 800},
        {"kind": "refine", "operations": ["trip_in"], "bit_depth": 600},
        {"kind": "simulate"},
    ],
)
def test_every_work_asks_the_clock(spec: dict[str, object], tmp_path: Path) -> None:
    with pytest.raises(TooLongError):
        rows(load_case(case_file(tmp_path, RUN)), Mock(side_effect=TooLongError), **spec)


def test_depths_are_a_list_or_written(tmp_path: Path) -> None:
    case = load_case(case_file(tmp_path))
    assert task(case, operations=["trip_out"], depths=[700.0]).depths == (700.0,)
    assert task(case, operations=["trip_out"], depths="2000 ft:td:1000 ft").depths == (609.6, 900.0)
    with pytest.raises(InputError, match=r"work\.depths"):
        task(case, operations=["trip_out"], depths="600:900")


def test_rates_that_no_operation_takes_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        task(load_case(case_file(tmp_path)), operations=["rotate_off_bottom"], depths=[600], speed=0.3)
