"""The files that the page offers."""

import base64
import tomllib
from pathlib import Path
from typing import Any

import pytest

from fctd.app.downloads import FILES, file, text
from fctd.app.well import Well
from fctd.case.errors import InputError
from tests.app.made import ROWS, source

STARTS = {
    "case.toml": b"# a comment", "chart.csv": b"operation,friction", "chart.xlsx": b"PK", "profile.csv": b"md_m,",
    "chart.png": b"\x89PNG", "chart.html": b"<", "view.html": b"<!DOCTYPE html>",
}  # fmt: skip


@pytest.fixture(scope="module")
def well(tmp_path_factory: pytest.TempPathFactory) -> Well:
    return Well(source(), tmp_path_factory.mktemp("well"), "si")


def of(well: Well, name: str, **given: Any) -> dict[str, str]:
    usual: dict[str, Any] = {
        "values": {"mud": 1300.0}, "operations": ["trip_out"], "operation": "trip_out", "depth": 880.0,
        "colour": "tension", "measured": ROWS,
    }  # fmt: skip
    return file(well, name, **(usual | given))


@pytest.mark.slow
@pytest.mark.parametrize("name", FILES)
def test_a_file_is_made_and_not_kept(name: str, well: Well) -> None:
    found = of(well, name)
    content = base64.b64decode(found["content"])
    assert content.startswith(STARTS[name])
    assert b"<a href='https://example.org'>" not in content or name == "case.toml"
    assert found["name"].endswith(Path(name).suffix)
    assert "/" not in found["name"]
    assert not (well.read.folder / name).exists()


def test_the_case_has_the_sliders(well: Well) -> None:
    raw = tomllib.loads(text(well, {"mud": 1300.0}, "other.csv")["text"])
    assert raw["mud"]["density"] == 1300
    assert raw["wellbore"]["survey"] == "other.csv"


@pytest.mark.parametrize("name", ["", "../case.toml", "settings.json", "case.toml/..", "/etc/passwd"])
def test_no_other_file_is_given_out(name: str, well: Well) -> None:
    with pytest.raises(InputError, match=r"one of case\.toml"):
        of(well, name)


def test_field_units_and_depths_beyond_the_chart(tmp_path: Path) -> None:
    field = Well(source(), tmp_path, "field")
    content = base64.b64decode(of(field, "profile.csv", values={}, depth=1e9)["content"]).decode()
    assert content.startswith("md_ft,")
    assert float(content.splitlines()[-1].split(",")[0]) == pytest.approx(900 / 0.3048, rel=1e-3)  # stretched
