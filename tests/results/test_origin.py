"""What an unfinished run began with, and what has changed since."""

from pathlib import Path

import pytest

from fctd.case.load import load_case
from fctd.results import origin
from fctd.results.origin import changes, files_of, origin_of
from tests.cli.test_main import CASE


def test_each_change_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    survey = tmp_path / "survey.csv"
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,0,0\n")
    path = tmp_path / "small.toml"
    path.write_text(
        CASE.replace("stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]", 'survey = "survey.csv"')
    )
    files = files_of(load_case(path))
    assert files == {"case file": path, "survey": survey}
    before = origin_of(files)
    assert list(changes(before, origin_of(files))) == []
    survey.write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,1,0\n")
    path.unlink()
    monkeypatch.setattr(origin, "versions", lambda: {"fctd": "9.9", "numpy": "1.0", "commit": "abc"})
    monkeypatch.setattr(origin, "hash_of_sources", lambda: "other")
    monkeypatch.setattr(origin.llvm, "get_host_cpu_name", lambda: "abacus")
    found = list(changes(before, origin_of(files)))
    assert f"the case file {path} is gone" in found
    assert f"the survey {survey} has changed" in found
    assert "the sources of fctd has changed" not in found
    assert "the sources of fctd have changed" in found
    assert any(line.startswith("numpy was") and line.endswith("is 1.0") for line in found)
    assert any(line.startswith("processor was") and "abacus" in line for line in found)
    assert not any("commit" in line for line in found)
