"""What the README and the guides promise: their commands and Python blocks run, and their links lead somewhere."""

import contextlib
import functools
import re
import runpy
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from fctd.arena.result import Comparison
from fctd.case.doubts.usual import USUAL
from fctd.case.errors import InputError
from fctd.case.load import KINDS, load_case
from fctd.cli import main
from fctd.model.operations import rad_per_s, steady_rates
from fctd.results.notes import MEANINGS
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from fctd.view import still
from references import commands as references
from references.methods.asked import REGISTRIES
from reports import figures
from tests.browsers import needs_browser
from tests.case import survey_files
from tests.commands import HANG
from validation.harness.registry import STUDIES

ROOT = Path(__file__).parents[2]
GUIDES = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md")])
DOCUMENTS = [*GUIDES, ROOT / "CONTRIBUTING.md", ROOT / "CHANGELOG.md", ROOT / "benchmarks" / "README.md"]

# Commands that no test runs, and why.
NOT_RUN = {
    "make ": "installs the environment that this test runs in, or takes minutes",
    ".venv/bin/python -m pytest benchmarks/": "measures times for minutes",
    "python -m benchmarks ": "measures times for minutes",
    "python -m validation ": "runs studies; tests/validation/harness/test_command_line.py runs it",
    ".venv/bin/fctd app ": "serves until Ctrl-C; tests/cli/test_app.py runs it",
}
# Programs of .venv/bin that run in this process.
PROGRAMS = {"fctd": main.app, "python -m references": references.app}
# A window in which an engine's string of the guide is settled already, as that of its Python block is.
SHORT_WINDOW = "--start 5 --duration 1.5"
# Friction and weight on bit with which the string of the guide locks up after half a minute.
LOCKED_UP = '--friction 0.45 --set bit.weight_on_bit="120 kN"'
# Guides whose engines and meshes, or searches for limits, run for seconds each.
SLOW = {"methods.md", "references.md", "report.md", "sweep.md"}
# What a Python block prints.
PRINTED = {
    "README.md": ["converged", "contact_angle_deg"],
    "calibrate.md": ["friction.cased", "inside95"],
    "adding_a_contact_method.md": ["completed straight_down"],
    "hydraulics.md": ["standpipe_Pa", "fastest_m_s"],
    "methods.md": ["engine fctd passed", "cylinders, cylinder_length=1 m kept", "rotating off bottom"],
    "monitor.md": ["friction_low", "the apparent friction factor is"],
    "references.md": ["valid 42", "settled hook load"],
    "steady.md": ["converged", "trip_out", "weight_on_bit_N", "[(3000.0, '0.5')]"],
    "sweep.md": ["trip_out", "mean"],
    "time.md": ["completed", "[0.04205]"],
    "well.md": ["drill collars"],
    "view.md": ["2 strings,", "contacts in the last"],
}


