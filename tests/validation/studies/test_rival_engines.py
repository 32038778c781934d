"""The study of rivals' engines: rows of what is not installed, refuses or breaks, and the bounds of the others."""

import textwrap
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from references import engines, registry
from validation.harness.study import Context
from validation.studies import rival_engines
from validation.studies.rival_engines import MESH, Configuration, checks, configurations, rows_of

TOYS = """
    from references.engines.own import Fctd

    class Toy(Fctd):
        name, distribution, does = "toy", "numpy", "moves it"

    class Absent(Toy):
        distribution = "fctd-is-not-called-so"

    class Bare(Toy):
        honours = frozenset()

    class Broken(Toy):
        def begin(self, run):
            raise RuntimeError("out of order")
    """


@pytest.fixture(autouse=True)
def toys(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "toy_engines.py").write_text(textwrap.dedent(TOYS))
    monkeypatch.syspath_prepend(tmp_path)


def plugin(kind: str, monkeypatch: pytest.MonkeyPatch) -> Configuration:
    """A plugin engine, as an entry point of another package."""
    point = EntryPoint("toy", f"toy_engines:{kind}", "fctd_references.engines")
    monkeypatch.setattr(registry, "_entry_points", lambda group: (point,))
    return Configuration("toy", "toy")


def slid(engine: Configuration) -> Any:
    return rows_of(engine, lambda one: rival_engines.slid(one, (0.0,), 0.2))


@pytest.mark.parametrize(
    ("kind", "status", "says"),
    [
        ("Absent", "not installed", ""),
        ("Bare", "refused", "since engine toy leaves out"),
        ("Broken", "broken", "RuntimeError: out of order"),
        ("Toy", "valid", ""),
        ("Missing", "refused", "AttributeError"),
    ],
)
def test_a_plugin_is_a_row_whatever_becomes_of_it(
    kind: str, status: str, says: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (row,) = slid(plugin(kind, monkeypatch))
    assert (row["engine"], row["status"]) == ("toy", status)
    assert says in row["failed"]
    assert "toy" in [engine.label for engine in configurations()]


def test_a_fault_of_an_engine_of_ours_ends_the_study(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(engines.ENGINES, "toy", "toy_engines:Broken")
    with pytest.raises(RuntimeError, match="out of order"):
        list(slid(Configuration("toy", "toy")))


def test_exudyn_has_a_row_with_its_own_contact() -> None:
    (mesh,) = [engine for engine in configurations() if engine.label == MESH]
    assert mesh.options == {"contact": "mesh"}


def tables(**changed: Any) -> dict[str, pd.DataFrame]:
    """Exudyn near FCTD in one hole, and Rapier not installed."""
    near = {"engine": "exudyn", "hole": "arcs", "status": "valid"}
    loads = near | {"hookload_off_percent": -0.1, "torque_off_percent": 0.5} | changed
    absent = {"engine": "rapier", "hole": "arcs", "status": "not installed"}
    friction = near | {"share_of_mu_n": 0.999, "lean_deg": -0.1}
    return {"loads": pd.DataFrame([loads, absent]), "friction": pd.DataFrame([friction, absent])}


def test_a_rival_that_is_not_installed_has_no_bound() -> None:
    made = checks(tables())
    assert {check.name.partition(",")[0].partition(":")[0] for check in made} == {"exudyn"}
    assert {check.verdict for check in made} == {"met"}


@pytest.mark.parametrize(
    ("fault", "missed"),
    [
        ({"hookload_off_percent": -1.1}, "exudyn, arcs: hook load against FCTD's"),
        ({"torque_off_percent": 2.5}, "exudyn, arcs: torque against FCTD's"),
        ({"status": "invalid"}, "exudyn, arcs: run failed a check"),
    ],
)
def test_a_rival_beyond_its_bound_misses_it(fault: dict[str, Any], missed: str) -> None:
    assert [check.name for check in checks(tables(**fault)) if check.verdict == "missed"] == [missed]


def test_the_quick_study_takes_one_hole() -> None:
    assert list(rival_engines.holes(Context(quick=True).quick)) == ["cylinders"]
    assert list(rival_engines.holes(False)) == ["cylinders", "arcs", "turn"]
