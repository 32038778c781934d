"""``fctd uncertainty``: tables and pictures of a sweep, and what is refused."""

from pathlib import Path

import pandas as pd
import pytest
from typer.testing import CliRunner

from fctd.case.errors import InputError
from fctd.cli.main import app
from fctd.sweep.chunk import as_table
from fctd.sweep.dataset import begin_dataset, open_dataset
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from tests.commands import Command
from validation.parts.small_sweep import sweep_file


@pytest.fixture
def swept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A sweep file whose dataset lies in its default folder."""
    path = sweep_file(tmp_path, 'method = "random"\nsamples = 30\n')
    runner, samples = prepare(read_sweep(path))
    rows = [
        {"sample": k, "operation": "trip_out", "bit_depth_m": depth, "hookload_N": 1e5 + 1e3 * k, "buckling": "none",
         "status": "converged"}
        for k in range(30) for depth in (600.0, 900.0)
    ]  # fmt: skip
    begin_dataset(tmp_path / "swept-sweep", runner.template, samples).write([as_table(rows)])
    monkeypatch.chdir(tmp_path)
    return path


def test_tables_and_pictures_are_written(swept: Path) -> None:
    pictures = ["--plot-bands", "bands.png", "--plot-tornado", "tornado.svg", "--plot-map", "map.png"]
    command = ["uncertainty", str(swept), "--out", "told", *pictures, "--map", "friction.open,mud.density"]
    done = CliRunner().invoke(app, command)
    assert done.exit_code == 0, done.output
    for name in ("bands.png", "tornado.svg", "map.png", "told/indices.csv", "told/convergence.csv.json"):
        assert (swept.parent / name).stat().st_size > 0
    assert pd.read_csv("told/percentiles.csv")["value"].iloc[1] == 1e5 + 14.5e3
    assert "114.5 kN" in done.stdout
    assert "Influence at 900 m" in done.stdout


def test_field_units_are_those_of_tables_pictures_screen_and_depth(swept: Path) -> None:
    """The depths of the sweep are 600 and 900 m: 2953 ft is 900.07 m."""
    pictures = ["--plot-tornado", "tornado.svg", "--plot-map", "map.svg", "--map", "friction.open,mud.density"]
    units = ["--units", "field", "--bit-depth", "2953"]
    done = CliRunner().invoke(app, ["uncertainty", str(swept), "--out", "told", *pictures, *units])
    assert done.exit_code == 0, done.output
    assert "2952.8 ft" in done.stdout
    for name in ("tornado.svg", "map.svg"):
        assert "2952.8 ft" in Path(name).read_text(encoding="utf-8")
    table = pd.read_csv("told/percentiles.csv")
    assert (table["bit_depth_ft"].iloc[0], table["column"].iloc[0]) == (pytest.approx(600 / 0.3048), "hookload_klbf")
    assert table["value"].iloc[1] == pytest.approx(114.5 / 4.4482216152605)
    indices = pd.read_csv("told/indices.csv")
    assert set(indices["column"]) == {"hookload_klbf"}
    assert indices.loc[indices["measure"] == "SRC", "value"].abs().max() > 0.01  # a share, and no load of 100 N
    refused = CliRunner().invoke(app, ["uncertainty", str(swept), "--units", "field", "--bit-depth", "2900 ft"])
    assert isinstance(refused.exception, InputError)
    assert str(refused.exception) == '--bit-depth = "2900 ft": expected a depth of the sweep, such as 2953 ft'


def test_pictures_that_cannot_be_drawn_are_refused_before_anything_is_told(swept: Path) -> None:
    command = ["uncertainty", str(swept), "--out", "told", "--plot-map", "a.png", "--map", "friction.open,mud.mass"]
    done = CliRunner().invoke(app, command)
    assert isinstance(done.exception, InputError)
    assert done.stdout == ""
    assert not Path("told").exists()


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--from", "none"], "a folder that fctd sweep has written"),
        (["--map", "friction.open,mud.density"], "--plot-map and --map"),
        (["--bit-depth", "700"], "a depth of the sweep, such as 600 m"),
        (["--operation", "push"], "one of the kinds"),
        (["--plot-map", "a.png", "--map", "friction.open"], "two keys of parameters"),
        (["--plot-map", "a.png", "--map", "friction.open,mud.density,status"], "a column of the results"),
    ],
)
def test_what_cannot_be_told_is_refused(options: list[str], words: str, swept: Path, cli: Command) -> None:
    assert words in " ".join(cli("uncertainty", swept, *options, code=2).err.split())


def test_a_limit_of_another_column_names_file_and_key(swept: Path) -> None:
    limits = '\n[[uncertainty.limits]]\ncolumn = "hooklod_N"\nabove = "120 kN"\n'
    swept.write_text(swept.read_text(encoding="utf-8") + limits, encoding="utf-8")
    refused = CliRunner().invoke(app, ["uncertainty", str(swept)])
    said = f'{swept}: uncertainty.limits[0].column = "hooklod_N": expected the column hookload_N'
    assert str(refused.exception) == said


def test_bands_of_one_depth_are_refused_with_the_kind_of_work(swept: Path) -> None:
    dataset = open_dataset(Path("swept-sweep"))
    rows = dataset.rows()[["sample", "operation", "bit_depth_m", "hookload_N", "buckling", "status"]]
    dataset.parts[0].unlink()
    deepest = rows[rows["bit_depth_m"] == 900.0].to_dict("records")
    dataset.write([as_table(deepest)])
    refused = CliRunner().invoke(app, ["uncertainty", str(swept), "--plot-bands", "bands.png"])
    said = '--plot-bands = "a sweep of kind chart": expected a sweep of charts of several depths'
    assert str(refused.exception).startswith(said)


def test_the_folder_of_another_sweep_is_refused(swept: Path, cli: Command) -> None:
    swept.write_text(swept.read_text(encoding="utf-8").replace("seed = 7", "seed = 8"), encoding="utf-8")
    assert "the folder of this sweep" in " ".join(cli("uncertainty", swept, code=2).err.split())