def blocks(document: Path, language: str) -> list[str]:
    """Code blocks of one language."""
    return re.findall(rf"^```{language}\n(.*?)^```", document.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def commands(document: Path, language: str = "sh") -> list[str]:
    """The commands of a document, one line each."""
    lines = "".join(blocks(document, language)).replace("\\\n", " ").splitlines()
    return [" ".join(line.partition(" # ")[0].split()) for line in lines]


COMMANDS = [(document, command) for document in DOCUMENTS for command in commands(document)]
IN_ORDER = [document for document in DOCUMENTS if "```console\n" in document.read_text(encoding="utf-8")]


def slow(document: Path) -> Any:
    """The mark of the tests of a document."""
    return pytest.mark.slow if document.name in SLOW else ()


# Guides whose commands build on the ones before, and run one after the other in one folder.
CHAINED = [ROOT / "docs" / "calibrate.md", ROOT / "docs" / "sweep.md"]
# A still picture needs a browser.
RUN = [
    pytest.param(document, command, marks=needs_browser if "--png" in command else slow(document))
    for document, command in COMMANDS
    if document not in CHAINED and not command.startswith(tuple(NOT_RUN))
]


def name(value: Path | str) -> str:
    """A test's name: the document, or a command without its options."""
    return value.name if isinstance(value, Path) else " ".join(value.split(" --")[0].split()[:5])


def shorter(command: str) -> str:
    """A chart with its last depth alone or with that of the shoe, the first rows of a file, a fit from one start, a
    short trip, a string that does not lock up, and other methods and engines with less time and fewer segments."""
    first = "td" if "--limits" in command else "shoe"  # each depth has its search
    command = re.sub(r"(--depths )shoe(:td:)\d+", rf"\g<1>{first}\g<2>1500", command)
    for file in FIRST_ROWS:
        command = command.replace(f"examples/{file}", file)
    command = command.replace('to_md="1900 m"', 'to_md="1770 m"').replace('to_md="1800 m"', 'to_md="1760 m"')
    command = re.sub(r"(fctd calibrate .*)", r"\1 --starts 1", command)
    command = re.sub(
        r"(--depths )[\d.]+:([\d.]+:[\d.]+)", lambda m: m[1] + m[2].partition(":")[0] + ":" + m[2], command
    )
    command = command.replace(f"--bit-depth 1900 {LOCKED_UP}", "--bit-depth 1300")
    command = command.replace('duration="2 s"', 'duration="0.2 s"').replace("--start 10 --duration 3", SHORT_WINDOW)
    return f"{command} --set string.components[0].segments=15" if "curved_chain.toml" in command else command


# Long files of the examples, of which commands read the first lines: an uneven hole takes a second for each 100 m.
FIRST_ROWS = {"my_caliper.las": 60, "my_readings.csv": 25}


@pytest.fixture
def checkout(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder in which the paths of the guides lead into the checkout, and what is written stays out of it."""
    for folder in ("examples", "validation"):
        (tmp_path / folder).symlink_to(ROOT / folder)
    for file, count in FIRST_ROWS.items():
        lines = (ROOT / "examples" / file).read_text(encoding="utf-8").splitlines(keepends=True)
        assert len(lines) > count
        (tmp_path / file).write_text("".join(lines[:count]), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(still, "LONGEST", HANG)
    return tmp_path


# Sweeps with fewer samples than the guide's.
FEWER = {"uncertain_friction.toml": ("samples = 60", "samples = 16"), "stick_slip_map.toml": ("count = 5", "count = 2")}


@pytest.fixture
def fewer(checkout: Path) -> Path:
    """The checkout with examples of its own, of which sweeps have fewer samples."""
    (checkout / "examples").unlink()
    shutil.copytree(ROOT / "examples", checkout / "examples", ignore=shutil.ignore_patterns("__pycache__"))
    for file, (many, few) in FEWER.items():
        path = checkout / "examples" / file
        text = path.read_text(encoding="utf-8")
        assert many in text
        path.write_text(text.replace(many, few), encoding="utf-8")
    return checkout


@contextlib.contextmanager
def exit_code_0() -> Iterator[None]:
    with pytest.raises(SystemExit) as stopped:
        yield
    assert not stopped.value.code


def need_what_it_names(command: str) -> None:
    """Skip a command whose optional package is missing."""
    for kind, name in re.findall(r"--(contact|engine) (\w+)", command):
        if REGISTRIES[kind].installed_version(name) is None:
            pytest.skip(f"{name} is not installed")


def program_of(command: str) -> str | None:
    """The program of a command, None if it is none that a test runs."""
    return next((program for program in PROGRAMS if command.startswith(f".venv/bin/{program} ")), None)


@pytest.mark.parametrize("document", [d for d in DOCUMENTS if d not in CHAINED], ids=name)
def test_each_command_is_of_a_program_that_tests_run_or_is_listed(document: Path) -> None:
    unknown = [line for line in commands(document) if not (program_of(line) or line.startswith(tuple(NOT_RUN)))]
    assert not unknown


def run_command(command: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run a command of a guide, and check that it writes what it names."""
    need_what_it_names(command)
    program = program_of(command)
    assert program is not None
    monkeypatch.setattr(sys, "argv", [program, *shlex.split(shorter(command).removeprefix(f".venv/bin/{program} "))])
    with exit_code_0():
        main.run(PROGRAMS[program])
    for target in re.findall(r"--(?:out|parts|trips|plot|plot-profile|plot-feeding|table|png|chart) (\S+)", command):
        assert (folder / target).exists()


@pytest.mark.slow(seconds=32)
@pytest.mark.parametrize(("document", "command"), RUN, ids=name)
def test_a_command_runs(document: Path, command: str, checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run_command(command, checkout, monkeypatch)


@pytest.mark.slow
@pytest.mark.parametrize("document", [pytest.param(d, marks=slow(d)) for d in CHAINED], ids=name)
def test_commands_build_on_each_other(
    document: Path, fewer: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """A script writes to its standard output, which the command redirects."""
    for command in commands(document):
        script = re.fullmatch(r"\.venv/bin/python (examples/\w+\.py) (.*?) > (\S+)", command)
        if script is None:
            run_command(command, fewer, monkeypatch)
            continue
        monkeypatch.setattr(sys, "argv", [script[1], *script[2].split()])
        capsys.readouterr()
        runpy.run_path(script[1], run_name="__main__")
        (fewer / script[3]).write_text(capsys.readouterr().out, encoding="utf-8")
    run_blocks(document, capsys)


def survey_in_feet() -> bytes:
    """Text with headers as a service company may write them."""
    return survey_files.text("Depth ( ft ),I_deg,A_deg").encode()


def survey_in_a_workbook() -> bytes:
    return survey_files.workbook({"Notes": [["Well A-1"]], "Survey": survey_files.SHEET})


def survey_in_witsml() -> bytes:
    return survey_files.witsml("S1").encode()


GUIDE = ROOT / "docs" / "well.md"
SURVEYS = {"csv": survey_in_feet, "xlsx": survey_in_a_workbook, "xml": survey_in_witsml}


# The guide's with every format of survey; those of other documents with one.
WITH_SURVEYS = [
    pytest.param(document, suffix, marks=() if suffix == "csv" else pytest.mark.slow)
    for document in IN_ORDER
    for suffix in SURVEYS
    if suffix == "csv" or document == GUIDE
]


@pytest.mark.slow
@pytest.mark.parametrize(("document", "suffix"), WITH_SURVEYS, ids=name)
def test_commands_run_one_after_the_other(
    document: Path, suffix: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Word for word, but for the suffix of the survey, in an empty folder with a survey in feet to 2,000 ft."""
    monkeypatch.chdir(tmp_path)
    survey = f"survey.{suffix}"
    content = SURVEYS[suffix]()
    (tmp_path / survey).write_bytes(content)
    asked = commands(document, "console")
    assert len(asked) <= 5
    for command in asked:
        program, *arguments = shlex.split(command.replace("survey.csv", survey))
        monkeypatch.setattr(sys, "argv", ["fctd", *arguments])
        with exit_code_0():
            main.run(PROGRAMS[program.removeprefix(".venv/bin/")])
    assert {survey, "my.toml", "chart.csv", "chart.png"} < {path.name for path in tmp_path.iterdir()}
    assert (tmp_path / survey).read_bytes() == content
    assert load_case("my.toml").depths[1] == pytest.approx(2000 * 0.3048, abs=0.01)


def test_five_commands_lead_to_a_run_in_time() -> None:
    """Those of the guide, in this order."""
    names = [command.split()[1] for command in commands(GUIDE, "console")]
    assert names == ["init", "check", "chart", "equilibrium", "simulate"]


def test_the_caliper_of_the_guide_is_read_whole() -> None:
    changes = {"wellbore.geometry": "sampled", "wellbore.caliper.log": str(ROOT / "examples" / "my_caliper.las")}
    hole = load_case(ROOT / "examples" / "my_well.toml", changes).wellbore
    assert hole.calipers is not None
    assert hole.calipers.md.tolist() == list(range(2000, 2952, 2))


def test_what_is_not_run_is_named_and_is_there() -> None:
    for prefix in NOT_RUN:
        assert any(command.startswith(prefix) for _, command in COMMANDS), prefix


def run_blocks(document: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Run the Python blocks of a document, and look for what they print."""
    capsys.readouterr()
    for block in blocks(document, "python"):
        names: dict[str, Any] = {"__name__": "__main__"}
        exec(compile(block, str(document), "exec"), names)
    printed = capsys.readouterr().out
    for part in PRINTED[document.name]:
        assert part in printed


@pytest.mark.slow
@pytest.mark.parametrize(
    "document",
    [pytest.param(d, marks=slow(d)) for d in GUIDES if blocks(d, "python") and d not in CHAINED],
    ids=name,
)
def test_the_python_blocks_run(document: Path, checkout: Path, capsys: pytest.CaptureFixture[str]) -> None:
    run_blocks(document, capsys)


@functools.cache
def anchors(document: Path) -> set[str]:
    """The headings of a document as links name them."""
    headings = re.findall(r"^#+ (.*)$", document.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def links(document: Path) -> list[str]:
    return re.findall(r"\]\(([^)\s]+)\)", document.read_text(encoding="utf-8"))


def test_links_lead_somewhere() -> None:
    for document in DOCUMENTS:
        for link in links(document):
            if link.startswith("https://"):
                continue
            file, _, anchor = link.partition("#")
            target = document.parent / file if file else document
            assert target.is_file(), (document.name, link)
            assert not anchor or anchor in anchors(target), (document.name, link)


def test_every_guide_is_reached_from_the_readme() -> None:
    reached = {(ROOT / link.partition("#")[0]).resolve() for link in links(ROOT / "README.md")}
    assert {guide.resolve() for guide in GUIDES} - reached == {ROOT / "README.md"}


def test_every_folder_of_the_map_is_there() -> None:
    folders = re.findall(r"^\| `(\w+)/` \|", (ROOT / "README.md").read_text(encoding="utf-8"), re.MULTILINE)
    packages = {path.parent.name for path in ROOT.glob("*/__init__.py")}
    assert set(folders) == packages | {"tests"}


def test_the_readme_is_short() -> None:
    assert len((ROOT / "README.md").read_text(encoding="utf-8").split()) <= 750


def test_studies_are_called_by_their_names() -> None:
    text = "".join(document.read_text(encoding="utf-8") for document in DOCUMENTS)
    named = set(re.findall(r"python -m validation ([a-z]\w*)", text)) | set(re.findall(r"[Ss]tudy\s+`(\w+)`", text))
    assert len(named) >= 5
    assert named <= {*STUDIES, "claims", "sensitive"}


def test_figures_of_the_paper_lead_to_studies_and_figures() -> None:
    text = (ROOT / "docs" / "claims.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (?:Fig|times).*?\| (`.*`) \| `(\w+)-(\w+)` \|$", text, re.MULTILINE)
    drawn = {(study, figure.name) for study, those in figures.by_study().items() for figure in those}
    assert len(rows) == 8
    assert {(study, name) for _, study, name in rows} <= drawn
    assert set(re.findall(r"\w+", "".join(studies for studies, *_ in rows))) <= STUDIES.keys()


def test_the_sweep_file_of_the_guide_runs(checkout: Path) -> None:
    (block,) = blocks(ROOT / "docs" / "sweep.md", "toml")
    Path("sweep.toml").write_text(block, encoding="utf-8")
    runner, samples = prepare(read_sweep("sweep.toml"))
    assert len(samples) == 200
    assert runner.task.depths == (1500.0, 2000.0, 2500.0, 3000.0)


def test_pictures_are_small_and_those_of_the_command() -> None:
    from docs import pictures, tutorial

    files = {path.stem: path for path in (ROOT / "docs" / "pictures").iterdir()}
    drawn = {f"tutorial_{Path(name).stem}" for command in tutorial.commands() for name in tutorial.pictures(command)}
    assert set(files) == set(pictures.PICTURES) | drawn
    shown = {Path(link).stem for guide in GUIDES for link in links(guide) if link.endswith(".png")}
    assert set(files) == shown
    assert max(path.stat().st_size for path in files.values()) <= 150_000


@pytest.mark.slow
def test_a_picture_is_drawn(tmp_path: Path) -> None:
    from docs import pictures

    assert pictures.draw("overview", tmp_path).stat().st_size > 10_000


def test_the_comparison_of_a_picture_has_the_schema_of_the_command() -> None:
    stored = (ROOT / "docs" / "methods.json").read_text(encoding="utf-8")
    assert len(Comparison.model_validate_json(stored).rows) == 14


def test_the_message_in_the_guide_is_the_one_that_is_printed() -> None:
    guide = (ROOT / "docs" / "well.md").read_text(encoding="utf-8")
    with pytest.raises(InputError) as refused:
        load_case(ROOT / "examples" / "my_well.toml", {"wellbore.intervals[0].diameter": "-2 mm"})
    assert str(refused.value).removeprefix(f"{ROOT}/examples/") in guide.splitlines()


def test_the_blank_in_the_guide_is_the_one_that_is_named(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (command,) = (command for command in commands(GUIDE) if "--string" in command)
    run_command(command, checkout, monkeypatch)
    (line,) = capsys.readouterr().err.splitlines()
    assert line in GUIDE.read_text(encoding="utf-8").splitlines()


def test_every_note_has_its_line() -> None:
    assert set(re.findall(r"^\| `(\w+)` \| [A-Z]", (ROOT / "docs" / "steady.md").read_text(), re.MULTILINE)) == set(
        MEANINGS
    )


def test_every_warning_has_its_line() -> None:
    source = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "fctd" / "case" / "doubts").glob("*.py"))
    codes = set(re.findall(r'InputWarning\(\s*"(\w+)"', source)) | {usual.code for usual in USUAL.values()}
    assert len(codes) > 15
    guide = (ROOT / "docs" / "well.md").read_text(encoding="utf-8")
    assert {code for code in codes if not re.search(rf"^\|[^|]*`{code}`", guide, re.MULTILINE)} == set()


def test_the_default_rates_are_those_of_the_guide() -> None:
    case = load_case(ROOT / "examples" / "my_well.toml", {"operations": None})
    row = re.compile(r"^\| `(\w+)` \| [^|]* \| (?:([\d.]+) m/s|–) \| (?:([\d.]+) rev/min|none) \|$", re.MULTILINE)
    rates = row.findall((ROOT / "docs" / "steady.md").read_text(encoding="utf-8"))
    assert [kind for kind, _, _ in rates] == list(KINDS)
    for kind, speed, rpm in rates:
        rate = steady_rates(case, kind)
        assert abs(rate.speed) == float(speed or 0)
        assert rate.spin == rad_per_s(float(rpm or 0))
