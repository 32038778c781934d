"""Some items of the fuzzer; `python -m tests.fuzz --count N --seed S` runs more."""

from collections import Counter
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest

from fctd import Case, Equilibrium, Wellbore, load_case
from fctd.model.drillstring import lay_out
from fctd.model.operations import steady_rates
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from tests.fuzz import mechanics, offices
from tests.fuzz.__main__ import campaign, show
from tests.fuzz.campaign import PLAUSIBLE, SIMULATED, judge, make, write
from tests.fuzz.wells import well

SEED = 14


@pytest.mark.parametrize("start", [0, *(pytest.param(start, marks=pytest.mark.slow) for start in (50, 100, 150))])
def test_files_are_refused_or_answered(start: int) -> None:
    """Of fifty items two are plausible wells that are solved six times each."""
    tally: Counter[str] = Counter()
    offences = []
    for index in range(start, start + 50):
        outcome = judge(make(SEED, index), Random(index))
        tally += outcome.tally
        offences += [f"{SEED}:{index} {offence}" for offence in outcome.offences]
    assert offences == []
    assert tally["load: accepted"] + tally["load: refused"] == 50
    # Neither are all files alike, nor are the wells such that hardly any has an answer.
    assert min(tally["load: accepted"] - 2, tally["load: refused"]) >= 8
    assert sum(tally[f"plausible: {status}"] for status in SteadyStatus if status.has_loads) >= 8


@pytest.mark.parametrize("start", [0, pytest.param(300, marks=pytest.mark.slow)])
def test_surveys_of_offices_are_read_as_they_are_meant_or_refused(start: int) -> None:
    read, refused, offences = offices.campaign(SEED, range(start, start + 300))
    assert offences == []
    assert min(read, refused) > 90


def test_wrong_readings_of_an_offices_file_are_seen(tmp_path: Path) -> None:
    content = b"md_ft,inc_deg,azi_deg\n0,0,0\n1000,1,2\n"
    stations = np.array([[0, 0, 0], [304.8, 1, 2]])
    right = offices.Office(content, stations, "ft", said=True)
    assert offices.amiss(right, "si", tmp_path) == ("read", "")
    for wrong in (replace(right, stations=stations * [1 / 0.3048, 1, 1]), replace(right, stations=stations[:1])):
        assert "meant is" in offices.amiss(wrong, "si", tmp_path)[1]
    assert "nobody" in offices.amiss(replace(right, stations=None), "si", tmp_path)[1]
    unitless = replace(right, content=content.replace(b"md_ft", b"md"))
    assert "and names ft" in offices.amiss(unitless, "si", tmp_path)[1]
    assert offices.amiss(replace(unitless, said=False), "si", tmp_path) == ("read", "")
    assert offices.amiss(replace(right, content=b"junk"), "si", tmp_path) == ("refused", "")


def test_a_short_run_of_a_plausible_well() -> None:
    outcome = judge(make(SEED, SIMULATED - 1), Random(0))
    assert outcome.offences == []
    assert outcome.tally["run: completed"] == 1


@pytest.mark.parametrize("index", [0, 1, PLAUSIBLE - 1])
def test_seed_and_index_make_one_item(index: int) -> None:
    assert make(3, index) == make(3, index)
    assert make(3, index) != make(4, index)


@pytest.fixture(scope="module")
def answer(tmp_path_factory: pytest.TempPathFactory) -> tuple[Case, Wellbore, Equilibrium]:
    """A correct answer: a plausible well, picked up."""
    case = load_case(write(well(Random(5)), tmp_path_factory.mktemp("well")))
    solver = Solver(case)
    point = solver.solve("trip_out", steady_rates(case, "trip_out"), case.depths[1])
    assert point.status == "converged"
    assert [*mechanics.finite(point), *mechanics.balance(case, solver.hole, point)] == []
    return case, solver.hole, point


@pytest.mark.parametrize(
    ("wrong", "amiss"),
    [
        ({"status": "fine"}, "status 'fine'"),
        ({"surface_torque": float("nan")}, "surface_torque is nan"),
        ({"hookload": 1.02}, "a hook load of"),
        ({"hookload": 0.98}, "a hook load of"),
        ({"surface_torque": 1e4}, "a surface torque of"),
        ({"sum_r_ft": 1e9}, "beyond Σ r μ F_n"),
        ({"sum_r_mu_fn": 1.01}, "by the profile"),
        ({"total_contact_force": 1.001}, "in the profile"),
        ({"imbalance": 1e3}, "an imbalance of"),
    ],
)
def test_the_checks_see_a_wrong_answer(
    answer: tuple[Case, Wellbore, Equilibrium], wrong: dict[str, Any], amiss: str
) -> None:
    """Numbers about one are factors on the right one."""
    case, hole, point = answer
    changes = {
        name: value * getattr(point, name) if isinstance(value, float) and 0.9 < value < 1.1 else value
        for name, value in wrong.items()
    }
    changed = replace(point, **changes)
    found = [*mechanics.finite(changed), *mechanics.balance(case, hole, changed)]
    assert any(amiss in text for text in found), found


def test_the_checks_see_a_string_of_the_wrong_length(
    answer: tuple[Case, Wellbore, Equilibrium], monkeypatch: pytest.MonkeyPatch
) -> None:
    case, hole, point = answer
    monkeypatch.setattr(mechanics, "lay_out", lambda *at: lay_out(*at).lengthened(9.0))
    assert any("a string of" in text for text in mechanics.balance(case, hole, point))


def test_the_checks_see_a_balance_not_found(answer: tuple[Case, Wellbore, Equilibrium]) -> None:
    case, _, point = answer
    assert list(mechanics.steadiness(case, point)) == []
    assert len(list(mechanics.steadiness(case, replace(point, status=SteadyStatus.MAX_ITERATIONS)))) == 1


def test_the_checks_see_hook_loads_out_of_order(answer: tuple[Case, Wellbore, Equilibrium]) -> None:
    _, _, point = answer
    assert list(mechanics.ordered({"trip_in": point, "trip_out": point})) == []
    more = replace(point, hookload=1.1 * point.hookload)
    assert len(list(mechanics.ordered({"trip_in": more, "rotate_off_bottom": point}))) == 1


def test_what_is_no_input_error_is_an_offence(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def fails(*_: object) -> None:
        raise KeyError("hookload_N")

    monkeypatch.setattr("tests.fuzz.campaign.load_case", fails)
    assert judge(make(SEED, 0), Random(0)).offences[0].startswith("load: KeyError: 'hookload_N'")


def test_the_program_counts_and_writes(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Exit code 1 goes with an offence; the item shown is written unchanged."""
    assert campaign(SEED, range(2, 4)) == 0
    assert "2 items of seed 14" in capsys.readouterr().out
    assert show(SEED, 3, tmp_path) == 0
    assert (tmp_path / "well.toml").read_bytes() == make(SEED, 3).content
    monkeypatch.setattr("tests.fuzz.campaign.SLOWEST_LOAD", -1.0)
    assert campaign(SEED, range(2, 4)) == 1
    assert f"{SEED}:2 load: " in capsys.readouterr().out
    assert show(SEED, 3, tmp_path) == 1
