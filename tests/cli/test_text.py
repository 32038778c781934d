"""The user's texts on the command line: printed literally, in any encoding, with any file name."""

import io
import itertools
import json
import os
import sys
from contextlib import redirect_stdout
from pathlib import Path

import pandas as pd
import pyarrow.parquet as pq
import pytest
from hypothesis import given, settings
from rich.table import Table

from fctd.case.load import Case
from fctd.case.text import printable_lines
from fctd.cli import main, options
from references.commands import app as references_app
from tests.case.test_text import ANYTHING
from tests.cli.tiny import SMALL
from tests.commands import Command

# A name as TOML writes it, and as it is shown: markup, emoji code, formula, CSI, OSC, C1, a line's end, an override.
WILD = r"[/x] [bold]y :x: $\\frac{ \u001b[31m \u001b]0;t\u0007 \u009b1m \n \u202e"
SHOWN = r"[/x] [bold]y :x: $\frac{ \x1b[31m \x1b]0;t\x07 \x9b1m \n \u202e"

STEADY = ("--operation", "trip_out", "--bit-depth", "700 m")
CHART = ("--operation", "trip_out", "--depths", "600:700:100")
COMMANDS: dict[str, tuple[str, ...]] = {
    "simulate": ("simulate",),
    "equilibrium": ("equilibrium", *STEADY),
    "chart": ("chart", *CHART),
    "refine": ("refine", "--operation", "trip_out", "--tolerance", "50%"),
    "check": ("check",),
}


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder to work in, with the case of test_cli in small.toml."""
    monkeypatch.chdir(tmp_path)
    Path("small.toml").write_text(SMALL)
    return tmp_path


@pytest.fixture
def wild(here: Path) -> str:
    """A case whose name has markup, escapes and control characters."""
    Path("wild.toml").write_text(SMALL.replace('name = "small"', f'name = "{WILD}"'))
    return "wild.toml"


def check_plain(*printed: str) -> None:
    """Assert that the line end is the only control character."""
    for text in printed:
        assert all(line.isprintable() for line in text.split("\n"))


@settings(max_examples=100)
@given(ANYTHING)
def test_any_text_reaches_the_terminal_as_it_stands(text: str) -> None:
    with redirect_stdout(io.StringIO()) as out:
        options.screen.print(text, soft_wrap=True)
    assert out.getvalue() == printable_lines(text) + "\n"


@given(ANYTHING)
def test_a_table_holds_any_text(text: str) -> None:
    table = Table(title=text)
    table.add_column(text)
    table.add_row(text)
    with redirect_stdout(io.StringIO()) as out:
        options.screen.print(table)
    check_plain(out.getvalue())


@pytest.mark.parametrize("command", list(COMMANDS))
def test_a_name_is_printed_as_it_stands(command: str, wild: str, monkeypatch: pytest.MonkeyPatch, cli: Command) -> None:
    monkeypatch.setattr(options.screen, "_width", 200)
    out, err = cli(*[*COMMANDS[command], wild])
    assert SHOWN in out
    check_plain(out, err)


@pytest.mark.parametrize("command", ["simulate", "chart"])
def test_a_name_beside_a_progress_bar(command: str, wild: str, monkeypatch: pytest.MonkeyPatch, cli: Command) -> None:
    monkeypatch.setattr(options.messages, "_width", 200)
    monkeypatch.setenv("TTY_COMPATIBLE", "1")  # a terminal, for rich
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(options.messages, "is_interactive", True)
    err = cli(*COMMANDS[command], wild).err
    assert SHOWN in err
    assert not any(character in err for character in ("\x1b]", "\x9b", "\x07", "\u202e"))


def test_the_folder_of_a_name_is_one_that_can_be_typed(wild: str, here: Path, cli: Command) -> None:
    cli("simulate", wild, "--quiet")
    assert [path.name for path in here.iterdir() if path.is_dir()] == ["x-bold-y-x-frac-31m-0-t-1m-result"]


@pytest.mark.parametrize("name", ["", "...", "a" * 1000, "井" * 200])
def test_a_name_that_is_no_file_name_still_has_a_folder(name: str, here: Path, cli: Command) -> None:
    cli("simulate", "small.toml", "--quiet", "--set", f"name='{name}'")
    (folder,) = [path for path in here.iterdir() if path.is_dir()]
    assert (folder / "history.parquet").exists()


@pytest.mark.parametrize("folder", ["d[/x]", "d[bold]y", "d:x:", "d\x1b[31m\x9b\u202e", "d\ne"])
@pytest.mark.parametrize("command", ["simulate", "equilibrium", "chart", "refine"])
def test_a_path_is_printed_as_it_stands(command: str, folder: str, here: Path, cli: Command) -> None:
    file = {"simulate": "history.parquet", "refine": "p.toml"}.get(command, "p.csv")
    out = Path(folder) if command == "simulate" else Path(folder) / file
    printed, err = cli(*COMMANDS[command], "small.toml", "--out", out)
    assert (Path(folder) / file).exists()
    shown = "".join(c if c.isprintable() else repr(c)[1:-1] for c in folder)
    assert f"Written: {shown}{os.sep}{file}" in printed
    check_plain(printed, err)


@pytest.mark.parametrize(
    "arguments",
    [
        ("simulate", "no[/x]\x1b[31m\x9b:x:.toml"),
        ("simulate", "small.toml", "--set", "wellbore.x\x1b[31m\x9b[/x]=3"),
        ("simulate", "small.toml", "--set", "wellbore.'\x9b'=3"),
        ("simulate", "small.toml", "--set", "wellbore.overlap=[/x]\x1b[31m\x9b\u202e"),
        ("simulate", "small.toml", "--set", "wellbore.survey=[/x]\x1b[31m\x9b\u202e"),
        ("simulate", "small.toml", "--\x1b[31m\x9b[/x]"),
        ("equilibrium", "small.toml", "--operation", "[/x]\x1b[31m\x9b", "--bit-depth", "700"),
        ("equilibrium", "small.toml", *STEADY, "--out", "[/x]\x1b[31m\x9b.txt"),
        ("equilibrium", "small.toml", *STEADY, "--units", "[/x]\x1b[31m\x9b"),
        ("equilibrium", "small.toml", *STEADY, "more\x1b[31m\x9b[/x]"),
        ("chart", "small.toml", "--operation", "trip_in", "--depths", "[/x]\x1b[31m\x9b:2:1"),
        ("refine", "small.toml", "--tolerance", "[/x]\x1b[31m\x9b"),
        ("\x1b[31m\x9b[/x]",),
    ],
)
def test_an_error_shows_what_was_written(arguments: tuple[str, ...], here: Path, cli: Command) -> None:
    out, err = cli(*arguments, code=2)
    assert "x9b" in err or "u009b" in err
    check_plain(out, err)


def test_keys_and_headers_of_a_file_are_shown_on_one_line(here: Path, cli: Command) -> None:
    Path("bad.toml").write_text('"[/x]\\u001b[31m\\u009b\\n" = 3\n' + SMALL)
    err = cli("simulate", "bad.toml", code=2).err
    assert r"[/x]\x1b[31m\x9b\n = 3" in err
    check_plain(err)
    Path("s.csv").write_text('md_m,inc_deg,"azi_deg [/x]\x9b\n"\n0,0,0\n')
    survey = ("--set", "wellbore.stations=", "--set", "wellbore.survey=s.csv")
    err = cli("simulate", "small.toml", *survey, code=2).err
    assert "[/x]" in err
    assert err.count("\n") == 1
    check_plain(err)


@pytest.mark.parametrize("encoding", ["ascii", "latin-1"])
@pytest.mark.parametrize("arguments", [*COMMANDS.values(), ("--help",), ("simulate", "--help"), ("refine", "--no")])
def test_output_in_an_encoding_that_lacks_characters(
    arguments: tuple[str, ...], encoding: str, here: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    out, err = (io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors="strict") for _ in range(2))
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr(sys, "stderr", err)
    plain = arguments[-1].startswith("--")
    cli(*arguments, *([] if plain else ["small.toml"]), code=2 if arguments[-1] == "--no" else 0)
    for stream in (out, err):
        stream.flush()
    assert out.buffer.getvalue() + err.buffer.getvalue()


def test_columns_stay_below_each_other_in_ascii(here: Path, monkeypatch: pytest.MonkeyPatch, cli: Command) -> None:
    out = io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="strict")
    monkeypatch.setattr(sys, "stdout", out)
    cli("simulate", "small.toml")
    table = [line for line in out.buffer.getvalue().decode().splitlines() if line.startswith(("|", "+"))]
    assert any(r"\u03a3" in line for line in table)
    widths = [len(line) for line in table]
    assert len(list(itertools.groupby(widths))) == 3  # history, operations and run, each of one width


def test_the_list_of_references_in_ascii(monkeypatch: pytest.MonkeyPatch) -> None:
    out = io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="strict")
    monkeypatch.setattr(sys, "stdout", out)
    monkeypatch.setattr("sys.argv", ["references", "list"])
    with pytest.raises(SystemExit) as stopped:
        main.run(references_app)
    assert not stopped.value.code
    assert b"cylinders" in out.buffer.getvalue()


def has_bytes_in_names(folder: Path) -> bool:
    """Whether the file system takes a name that is no UTF-8."""
    try:
        (folder / "probe\udcff").touch()
    except OSError:
        return False
    (folder / "probe\udcff").unlink()
    return True


@pytest.fixture
def odd(here: Path) -> str:
    """A case whose file, folder and survey have names that are no UTF-8."""
    if not has_bytes_in_names(here):
        pytest.skip("the file system takes names in UTF-8 only")
    folder = Path("f\udcff")
    folder.mkdir()
    (folder / "s.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n300,0,0\n750,90,0\n900,90,0\n")
    (folder / "c\udcff.toml").write_text(
        SMALL.replace("stations = [[0, 0, 0], [300, 0, 0], [750, 90, 0], [900, 90, 0]]", 'survey = "s.csv"')
    )
    return os.path.join("f\udcff", "c\udcff.toml")


@pytest.mark.parametrize("suffix", [".csv", pytest.param(".parquet", marks=pytest.mark.slow)])
@pytest.mark.parametrize("command", ["equilibrium", "chart"])
def test_steady_files_of_names_that_are_no_utf8(command: str, suffix: str, odd: str, here: Path, cli: Command) -> None:
    table, picture = Path(f"o\udcff{suffix}"), Path("p\udcff.svg")
    assert rf"o\udcff{suffix}" in cli(*COMMANDS[command], odd, "--out", table, "--plot", picture).out
    assert "<svg" in picture.read_text()
    if suffix == ".csv":
        assert len(pd.read_csv(table))
        case = json.loads(Path("o\udcff.csv.json").read_text())["case"]
    else:
        with table.open("rb") as source:
            case = json.loads(pq.read_schema(source).metadata[b"case"])
    assert Case.model_validate(case).file == Path(odd)


def test_simulate_with_names_that_are_no_utf8(odd: str, here: Path, cli: Command) -> None:
    assert r"Written: r\udcff/history.parquet" in cli("simulate", odd, "--out", "r\udcff", "--csv").out
    with Path("r\udcff/history.parquet").open("rb") as source:
        case = json.loads(pq.read_schema(source).metadata[b"case"])
    assert Case.model_validate(case).wellbore.survey == here / "f\udcff" / "s.csv"


def test_a_survey_and_a_picture_named_on_the_command_line(odd: str, here: Path, cli: Command) -> None:
    Path("s\udcff.csv").write_text("md_m,inc_deg,azi_deg\n0,0,0\n900,0,0\n")
    survey = ("--set", "wellbore.stations=", "--set", "wellbore.survey=s\udcff.csv")
    cli("equilibrium", "small.toml", *STEADY, *survey, "--plot", "p\udcff.png")
    assert Path("p\udcff.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize("key", ["name", "wellbore.geometry", "wellbore.overlap", "string.components[0].name"])
def test_a_value_that_is_no_utf8_is_refused(key: str, here: Path, cli: Command) -> None:
    err = cli("simulate", "small.toml", "--set", f"{key}=a\udcff", code=2).err
    assert key in err
    assert "UTF-8" in err


def test_refine_of_a_case_whose_name_is_no_utf8(odd: str, here: Path, cli: Command) -> None:
    cli(*COMMANDS["refine"], odd, "--out", "f\udcff/r\udcff.toml")
    assert 'survey = "s.csv"' in Path("f\udcff/r\udcff.toml").read_text()


def test_refine_refuses_at_once_a_survey_that_toml_cannot_name(
    odd: str, here: Path, monkeypatch: pytest.MonkeyPatch, cli: Command
) -> None:
    monkeypatch.setattr("fctd.cli.refine.refine", None)  # nothing is computed
    err = cli(*COMMANDS["refine"], odd, "--out", "r.toml", code=2).err
    assert "--out" in err
    assert "UTF-8" in err


@pytest.mark.slow
def test_a_title_is_no_formula(wild: str, here: Path, cli: Command) -> None:
    plots = ("--plot", "a.svg", "--plot-profile", "b.svg")
    for name in (r"\\$\\frac{$", "$\\\\frac{ \\u001b"):
        Path("wild.toml").write_text(SMALL.replace('name = "small"', f'name = "{name}"'))
        cli("chart", wild, *CHART, *plots)
        drawn = Path("a.svg").read_text()
        assert "<svg" in drawn
        assert "\x1b" not in drawn
