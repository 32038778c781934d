"""A checked case has the numbers of ``fctd check``."""

from pathlib import Path

import pytest

import fctd
from fctd.case.errors import InputError
from fctd.model.summary import summarise

EXAMPLE = Path(__file__).parents[2] / "examples" / "my_well.toml"


def test_its_tables_are_the_summary() -> None:
    case = fctd.load_case(EXAMPLE, {"wellbore.intervals[1].friction": 1.2, "name": "<b>"})
    found, summary = fctd.check_case(case), summarise(case)
    assert found.string["buoyed_N"].sum() == summary.buoyed
    assert found.string["clearance_2_m"].tolist() == [part.clearances[1] for part in summary.parts]
    assert found.hole["to_md_m"].tolist() == [1500.0, 3000.0]
    assert found.facts["string in mud"] == f"{summary.buoyed / 1e3:.1f} kN"
    assert [warning.key for warning in found.warnings] == ["wellbore.intervals[1].friction"]
    assert repr(found).startswith("CheckedCase('<b>': 1 warning, 136 segments of 10 to 25 m")
    shown = found._repr_html_()
    assert "warning: wellbore.intervals[1].friction" in shown
    assert "<b></b>" not in shown


def test_a_string_that_does_not_fit_is_refused() -> None:
    with pytest.raises(InputError, match="contact_diameter"):
        fctd.check_case(fctd.load_case(EXAMPLE, {"string.components[0].contact_diameter": "9 in", "operations": None}))
