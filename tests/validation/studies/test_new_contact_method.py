"""A new contact method is one file and one line in the registry; tables and figures then show it."""

import textwrap

import pandas as pd
import pytest

from references import contact
from references.methods import compare
from references.timing.workloads import moving
from reports import figures
from tests.references.listing import listed
from validation.harness.study import Context
from validation.parts import speed_kernel, wall_points
from validation.studies import contact_accuracy, contact_swap, speed

FILE = """
    from fctd.case.errors import Table
    from references.contact.own import ArcOptions, Arcs

    class Options(Table):
        pass

    class Toy:
        name, distribution, does = "toy", "numpy", "asks the engine"
        gives_clearance, Options = True, Options

        def __init__(self, case, options):
            self._own = Arcs(case, ArcOptions())

        def query(self, points, radii):
            return self._own.query(points, radii)

        pieces = 1

        def error_bound(self, curvature):
            return 1e-6, 1e-6
    """


@pytest.fixture
def toy(tmp_path, monkeypatch):
    """The file and the line; of the other methods those that the engine brings, for the sake of time."""
    (tmp_path / "toy_contact.py").write_text(textwrap.dedent(FILE))
    monkeypatch.syspath_prepend(tmp_path)
    for name in [name for name in contact.METHODS if name not in ("cylinders", "arcs")]:
        monkeypatch.delitem(contact.METHODS, name)
    monkeypatch.setitem(contact.METHODS, "toy", "toy_contact:Toy")


def written(study, tables):
    """Every word in the study's figures."""
    found = set()
    for figure in figures.by_study()[study]:
        if figure.name in ("figure_13", "facets"):  # of one mesh each, which is said there
            continue
        canvas = figure.draw(tables)
        canvas.draw_without_rendering()
        for ax in canvas.axes:
            found |= {label.get_text() for label in (*ax.get_xticklabels(), *ax.get_yticklabels())}
            found |= {line.get_label() for line in ax.get_lines()}
    return found


def test_it_is_listed(toy):
    assert "asks the engine" in listed()


@pytest.mark.slow
def test_it_is_in_every_table_of_errors_cost_and_memory(toy, monkeypatch):
    monkeypatch.setattr(compare, "measured_apart", lambda name, case, options: (1.0, 0.1))
    monkeypatch.setattr(contact_accuracy.traps, "TRAPS", [])
    tables = contact_accuracy.run(Context(quick=False)).tables
    errors = tables["errors"].query("method == 'toy'")
    assert set(errors["region"]) == {*wall_points.REGIONS, "overlap"}
    assert errors["largest_penetration_m"].max() < 1e-9
    assert "toy" in set(tables["cost"]["method"])
    assert "toy" in set(tables["builds"]["method"])
    assert "numpy" in set(tables["machine"]["what"])
    assert "toy" in written("contact_accuracy", tables)


@pytest.mark.slow
def test_it_is_raced_and_turns_the_chain(toy, monkeypatch):
    monkeypatch.setattr(contact_swap, "ROUND", 0.0005)
    monkeypatch.setattr(contact_swap, "SEGMENTS", (60,))
    tables = contact_swap.run(Context(quick=True)).tables
    cost = tables["cost"].query("loop == 'toy, from Python'")
    assert cost["segments"].to_list() == [60]
    turned = tables["torques"].set_index("method")
    assert turned.loc["toy", "sum_difference_percent"] == pytest.approx(0.0, abs=1e-6)
    assert pd.notna(turned.loc["toy", "surface_torque_kN_m"])
    assert {"toy, from Python", "toy"} <= written("contact_swap", tables)


@pytest.mark.slow
def test_it_is_among_the_engines_of_the_study_of_speed(toy):
    assert "toy in our loop" in speed.available(quick=True)[0]
    step = moving(speed_kernel.chain(60), 0.0)[0].step
    times, rules = speed.race_engines(["FCTD", "toy in our loop"], {60: step}, 2, 0.0005, Context())
    assert set(rules["engine"]) == {"FCTD"}
    assert (times["gate"] == "passed").all()
    assert set(times.query("engine == 'toy in our loop'")["state"]) == {speed.FREE, speed.TOUCHING, speed.TAKEN}
    assert not times["check"].str.startswith("invalid").any()
    scaling = pd.DataFrame({"segments": [60.0, 170.0], "step_ms": [4.0, 1.4], "ns_least": [20.0, 20.0]})
    scaling = scaling.assign(ns=21.0, ns_low=20.0, ns_high=22.0)
    scaling = speed_kernel.with_growth(scaling)
    ratios = speed.ratios(times, scaling)["ratio"]
    assert ratios.str.startswith("toy in our loop : FCTD, 60 segments, a step").any()
    assert "toy in our loop" in written("speed", {"times": times, "scaling": scaling})
