"""Statements about commands and files: what the screen shows, a CSV and a workbook hold, and a survey in a file."""

import contextlib
import io
import re
import sys
import tempfile
import tomllib
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from fctd.case.load import load_case
from fctd.case.operations import KINDS
from fctd.cli.main import main
from fctd.model.first_case import new_case
from fctd.model.new_case import from_template
from fctd.model.templates import TEMPLATES
from fctd.steady.torque_drag import chart_rows
from fctd.sweep.design import sample_of
from fctd.sweep.run import prepare
from fctd.sweep.spec import read_sweep
from tests.case.witsml_files import component, tubular
from tests.equivalence.answers import EXACT, ROUNDING, Answers, alike, base, same, some_kinds
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import INCH
from tests.equivalence.of_strings import pipe_written
from tests.equivalence.table import applies, statement
from tests.equivalence.ways_in import assert_equal
from tests.strategies import write_case

LOADS = ("hookload_N", "surface_torque_N_m", "weight_indicator_N", "drive_torque_N_m", "total_contact_force_N")

NUMBER = re.compile(r"[−-]?\d+\.\d+")


@contextlib.contextmanager
def folder_of(drawn: Drawn) -> Iterator[Path]:
    """A folder with the case as ``well.toml``, which is removed afterwards."""
    with tempfile.TemporaryDirectory(prefix="fctd-equivalence-") as name:
        (Path(name) / "well.toml").write_text(write_case(drawn.raw), encoding="utf-8")
        yield Path(name)


def command(*arguments: object) -> str:
    """What ``fctd ARGUMENTS`` prints, in this process; AssertionError where it refuses."""
    before, printed, told = sys.argv, io.StringIO(), io.StringIO()
    sys.argv = ["fctd", *map(str, arguments)]
    try:
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(told):
            main()
    except SystemExit as end:
        refused = end.code not in (0, 1, None)
    else:
        refused = False
    finally:
        sys.argv = before
    assert not refused, f"fctd {' '.join(map(str, arguments))}: {told.getvalue()[-300:]}"
    return printed.getvalue()


def assert_rows(rows: Sequence[dict[str, Any]], table: pd.DataFrame, what: str) -> None:
    """Raise AssertionError unless a table has these rows."""
    assert len(rows) == len(table), f"{what}: {len(table)} rows, not {len(rows)}"
    for k, row in enumerate(rows):
        assert row["status"] == table["status"][k], f"{what}: {row['operation']} {table['status'][k]}"
        for name in LOADS:
            assert_equal(f"{what}: {row['operation']} {name}", row[name], float(table[name][k]))


def assert_workbook(rows: Sequence[dict[str, Any]], table: pd.DataFrame) -> None:
    """Raise AssertionError unless a workbook, in kN and kN·m, has these rows."""
    headings = dict(
        zip(
            LOADS[:4],
            ("hook load (kN)", "surface torque (kN·m)", "weight indicator (kN)", "drive torque (kN·m)"),
            strict=True,
        )
    )
    for k, row in enumerate(rows):
        for name, heading in headings.items():
            value = float(table[heading][k])
            near = abs(value - row[name] / 1e3) <= 1e-9 * abs(value) or (value != value and row[name] != row[name])
            assert near, f"workbook: {heading} {value!r}, {row[name]!r}"


