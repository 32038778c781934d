"""What each command prints: the command lines of ``golden/COMMAND.txt``, run in a folder of small files.

``$`` begins a command line, ``|`` a line of its screen, ``!`` one of its errors, ``=`` its exit code.
"""

import os
import re
import shlex
import shutil
from pathlib import Path

import pytest

from fctd.cli import chart
from fctd.cli.main import COMMANDS
from fctd.cli.options import messages, screen
from fctd.store import save_interval
from tests.calibration import test_calibrate as calibrations
from tests.case.witsml_files import geometry, section
from tests.cli import test_calibrate, test_check, test_limits, test_monitor, test_refine
from tests.cli.test_keeping import CHART, RUN, killed
from tests.cli.tiny import CASE, LEVEL, SMALL
from tests.commands import run
from validation.parts.small_sweep import sweep_file

GOLDEN = Path(__file__).with_name("golden")
EXAMPLES = Path(__file__).parents[2] / "examples"
STATIONS = "[[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]"
FILES = {
    "tiny.toml": CASE,
    "short.toml": CASE.replace('"tiny"', '"short"').replace("[900, 90, 0]", "[650, 90, 0]").replace("900 m", "650 m"),
    "surveyed.toml": CASE.replace(f"stations = {STATIONS}", 'survey = "hole.csv"'),
    "hole.csv": test_refine.HOLE,
    "small.toml": SMALL,
    "level.toml": LEVEL,
    "quarter.toml": test_check.CASE,
    "margins.toml": test_limits.WELL,
    "inclined.toml": test_monitor.CASE,
    "assembly.toml": test_refine.CASE,
    "block.toml": calibrations.CASE,
    "rows.csv": test_calibrate.ROWS,
    "narrow.xml": geometry([section("casing", 0, 3000, 6.184)]),
}
# What the clock, the processor and the process decide.
VARYING = re.compile(
    r"\d{4}-\d\d-\d\d \d\d:\d\d(:\d\d)?|(?<= in )[\d.]+ s\b.*|step [\d.]+ m?s,.*|(?<=process )\d+|\d+(?= iterations)"
)
SLOW = {"app", "compile"}  # one imports a server, one compiles for minutes
NUMBER = re.compile(r"\d+(?:\.\d+)?")


def same(number: str, other: str) -> bool:
    """Whether two numbers differ by 0.1 % or by 1 of their last decimal, as other processors and packages round."""
    digit = 10.0 ** -len(other.partition(".")[2]) if "." in other else 0.0
    return abs(float(number) - float(other)) <= max(1e-3 * float(other), 1.001 * digit)


def written() -> set[tuple[Path, int]]:
    """The files but locks, and when each was written."""
    return {(path, path.stat().st_mtime_ns) for path in Path().rglob("*") if path.is_file() and path.name != "lock"}


def transcript(expected: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> str:
    """What a command line prints, without blank lines; the numbers of the expected transcript where they are the same.

    A line that is refused changes no file.
    """
    command, before = expected.partition("\n")[0], written()
    capsys.readouterr()
    code = run(monkeypatch, *shlex.split(command)[2:])
    out, err = (text.replace(f"{Path.cwd()}{os.sep}", "").splitlines() for text in capsys.readouterr())
    assert not any("Traceback" in line for line in err)
    assert code != 2 or written() == before
    lines = [f"{sign} {line.rstrip()}" for sign, text in (("|", out), ("!", err)) for line in text if line.strip()]
    found = "\n".join([command, *(VARYING.sub("…", line) for line in lines), f"= {code}\n"])
    if NUMBER.sub("#", found) != NUMBER.sub("#", expected):
        return found
    others = iter(NUMBER.findall(expected))
    return NUMBER.sub(lambda number: other if same(number[0], other := next(others)) else number[0], found)


@pytest.mark.parametrize("command", [name for name in COMMANDS if name not in SLOW])
def test_a_command_prints_what_its_golden_file_says(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """``FCTD_WRITE_GOLDEN=1`` writes the files anew, of the command lines that stand in them."""
    monkeypatch.chdir(tmp_path)
    for console in (screen, messages):
        monkeypatch.setattr(console, "_width", 100)
    monkeypatch.setattr(save_interval, "SHARE", 1e9)  # every record is kept, whatever that costs
    for name, text in FILES.items():
        Path(name).write_text(text, encoding="utf-8")
    for source in (*EXAMPLES.glob("my_*"), EXAMPLES / "pumped_well.toml", *GOLDEN.glob("files/*")):
        shutil.copy(source, tmp_path)
    sweep_file(tmp_path)
    path = GOLDEN / f"{command}.txt"
    expected = re.split(r"\n(?=\$ )", path.read_text(encoding="utf-8"))
    if command in {"simulate", "status", "view"}:
        killed(monkeypatch, RUN)
    if command in {"chart", "status"}:
        killed(monkeypatch, (*CHART, "--checkpoint-every", "0 s", "--quiet"), after=9, module=chart)
    found = [transcript(block, monkeypatch, capsys) for block in expected]
    if "FCTD_WRITE_GOLDEN" in os.environ:
        path.write_text("\n".join(found), encoding="utf-8")
    else:
        assert found == expected
