"""Results in notebooks and at the prompt: short, with units, escaped."""

import inspect
import pickle
import sys
from importlib import import_module

import pytest

import fctd
from fctd.answers.display import html_table, load_rows, picture
from fctd.case.errors import InputError
from fctd.results.shown_tables import facts
from fctd.steady import steady_string
from fctd.steady.equilibrium import equilibrium as solve
from tests.cases import make_case


def test_loads_have_labels_and_units() -> None:
    assert load_rows({"hookload_N": 803_000.0, "surface_torque_N_m": float("nan")}, "si") == {
        "hook load": "803.0 kN",
        "surface torque": "–",
    }


def test_texts_are_escaped() -> None:
    table = html_table(facts("a <b> & c", [("<i>", "1 < 2")]))
    assert "a &lt;b&gt; &amp; c" in table
    assert "<td>&lt;i&gt;</td>" in table
    assert "1 &lt; 2" in table


def test_a_picture_whose_package_is_missing_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    monkeypatch.delitem(sys.modules, "fctd.plots.profile", raising=False)
    with pytest.raises(InputError, match=r"expected the package matplotlib \(pip install 'fctd\[plot\]'\)"):
        picture(lambda: import_module("fctd.plots.profile").profile_figure([]))  # ``plots`` keeps what it has found


def test_an_answer_is_the_record_of_a_lower_room() -> None:
    """Who has the one may use it as the other; its class has the same docstring."""
    point = fctd.equilibrium(make_case(), "trip_out", 900)
    assert type(point) is fctd.Equilibrium
    assert isinstance(point, steady_string.Equilibrium)
    assert type(point.without_loads()) is fctd.Equilibrium
    assert fctd.Equilibrium.__doc__ == inspect.getdoc(steady_string.Equilibrium)


def test_a_function_of_answers_has_the_arguments_of_the_lower_one() -> None:
    """Processes that share the work find it by its name."""
    assert inspect.signature(fctd.equilibrium) == inspect.signature(solve)
    assert fctd.equilibrium.__doc__ == solve.__doc__
    assert pickle.loads(pickle.dumps(fctd.equilibrium)) is fctd.equilibrium


def test_a_case() -> None:
    assert repr(make_case()) == str(make_case()) == "Case('test')"
