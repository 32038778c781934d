"""``fctd pipes``: pipe by words of its name, with numbers and pages; what is not found is refused."""

import pytest

from fctd.cli.options import screen
from fctd.cli.pipes import found_by
from tests.commands import Command


def test_the_table_has_name_numbers_and_page(cli: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 200)
    said = cli("pipes", "nc50", "premium", "--units", "field").out
    row = next(line.split() for line in said.splitlines() if "premium" in line)
    assert row[:6] == ["5", "in", "19.5", "S-135", "NC50,", "premium"]
    assert row[6:14] == ["4.276", "6.625", "23.52", "560.8", "58.11", "15638", "10029", "30.73"]
    assert "scribd.com/document/552214615, opened 2026-11-26" in said


def test_numbers_are_not_cut_on_a_usual_screen(cli: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(screen, "_width", 80)
    said = cli("pipes", "5", "S-135").out
    assert "…" not in said
    assert "41.7" in said


@pytest.mark.parametrize(
    ("words", "names"),
    [
        (["9 5/8", "47", "N80"], {"9 5/8 in 47 N-80 casing"}),
        (["9", "5/8", "in", "47", "casing"], {"9 5/8 in 47 casing"}),
        (["5 in 19.5"], {f"5 in 19.5 {end}" for end in ("E-75", "X-95", "G-105", "S-135 NC50")}),
        (["S-135", "casing"], set()),
        (["collar", "premium"], set()),
    ],
)
def test_words_find_pipe(words: list[str], names: set[str]) -> None:
    assert {pipe.name for pipe in found_by(words)} == names
