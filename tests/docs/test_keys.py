"""The table of case keys is that of the models, that of columns the one of the results."""

from pathlib import Path

import pytest

from docs import columns, keys
from fctd.case.load import KINDS, Case

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.parametrize(("name", "page"), [("keys", keys.page()), ("columns", columns.page())])
def test_a_page_that_is_made_is_up_to_date(name: str, page: str) -> None:
    assert (DOCS / f"{name}.md").read_text(encoding="utf-8") == page, "run: python -m docs"


def test_every_key_has_its_line() -> None:
    models = {"wellbore": Case.model_fields["wellbore"].annotation, **KINDS}
    for model in models.values():
        assert model is not None
        for key in set(model.model_fields) - {"kind", "intervals", "tortuosity", "caliper", "window"}:
            assert f"\n| `{key}` | " in keys.page()


def test_defaults_have_their_units() -> None:
    page = keys.page()
    assert "| `overlap` | a length such as '12 m' or '40 ft' | `0.2 m` |" in page
    assert "| `0.002 m` without `cylinder_length` |" in page
    assert "| that of `outer_diameter` |" in page
