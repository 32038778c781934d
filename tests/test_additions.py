"""In a copy of the package, one line adds a result column, an option, a kind of quantity, a message, or a limit with
its note, and one file and one line a law."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest

from fctd.mechanics.compile_cache import STORE

ROOT = Path(__file__).parents[1]
WELL = """
name = "tiny"
[wellbore]
stations = [[0, 0, 0], [100, 0, 0], [550, 90, 0], [900, 90, 0]]
[[wellbore.intervals]]
to_md = 900
diameter = 0.2159
friction = 0.2
[string]
[[string.components]]
name = "pipe"
outer_diameter = 0.127
inner_diameter = 0.1086
segment_length = 40
"""


def copy_of_package(folder: Path) -> Path:
    """The folder with a copy of the package and a case."""
    shutil.copytree(ROOT / "fctd", folder / "fctd", ignore=shutil.ignore_patterns("__pycache__"))
    (folder / "well.toml").write_text(WELL)
    return folder


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    return copy_of_package(tmp_path)


def add_line(file: Path, after: str, line: str) -> None:
    """Add one line to a file below the one that reads so."""
    lines = file.read_text().splitlines()
    lines.insert(lines.index(after) + 1, line)
    file.write_text("\n".join(lines) + "\n")


COMMANDS = """
import json, sys
from fctd.cli.main import main

for arguments in json.loads(sys.argv[1]):
    sys.argv = ["fctd", *arguments]
    try:
        main()
    except SystemExit as end:
        if end.code:
            raise
    print("\\f", end="")