@statement("screen = CSV = workbook = row of the chart", slow=True)
def chart_files(drawn: Drawn) -> None:
    """The command reads the case as a file; the screen shows hook load and torque in kN and kN·m, rounded."""
    dice = drawn.dice(20)
    kinds = sorted({dice.pick(list(KINDS)), dice.pick(list(KINDS))})
    rows = chart_rows(drawn.case, kinds, drawn.depth, threads=1)
    with folder_of(drawn) as folder:
        files = [folder / "rows.csv", folder / "rows.xlsx"]
        options = ("--operation", ",".join(kinds), "--depths", f"{drawn.depth!r}:{drawn.depth!r}:1", "--units", "si")
        for file in files:
            screen = command("chart", folder / "well.toml", *options, "--out", file)
        assert_rows(rows, pd.read_csv(files[0]), "CSV")
        assert_workbook(rows, pd.read_excel(files[1], engine="calamine"))
    for row in rows:
        if row["hookload_N"] == row["hookload_N"]:
            line = next((line for line in screen.splitlines() if row["operation"] in line.split()), "")
            shown = [float(word.replace("−", "-")) for word in line.split() if NUMBER.fullmatch(word)]
            # A rig that adds something has its readings there.
            for name, reading, rounded in (
                ("hookload_N", "weight_indicator_N", 0.0501),
                ("surface_torque_N_m", "drive_torque_N_m", 0.000501),
            ):
                near = any(abs(number - row[of] / 1e3) <= rounded for number in shown for of in (name, reading))
                assert near, f"{row['operation']}: {name} {row[name]:.6g} is not on the screen: {line}"


@statement("options of a command = keys of the case", slow=True)
def options_of_command(drawn: Drawn) -> None:
    """Friction, rotation, flow and --set, in field units too."""
    dice = drawn.dice(21)
    kind, friction = dice.pick(["rotate_off_bottom", "back_ream", "drill_rotating"]), dice.number(0.1, 0.4, 2)
    rpm = dice.whole(30, 120)
    keys = {"rig.block_weight": "30 klbf", "limits.design_factor": 1.2}
    rows = chart_rows(load_case(drawn.raw, keys), kind, drawn.depth, friction, rpm=rpm, threads=1)
    with folder_of(drawn) as folder:
        file = folder / "rows.csv"
        typed = [text for key, value in keys.items() for text in ("--set", f"{key}={value}")]
        command(
            "chart", folder / "well.toml", "--operation", kind, "--depths", f"{drawn.depth!r}:{drawn.depth!r}:1",
            "--friction", friction, "--rpm", rpm, *typed, "--units", "si", "--out", file,
        )  # fmt: skip
        assert_rows(rows, pd.read_csv(file), "CSV")


@statement("row of a chart = row of a sweep")
def of_sweep(drawn: Drawn) -> None:
    """Samples of a list, in the process of a worker; values with units are those of the case file."""
    dice = drawn.dice(22)
    kind, density, friction = dice.pick(list(KINDS)), dice.whole(1000, 1400), dice.number(0.1, 0.4, 2)
    spec = read_sweep(
        {
            "name": "drawn", "case": drawn.raw, "method": "list",
            "parameters": [
                {"key": "mud.density", "values": [f"{density} kg/m^3"]},
                {"key": "friction", "values": [friction]},
            ],
            "work": {"kind": "chart", "operations": [kind], "depths": [drawn.depth]},
        }
    )  # fmt: skip
    runner, samples = prepare(spec)
    found = runner.rows_of(sample_of(samples, 0))
    case = load_case(drawn.raw, {"mud.density": density, "friction": friction})
    assert_rows(chart_rows(case, kind, drawn.depth, threads=1), pd.DataFrame(found), "sweep")


@statement("stations in the case = a survey file", slow=True)
def survey_file(drawn: Drawn) -> None:
    """A text in columns in metres or feet, or a trajectory of WITSML."""
    dice, rows = drawn.dice(23), drawn.raw["wellbore"]["stations"]
    applies(base(drawn))
    with tempfile.TemporaryDirectory(prefix="fctd-equivalence-") as name:
        kind = dice.pick(["m", "ft", "witsml"])
        file = Path(name) / ("survey.xml" if kind == "witsml" else "survey.csv")
        if kind == "witsml":
            file.write_text(trajectory(rows), encoding="utf-8")
        else:
            one = {"m": 1.0, "ft": 0.3048}[kind]
            lines = [f"{md / one!r},{tilt!r},{azimuth!r}" for md, tilt, azimuth in rows]
            file.write_text("\n".join([f"md_{kind},inc_deg,azi_deg", *lines, ""]))
        hole = {key: value for key, value in drawn.raw["wellbore"].items() if key != "stations"}
        same(
            drawn,
            load_case({**drawn.raw, "wellbore": {**hole, "survey": str(file)}}),
            EXACT if kind == "m" else ROUNDING,
        )


