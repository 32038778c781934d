"""``fctd monitor --chart``: drawn anew as a series grows, and written whole after a stop."""

from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.cli import monitor
from fctd.cli import roadmap as drawings
from tests.cli.test_monitor import CASE
from tests.commands import Command
from tests.monitoring.made import readings, shared_chart

CURVES = ["--depths", "700:950:250", "--friction", "cased=0.2,open=0.3", "--quiet"]


@pytest.fixture
def case_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)
    path = tmp_path / "inclined.toml"
    path.write_text(CASE)
    return path


@pytest.fixture
def series_file(tmp_path: Path) -> Path:
    path = tmp_path / "series.csv"
    readings().to_csv(path, index=False)
    return path


@pytest.mark.slow
@pytest.mark.parametrize(("name", "units"), [("road.png", "field"), ("road.html", "si")])
def test_readings_over_a_fan(name: str, units: str, case_file: Path, series_file: Path, cli: Command) -> None:
    path = case_file.with_name(name)
    assert name in cli("monitor", case_file, series_file, "--chart", path, *CURVES, "--units", units).out
    assert path.stat().st_size > 20_000
    if path.suffix == ".html":
        text = path.read_text(encoding="utf-8")
        assert f"{len(readings())} readings; the last one: slacking off at 965.0 m" in text
        assert "alarm: from 8" in text
        assert 'http-equiv="refresh"' not in text


def test_it_grows_with_the_series_and_is_whole_after_a_stop(
    case_file: Path, series_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    """Of an empty file it shows the curves alone; the fan is solved once; a page reloads itself while it grows."""
    path = case_file.with_name("road.html")
    lines = series_file.read_text().splitlines(keepends=True)
    parts = ["".join(lines[:10]), "", "".join(lines[10:])]
    series_file.write_text("")
    solved, seen = [], []
    once = drawings.roadmap
    monkeypatch.setattr(drawings, "roadmap", lambda *of, **how: solved.append(0) or once(*of, **how))

    def grow(seconds: float) -> None:
        text = path.read_text(encoding="utf-8")
        assert '<meta http-equiv="refresh" content="10">' in text
        seen.append((text.count("no steady reading"), text.count("9 readings; the last one"), path.stat().st_ino))
        if not parts:
            raise KeyboardInterrupt
        with series_file.open("a") as file:
            file.write(parts.pop(0))

    monkeypatch.setattr(monitor, "sleep", grow)
    cli("monitor", case_file, series_file, "--follow", "--chart", path, *CURVES, code=130)
    assert [shown[:2] for shown in seen] == [(1, 0), (0, 1), (0, 1), (0, 0)]
    # Another file each time, and none where nothing has come.
    assert seen[0][2] != seen[1][2] == seen[2][2] != seen[3][2]
    assert len(solved) == 1
    text = path.read_text(encoding="utf-8")
    assert f"{len(readings())} readings; the last one" in text
    assert 'http-equiv="refresh"' not in text
    assert not list(path.parent.glob(".road*"))


@pytest.mark.slow
def test_a_picture_that_cannot_be_written_now_does_not_end_the_watch(
    case_file: Path, series_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    whole = drawings.draw_chart
    failures = [InputError("a file that can be written (No space left on device)", value="road.png")]

    def draw(*of: object) -> list[Path]:
        if failures:
            raise failures.pop()
        return whole(*of)  # type: ignore[arg-type]

    def stop(seconds: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(drawings, "draw_chart", draw)
    monkeypatch.setattr(monitor, "sleep", stop)
    path = case_file.with_name("road.png")
    told = cli("monitor", case_file, series_file, "--follow", "--chart", path, *CURVES, code=130).err
    assert "No space left on device" in told
    assert path.stat().st_size > 20_000


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["--depths", "700:950:250"], "--depths"),
        (["--friction", "0.3"], "--friction"),
        (["--limits"], "--limits"),
        (["--chart", "road.csv"], "--chart"),
        (["--chart", "road.png", "--plot", "road.png"], "a file of its own"),
        (["--chart", "road.png", "--depths", "5000"], "--depths"),
        (["--chart", "road.png", "--friction", "x"], "--friction"),
        (["--chart", "none/../series.csv"], "--chart"),
    ],
)
def test_wrong_input_is_named(
    options: list[str], expected: str, case_file: Path, series_file: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.chdir(case_file.parent)
    assert expected in cli("monitor", case_file, series_file, *options, code=2).err