"""


def fctd(copy: Path, cache: Path, *commands: list[str]) -> list[str]:
    """The outputs of the copy's commands, one after the other in one process."""
    environment = os.environ | {"PYTHONPATH": str(copy), "NUMBA_CACHE_DIR": str(cache), "COLUMNS": "160"}
    done = subprocess.run(
        [sys.executable, "-c", COMMANDS, json.dumps(commands)],
        cwd=copy, env=environment, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout.split("\f")[:-1]


def lines_of(copy: Path, compiled: str, interpreted: str) -> list[str]:
    """What two scripts print in the copy, the second without compiling."""
    environment, printed = os.environ | {"PYTHONPATH": str(copy), "NUMBA_CACHE_DIR": str(copy / "cache")}, ""
    for script, disabled in ((compiled, "0"), (interpreted, "1")):
        done = subprocess.run(
            [sys.executable, "-c", script], cwd=copy, env=environment | {"NUMBA_DISABLE_JIT": disabled},
            capture_output=True, text=True,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        printed += done.stdout
    return printed.splitlines()


@pytest.mark.slow
def test_a_result_column_is_one_line(copy: Path) -> None:
    """It is in charts and their field units, on the screen and beside a profile."""
    add_line(
        copy / "fctd" / "results" / "columns.py",
        "LOADS: Final = (",
        '    Column("spare_N", "spare pull", 2, "spare", of=lambda point: 1e6 - point.hookload),',
    )
    assert STORE.folder is not None
    steady = ["well.toml", "--operation", "trip_out"]
    chart = ["chart", *steady, "--depths", "500:800:300", "--units", "field", "--out", "chart.csv"]
    screen, point = fctd(copy, STORE.folder, chart, ["equilibrium", *steady, "--bit-depth", "800"])
    table = pd.read_csv(copy / "chart.csv")
    spare = 1e3 / 4.4482216152605 - table["hookload_klbf"]
    assert table["spare_klbf"].to_numpy() == pytest.approx(spare.to_numpy())
    assert "spare" in screen
    assert all(f"{value:.2f}" in screen for value in spare)
    assert "spare pull" in point


VOLUMES = """
import pandas as pd
from fctd.case.systems import VOLUME
from fctd.cli.quantities import QuantityOption
from fctd.results.unit_systems import digits_of, in_field_units, shown
from fctd.results.shown_tables import heading_of

print(*in_field_units(pd.DataFrame({"pit_m3": [0.028316846592]})).items(), *shown("pit_m3", "field"))
print(digits_of("pit_m3", "field"), heading_of("pit_ft3"), heading_of("pit_m3"))
print(QuantityOption("--pit", VOLUME).read("1", "field"), QuantityOption("--pit", VOLUME).read("1 m^3", "field"))
"""


@pytest.mark.slow
def test_an_option_of_a_chart_is_one_field(copy: Path) -> None:
    """The command has it and its help; an unfinished chart keeps it, and goes on with no other."""
    file = copy / "fctd" / "cli" / "chart.py"
    add_line(
        file, "    rpm: Rpm = None", '    shade: Annotated[str, typer.Option("--shade", help="How dark.")] = "none"'
    )
    (screen,) = fctd(copy, copy / "cache", ["chart", "--help"])
    assert "How dark. [default: none]" in " ".join(screen.split())
    script = """
from fctd.case.errors import InputError
from fctd.cli.chart import ChartOptions, beside, chart_command, to_keep
from fctd.cli.keeping import SaveOptions
begun, bare = ChartOptions(shade="dark", keeping=SaveOptions()), ChartOptions(keeping=SaveOptions())
print(beside(bare, to_keep(begun, "si")).shade)
try:
    chart_command(**{**vars(begun), **vars(SaveOptions(resume="chart.csv"))})
except InputError as error:
    print(error.key)
"""
    assert lines_of(copy, script, "") == ["dark", "--shade"]


def test_a_kind_of_quantity_is_one_line(copy: Path) -> None:
    """It is in tables, on the screen, in workbooks, and read from options."""
    dimension = """Dimension("a volume", "m^3", "'1 m^3'", ("m^3", "ft^3"))"""
    add_line(
        copy / "fctd" / "case" / "systems.py", "# Of kinds with one dimension the first is that of a column whose name "
        "says no more than the unit.", f'VOLUME: Final = Kind({dimension}, ("m^3", "ft^3"), (1, 2))',
    )  # fmt: skip
    done = subprocess.run(
        [sys.executable, "-c", VOLUMES], cwd=copy, env=os.environ | {"PYTHONPATH": str(copy)}, capture_output=True,
        text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    table, headings, read = done.stdout.rsplit("\n", 4)[-4:-1]
    assert "pit_ft3" in done.stdout
    assert table.endswith("35.3146667214886 ft³")
    assert headings.startswith("2 Heading(head=Head(words='pit', unit='ft³', numbers=None), factor=1.0, digits=2)")
    assert headings.endswith("Heading(head=Head(words='pit', unit='m³', numbers=None), factor=1.0, digits=1)")
    assert read == "0.028316846592 1.0"


DOUBT = (
    """    yield InputWarning("hangs", "rig", f"{rig.drive}, 29 kg/m, hangs {quantity(30.48, 'm')} high", "lower it")"""
)


@pytest.mark.slow
def test_a_message_is_one_statement(copy: Path) -> None:
    """The screen tells its quantity in the reader's units, once, and what the user wrote as it is."""
    file = copy / "fctd" / "case" / "doubts" / "rig.py"
    code = file.read_text()
    doubts = code[code.index("def sheaves_and_drive") :].splitlines()
    add_line(file, doubts[1], DOUBT)
    script = """
from fctd.cli.main import main
import sys
sys.stderr = sys.stdout
for units in "si", "field":
    sys.argv = ["fctd", "check", "well.toml", "--units", units]
    try:
        main()
    except SystemExit:
        print()
"""
    screens = " ".join(lines_of(copy, "", script))
    assert screens.count("rig: stiff, 29 kg/m, hangs 30.48 m high: lower it") == 1
    assert screens.count("rig: stiff, 29 kg/m, hangs 100 ft high: lower it") == 1


MAKE_UP = """
    Limit(
        "connection", "a connection turns further than it was made up", "lower the friction factor", "N m",
        lambda at, section: abs(at.torque),
        lambda at, section: 1e3,
        lambda share, at, section, where: f"{at.torque:.0f} N m at {where}, the connection holds 1000 N m",
    ),
"""
LIMITED = """
import fctd
from fctd.results.notes import meanings_of
from fctd.sweep.probabilities import probability_table

case = fctd.load_case("well.toml")
chart = fctd.torque_drag(case, ["trip_out", "rotate_off_bottom"], [700.0])
events = probability_table(chart.assign(sample=0), [], 1)
run = fctd.simulate(case)
assert run.status == "completed", run.message
print(list(chart["notes"]), meanings_of(chart["notes"])["connection"]["headline"], set(events["event"]), sep="\\n")
for found in (fctd.equilibrium(case, "rotate_off_bottom", 700.0), run):
    print([note.text for note in found.notes])
"""
ONE_WALK = """
import numpy as np
import fctd
from fctd.model.drillstring import lay_out
from fctd.model.wellbore import build_wellbore
from fctd.results.hanging_body import HANGING_COLUMNS
from fctd.results.limits import LIMITS, WORST, find_shares
from fctd.results.notes import limit_notes

case = fctd.load_case("well.toml")
string, hole = lay_out(case, 700.0), build_wellbore(case)
none, worst = np.zeros(string.segments), np.empty((len(LIMITS), WORST))
unbent = np.zeros((string.segments + 1, HANGING_COLUMNS))
walls = hole.walls(hole.at(np.linspace(100.0, 700.0, string.segments))[0])
assert find_shares(
    none, none, unbent, 0.0, 1500.0, 0.0, walls.offset, walls.radius, string.contact_radius(), True,
    string.mid_contact(), string.component, string.table, np.zeros(string.segments + 1), worst,
)
print([note.text for note in limit_notes(worst, string, walls)])
"""


@pytest.mark.slow(seconds=20)
def test_a_limit_and_its_note_are_one_entry_of_a_table(copy: Path) -> None:
    """Charts, equilibria, the records of a run and a sweep's events have it; compiled is the walk alone."""
    limits = copy / "fctd" / "results" / "limits.py"
    add_line(limits, "LIMITS: Final[tuple[Limit, ...]] = (", MAKE_UP)
    well = WELL.replace("segment_length = 40", "segment_length = 100")
    (copy / "well.toml").write_text(well + ROTATE.replace("duration = 30", "duration = 6"))
    walked, codes, headline, events, *texts = lines_of(copy, compiled=ONE_WALK, interpreted=LIMITED)
    assert walked == "['1500 N m at 700 m, the connection holds 1000 N m']"
    assert codes == "['sagitta', 'connection, sagitta']"  # segments of 100 m miss the bend too
    assert headline == "a connection turns further than it was made up"
    assert "beyond connection" in events
    assert all("the connection holds 1000 N m" in text for text in texts)


VISCOUS = '''"""Law ``viscous``: a drag along the axis and a couple about it that grow with the speed at the wall."""

from fctd.mechanics.friction import Law
from fctd.mechanics.jit import inlined
from fctd.mechanics.state import INVERSE_JA, INVERSE_MASS

PER_SPEED = 0.5  # share of the limit for each metre per second


@inlined
def impulse(S, j, radius, net, u, v, w, a, b, c, nx, ny, nz, limit, around):
    k, q = PER_SPEED * limit * S[INVERSE_MASS + j], PER_SPEED * limit * radius * radius * S[INVERSE_JA + j]
    return 0.0 * w, 0.0 * w, -w * k / (1 + k), 0.0 * w, 0.0 * w, -c * q / (1 + q)


@inlined
def steady_load(speed, spin, limit, around, radius, ax, ay, az, nx, ny, nz, tx, ty, tz):
    drag, torque = -PER_SPEED * limit * speed, -PER_SPEED * limit * radius * radius * spin
    return drag * ax, drag * ay, drag * az, torque * ax, torque * ay, torque * az, torque


@inlined
def shares(speed, turning, limit, around):
    return PER_SPEED * limit * speed, PER_SPEED * limit * turning, 0.0


LAW = Law(impulse, steady_load, shares)
'''
RUN = """
import fctd

case = fctd.load_case("well.toml", {"contact.friction_law": "viscous"})
run = fctd.simulate(case)
assert run.status == "completed", run.message
end = run.history.iloc[-1]
print(end["hookload_N"], end["surface_torque_N_m"])
for rpm in (30, 60):
    point = fctd.equilibrium(case, "rotate_off_bottom", 700.0, rpm=rpm)
    assert point.status == "converged"
    print(point.hookload, point.surface_torque)
"""
COMPILED = """
from fctd.mechanics import dynamics, state
from fctd.mechanics.jit import entry
from fctd.mechanics.law_names import CODES

laws = state.Laws(state.ARCS, CODES["viscous"], 1.0, 0.0, 0.0, 0.0)
entry(dynamics.update_velocities.py_func)(state.new_state(1), state.LANES, laws, 1e-3)
"""
ROTATE = '[[operations]]\nkind = "rotate_off_bottom"\nat_md = 700\nduration = 30\nrpm = 60\nramp_time = 5\n'


@pytest.mark.slow(seconds=20)
def test_a_friction_law_is_one_file_and_one_line(copy: Path) -> None:
    """A case may name it; stepper and steady solver agree on its torque, which is proportional to the rotation.

    Compiled is what chooses among the laws; runs are interpreted, since stepper and solver compile for a minute.
    """
    laws = copy / "fctd" / "mechanics" / "laws"
    (laws / "viscous.py").write_text(VISCOUS)
    add_line(
        laws.parent / "law_names.py",
        '    "paper": NamedLaw("paper.LAW"),',
        '    "viscous": NamedLaw("viscous.LAW"),',
    )
    (copy / "well.toml").write_text(WELL.replace("segment_length = 40", "segment_length = 100") + ROTATE)
    printed = lines_of(copy, compiled=COMPILED, interpreted=RUN)
    moved, slow, fast = ([float(part) for part in line.split()] for line in printed)
    assert fast[1] == pytest.approx(2 * slow[1], rel=1e-6)
    assert slow[1] > 100
    assert moved == pytest.approx(fast, rel=1e-2)
