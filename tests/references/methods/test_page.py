"""The page of a comparison: the tables of the screen, from its JSON alone."""

from pathlib import Path

import pytest

from fctd.arena.result import Comparison, Row
from fctd.results.shown_tables import Table
from references.methods.page import write_page
from references.methods.tables import sections
from tests.arena.test_result import LOADS, row
from tests.report.test_html_file import Cells


def compared() -> Comparison:
    """A sound method, a broken one, and an engine that is refused, on a well with a name that looks like markup."""
    rows = [
        row(kind="engine", name="fctd", errors=None, costs=[]),
        row(name="sound"),
        row(name="wrong", broken=["it lies"]),
        Row(kind="engine", name="other", status="refused", reason="no <b>wall</b>"),
    ]
    return Comparison(
        case="<i>a well</i>", digest="d", reference="exact circular arcs", rows=rows, budget_s=1.0, md_m=[1.0, 2.0],
        kernel_ns=LOADS.step_us, notes=["nothing is certain"], date="2026-11-30", units="field",
        machine={"processor": "P", "cores": "2", "load average": "0.1", "numpy": "2"},
    )  # fmt: skip


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The page of it, read from its JSON."""
    path = tmp_path_factory.mktemp("page") / "page.html"
    assert write_page(Comparison.model_validate_json(compared().model_dump_json()), path) == [path]
    return path.read_text(encoding="utf-8")


def test_it_has_the_cells_of_the_screen(page: str) -> None:
    expected: list[list[str]] = []
    for table in (part for section in sections(compared()) for part in section.parts if isinstance(part, Table)):
        expected += [[*map(str, table.heads)]] if table.heads else []
        expected += [[cell.text for cell in line] for line in table.rows]
    assert Cells(page).rows == expected
    assert any("hook load (klbf)" in line for line in expected)


def test_what_is_broken_is_struck_through_and_the_reasons_stand_below(page: str) -> None:
    struck = page.count('<tr class="struck">')
    assert struck == page.count('<tr class="struck"><td>wrong</td>') == 5  # of verdicts, wall, cost, loads, steps
    for text in ("wrong: breaks the contract of contact methods: it lies", "note: nothing is certain", "2026-11-30"):
        assert text in page


def test_it_needs_no_network_and_no_text_is_markup(page: str) -> None:
    found = Cells(page)
    assert all(address.startswith(("data:image/svg+xml", "#s")) for address in found.addresses)
    assert sum(address.startswith("data:") for address in found.addresses) == 1
    assert found.tags & {"script", "i", "b"} == set()


def test_a_comparison_that_ended_at_once_has_a_page(tmp_path: Path) -> None:
    bare = compared().model_copy(update={"rows": [], "interrupted": True})
    write_page(bare, tmp_path / "page.html")
    assert "interrupted after" in (tmp_path / "page.html").read_text(encoding="utf-8")
