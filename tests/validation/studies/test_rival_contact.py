"""Rivals' contact methods in their study: measured where they are installed, and rows ``not installed`` elsewhere."""

import textwrap
from importlib.metadata import EntryPoint

import pandas as pd
import pytest

from references import contact, registry
from references.contact import traps
from references.methods import compare
from references.rivals import METHODS
from reports import figures
from validation.harness.study import Context
from validation.studies import rival_contact
from validation.studies.rival_contact import NOT_INSTALLED, checks, with_missing

# Of the baselines those that the engine brings, and few points, for the sake of time.
TABLES = ("errors", "fronts", "depth")
GOOD = """
    from fctd.case.errors import Table
    from references.contact.own import ArcOptions, Arcs

    class Toy(Arcs):
        name, distribution, does, Options = "toy", "numpy", "asks the engine", ArcOptions

    class Broken(Toy):
        name = "broken"

        def query(self, points, radii):
            raise RuntimeError("a wall is missing")
    """


def written(tables: dict[str, pd.DataFrame]) -> set[str]:
    """The names in the legend of the study's figure."""
    (figure,) = figures.by_study()["rival_contact"]
    return {str(line.get_label()) for ax in figure.draw(tables).axes for line in ax.get_lines()}


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """The study without what takes long and is not asked here."""
    monkeypatch.setattr(compare, "measured_apart", lambda name, case, options: (1.0, 0.1))
    monkeypatch.setattr(rival_contact, "COUNTS", (1, 1000))


@pytest.mark.slow
@pytest.mark.usefixtures("small")
def test_rivals_that_are_not_installed_have_a_row_in_every_table(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(contact, "installed_version", lambda name: None if name in METHODS else "1")
    monkeypatch.setattr(traps, "installed", lambda trap: False)
    outcome = rival_contact.run(Context(quick=True))
    for name in TABLES:
        table = outcome.tables[name]
        assert table.loc[table["status"] == NOT_INSTALLED, "method"].to_list() == list(METHODS)
    assert set(outcome.tables["errors"]["method"]) == {*rival_contact.BASELINES, *METHODS}
    assert set(outcome.tables["traps"]["status"]) == {NOT_INSTALLED}
    assert sum("make rivals" in note for note in outcome.notes) == len(METHODS)
    # What was not measured meets no bound and misses none.
    assert {check.verdict for check in outcome.checks} == {"met"}


@pytest.mark.slow
@pytest.mark.usefixtures("small")
def test_a_plugin_has_its_rows_and_a_broken_one_its_reason(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "toy_plugin.py").write_text(textwrap.dedent(GOOD))
    monkeypatch.syspath_prepend(tmp_path)
    group = contact.REGISTRY.group
    points = tuple(
        EntryPoint(name, f"{module}:{name.title()}", group)
        for name, module in (("toy", "toy_plugin"), ("broken", "toy_plugin"), ("absent", "no_such_module"))
    )
    monkeypatch.setattr(registry, "_entry_points", lambda asked: points if asked == group else ())
    monkeypatch.setattr(rival_contact, "METHODS", {})
    monkeypatch.setattr(traps, "installed", lambda trap: False)
    outcome = rival_contact.run(Context(quick=True))
    toy = outcome.tables["errors"].query("method == 'toy'")
    assert toy["largest_penetration_m"].max() < 1e-9
    assert outcome.tables["fronts"].query("method == 'toy'")[["measured_1", "measured_1000"]].all(axis=None)
    refused = outcome.tables["refused"].set_index("setting")["why"]
    assert refused["broken"] == "failed: RuntimeError: a wall is missing"
    assert "No module named 'no_such_module'" in refused["absent"]
    assert "toy" in written(outcome.tables)
    # The screen names them, and the exit code is 1.
    (unusable,) = [check for check in outcome.checks if check.name == "settings of plugins that cannot be used"]
    assert unusable.verdict == "missed"
    assert "broken: RuntimeError: a wall is missing" in unusable.source


def test_a_rival_too_far_from_the_mesh_is_a_missed_check() -> None:
    cost = pd.DataFrame(
        {"method": ["arcs", "warp"], "arcs_1000": [1.0, 5.5], "arcs_1000_low": [1.0, 4.0], "arcs_1000_high": [1.0, 6.0]}
    )
    deep = pd.DataFrame(
        {"method": "warp", "depth_m": [1000.0, 8000.0, 8000.0], "origin": ["well", "chunk", "well"],
         "largest_distance_mm": [0.08, 0.12, 0.6]}
    )  # fmt: skip
    verdicts = {check.name: check.verdict for check in checks(cost, deep)}
    assert verdicts["warp: from the mesh in double precision, to 1 km about the origin of the well"] == "met"
    assert verdicts["warp: from the mesh in double precision, to 8 km in chunks"] == "missed"
    assert verdicts["fastest rival over FCTD's arcs, 1000 points"] == "missed"
    assert with_missing(cost, "setting", []) is cost


@pytest.mark.rivals
@pytest.mark.usefixtures("small")
def test_every_rival_is_measured() -> None:
    outcome = rival_contact.run(Context(quick=True))
    for name in TABLES[:2]:
        assert set(METHODS) <= set(outcome.tables[name].query("status == 'measured'")["method"])
    depth = outcome.tables["depth"]
    assert set(depth["method"]) == set(METHODS)
    assert (depth["no_answer_percent"] == 0).all()
    assert (depth["largest_distance_mm"] <= depth["bound_mm"]).all()
    assert (outcome.tables["traps"]["found"] > 0).all()
    assert {check.verdict for check in outcome.checks} == {"met"}