def trajectory(rows: Sequence[Sequence[float]]) -> str:
    """Stations as a trajectory of WITSML 1.4.1.1."""
    stations = "".join(
        f'<trajectoryStation uid="{k}"><md uom="m">{md!r}</md><incl uom="dega">{tilt!r}</incl>'
        f'<azi uom="dega">{azimuth!r}</azi></trajectoryStation>'
        for k, (md, tilt, azimuth) in enumerate(rows)
    )
    return (
        '<?xml version="1.0" encoding="UTF-8"?><trajectorys xmlns="http://www.witsml.org/schemas/1series" '
        'version="1.4.1.1"><trajectory uidWell="w" uidWellbore="b" uid="t"><nameWell>w</nameWell>'
        f"<nameWellbore>b</nameWellbore><name>t</name>{stations}</trajectory></trajectorys>"
    )


@statement("a template = the same written out", slow=True)
def template_written(drawn: Drawn) -> None:
    """Its text in either system of units, its case in SI, and the pipe of its catalogue written out."""
    dice = drawn.dice(24)
    plan = from_template(TEMPLATES[dice.pick(list(TEMPLATES))], "drawn", dice.pick(["si", "field"]))
    template = Drawn(drawn.seed, drawn.index, tomllib.loads(plan.text()))
    bare = load_case(template.raw).model_dump(exclude_none=True)
    same(template, load_case(bare), ROUNDING)
    if template.has("pipe"):
        pipe_written(template)


@statement("a string of WITSML = the same in TOML", slow=True)
def witsml_string(drawn: Drawn) -> None:
    """A bit, collars and pipe by their diameters, lengths and masses, in the case that `fctd init` writes of them."""
    dice, total = drawn.dice(25), drawn.raw["wellbore"]["stations"][-1][0]
    wide, mass = dice.number(5.5, 6, 3), dice.number(28, 34, 3)
    collars, (unit, one) = dice.number(30, 90, 3), dice.pick([("ft", 0.3048), ("m", 1.0)])
    parts = [
        component("bit PDC fixed cutter", 1, 0.3, 8.5, 2.25, wtPerLen=(150, "kg/m")),
        component("drill collar", 2, 0, 6.3, 2.9, len=(repr(collars / one), unit), wtPerLen=(120, "kg/m")),
        component("drill pipe", 3, total, 4.9, 4.1, odMx=(wide, "in"), wtPerLen=(mass, "kg/m")),
    ]
    with tempfile.TemporaryDirectory(prefix="fctd-equivalence-") as name, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of what the file leaves open
        file = Path(name) / "string.xml"
        file.write_text(tubular(parts), encoding="utf-8")
        survey = pd.DataFrame(drawn.raw["wellbore"]["stations"], columns=["md_m", "inc_deg", "azi_deg"])
        case = new_case(survey, string=file)
    raw = case.model_dump(exclude_none=True)
    body = [(8.5, 2.25, 8.5, 150.0, 0.3), (6.3, 2.9, 6.3, 120.0, collars), (4.9, 4.1, wide, mass, total)]
    keys = ("outer_diameter", "inner_diameter", "contact_diameter", "linear_mass", "length")
    raw["string"]["components"] = [
        {"name": f"part {k}", "contact": spec.contact}
        | dict(zip(keys, [number * INCH for number in numbers[:3]] + list(numbers[3:]), strict=True))
        for k, (spec, numbers) in enumerate(zip(case.string.components, body, strict=True))
    ]
    alike(Answers(case, total), Answers(load_case(raw), total), some_kinds(drawn), ROUNDING, loads_only=True)
