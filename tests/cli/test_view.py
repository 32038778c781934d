"""``fctd view``: pages of cases and of runs, refusals."""

from pathlib import Path

import pytest

pytest.importorskip("plotly")

from tests.cli.test_main import CASE, run


@pytest.fixture
def case_file(tmp_path: Path) -> Path:
    path = tmp_path / "small.toml"
    path.write_text(CASE)
    return path


def test_a_case_and_its_run_become_pages(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    given = ("--operation", "trip_in", "--depths", "600:800:100", "--set", "string.components[0].length=850 m")
    assert run(monkeypatch, "view", case_file, *given, "--units", "si", "--quiet") == 0
    assert "Written: small-view.html" in capsys.readouterr().out
    assert "bit at 700.0 m" in Path("small-view.html").read_text(encoding="utf-8")
    assert run(monkeypatch, "simulate", case_file, "--out", "run", "--quiet") == 0
    assert run(monkeypatch, "view", "run", "--out", "run.html", "--colour", "stress") == 0
    assert "rotating off bottom, bit at 800.0 m" in Path("run.html").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        (("--colour", "colour"), ["--colour", "side_force"]),
        (("--out", "view.png"), ["--out", ".html"]),
        (("--png", "view.svg"), ["--png", ".png"]),
        (("--operation", "fly"), ["--operation", "fly"]),
        (("--depths", "5000:6000:500"), ["5000", "900 m"]),
        (("--out", "small.toml"), ["--out"]),
        (("--sideways", "inf"), ["--sideways", "100000"]),
    ],
)
def test_wrong_options_are_refused(
    given: tuple[str, str], expected: list[str], case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    assert run(monkeypatch, "view", case_file, *given, "--quiet") == 2
    message = capsys.readouterr().err
    for text in expected:
        assert text in message
    assert [path.name for path in tmp_path.iterdir()] == ["small.toml"]


def test_options_of_a_case_are_refused_for_a_run(
    case_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(monkeypatch, "view", tmp_path, "--depths", "1:2:1") == 2
    assert "the run is already computed" in capsys.readouterr().err
    assert run(monkeypatch, "view", tmp_path) == 2
    assert "the folder of a result of fctd simulate" in capsys.readouterr().err


def test_a_run_that_has_not_ended_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / ".out-run").mkdir()
    assert run(monkeypatch, "view", "out") == 2
    assert "its run has not ended (fctd status" in capsys.readouterr().err
