"""The pictures of README and guides, drawn from the cases that the text names; they need matplotlib."""

import tempfile
from collections.abc import Callable
from pathlib import Path

import matplotlib as mpl
import pandas as pd
from matplotlib.figure import Figure

import fctd
from benchmarks import history
from benchmarks.tables import history_figure
from fctd import plots
from fctd.arena.result import Comparison
from fctd.case.units import in_steps
from fctd.hydraulics.pressures import circulation
from fctd.model.depths import usual_depths
from fctd.monitoring.monitor import Monitor
from fctd.monitoring.roadmap import roadmap as fan_of
from fctd.monitoring.series import read_series
from fctd.plots.flow import losses_panels
from fctd.plots.loads import ChartLook
from fctd.plots.methods import methods_figure
from fctd.plots.wear import wear_panels
from fctd.store.parquet import read_frame
from fctd.sweep.dataset import open_dataset
from fctd.sweep.run import sweep
from fctd.sweep.spec import read_sweep
from fctd.sweep.uncertainty import Uncertainty, assess
from reports.figures import volve_f4

ROOT = Path(__file__).parents[1]
WELL = ROOT / "examples" / "my_well.toml"
PAPER = ROOT / "validation" / "cases" / "paper_well.toml"
DPI = 100


def overview() -> Figure:
    """The example well: hook load over bit depth, and the side force along the string."""
    case = fctd.load_case(WELL)
    kinds = ["trip_in", "rotate_off_bottom", "trip_out"]
    chart = fctd.torque_drag(case, kinds, range(200, 3001, 100))
    profile = fctd.equilibrium(case, operation="trip_out", bit_depth=3000).profile
    figure = Figure(figsize=(10, 4.6), layout="constrained")
    left, right = figure.subplots(1, 2, sharey=True)
    for kind, label in zip(kinds, ("slacking off", "rotating", "picking up"), strict=True):
        rows = chart[chart["operation"] == kind]
        left.plot(rows["hookload_N"] / 1e3, rows["bit_depth_m"], label=label)
    left.set(xlabel="hook load [kN]", ylabel="measured depth [m]", title="Hook load")
    left.invert_yaxis()
    left.legend()
    touching = profile[profile["contact_force_N"] > 0]
    low = touching["contact_angle_deg"].between(90, 270)
    for rows, label, colour in ((touching[low], "low side", "#0072B2"), (touching[~low], "high side", "#D55E00")):
        right.barh(rows["md_m"], rows["contact_force_N"] / 1e3, height=18, label=label, color=colour)
    right.set(xlabel="side force at a contact [kN]", title="Contact, picking up from 3000 m")
    right.legend()
    return figure


def chart() -> Figure:
    """The broomstick and torque of the paper's well."""
    case = fctd.load_case(PAPER)
    kinds = ["trip_in", "rotate_off_bottom", "trip_out"]
    return plots.chart_figure(fctd.torque_drag(case, kinds, range(1750, 2451, 25)), "si", case)


def compare() -> Figure:
    """The example well with its own mud and with a heavier one in a smoother hole."""
    cases = [fctd.load_case(WELL), fctd.load_case(WELL, {"mud.density": "1.4 sg", "friction.open": 0.25})]
    kinds = ["trip_out", "trip_in", "rotate_off_bottom"]
    return fctd.compare([fctd.chart(case, kinds, "shoe:td:100") for case in cases]).plot().figure


def roadmap() -> Figure:
    """The first readings of the example, up to a stand below the alarm, on a fan of friction factors."""
    case = fctd.load_case(WELL)
    watch = Monitor(case)
    readings = read_series(ROOT / "examples" / "my_readings.csv")
    watch.feed(readings[readings["bit_depth_m"] < 2250])
    fan = [watch.chart.set_of(factor) for factor in (0.2, 0.3, 0.4)]
    road = fan_of(watch.chart, usual_depths(case, 40), fan)
    told = [*road.told(watch.found), *(f"alarm: {alarm.sentence}" for alarm in watch.alarms)]
    look = ChartLook(rates=road.rates, measured=road.points(watch.found), told=told)
    return plots.chart_figure(road.rows, "si", case, look)


def limits() -> Figure:
    """The example well with the limits of its string and of a rig."""
    rig = {"block_weight": "200 kN", "hoist_capacity": "2000 kN"}
    case = fctd.load_case(WELL, {f"rig.{key}": value for key, value in rig.items()})
    kinds, depths = ["trip_in", "trip_out", "rotate_off_bottom"], [*range(1500, 3001, 250)]
    look = ChartLook(margins=fctd.limits_of(case, kinds, depths))
    return plots.chart_figure(fctd.torque_drag(case, kinds, depths), "si", case, look)


def feeding() -> Figure:
    """A string of the horizontal example that locks up, fed from rest."""
    changes = {"friction": 0.45, "bit.weight_on_bit": "120 kN", "solver.buckling": "feed"}
    case = fctd.load_case(ROOT / "examples" / "horizontal_well.toml", changes)
    return plots.feeding_figure(fctd.equilibrium(case, operation="drill_sliding", bit_depth=1900))


def monitor() -> Figure:
    """The readings of the example, whose open hole has a quarter more friction from 2,200 m on."""
    case = fctd.load_case(WELL)
    return plots.monitor_figure(fctd.monitor(case, ROOT / "examples" / "my_readings.csv"), case)


def run() -> Figure:
    """The example well drilled in time by an autodriller, with a bit that sticks and slips."""
    drilling = {"kind": "drill_rotating", "from_md": 2999.0, "to_md": 2999.6, "speed": 0.01, "rpm": 60}
    case = fctd.load_case(
        WELL, {"operations": [drilling], "bit.rock.weakening": 0.5, "rig.autodriller": True, "record.interval": 0.5}
    )
    return plots.run_figure(fctd.simulate(case))


def public_well() -> Figure:
    """Well 15/9-F-4 over depth, from the tables of the study `volve_f4`."""
    return volve_f4.chart(_tables("curves", "points"))


def judged_rows() -> Figure:
    """The judged rows of well 15/9-F-4 with their predicted bands."""
    return volve_f4.rows(_tables("rows"))


def bands() -> Figure:
    """The example sweep: loads over depth with their percentiles."""
    return plots.bands_figure(_swept("uncertain_friction"))


def stick_slip() -> Figure:
    """The example map: severity of stick-slip over rotation and weight on bit."""
    return plots.map_figure(_swept("stick_slip_map"), ["operations[0].rpm", "bit.weight_on_bit"], "stick_slip_severity")


def hydraulics() -> Figure:
    """Pressures of the example's mud over bit depth at three flows, and the densities that its hole feels."""
    case = fctd.load_case(ROOT / "examples" / "pumped_well.toml")
    flows, depths = [1600 / 6e4, 2000 / 6e4, 2400 / 6e4], in_steps(case.shoes[-1], case.deepest, 50.0)
    last = circulation(case, flows[-1], depths[-1])
    table = fctd.hydraulics_of(case, flows, depths)
    return plots.panels_figure(losses_panels(table, last, "si", ["API RP 13D, concentric"]))


def wear() -> Figure:
    """The wear of the example's casing while its open hole is drilled."""
    case = fctd.load_case(WELL, {"wellbore.intervals[0].casing": "9 5/8 in 47 N-80"})
    table = fctd.casing_wear(case, "shoe:td:50", penetration="20 m/h", rpm=120)
    return plots.panels_figure(wear_panels(case, table, "si", ["20 m/h, 120 rev/min, wear factors 2 to 10e-10/psi"]))


def _swept(name: str) -> Uncertainty:
    """What an example sweep says."""
    spec = read_sweep(ROOT / "examples" / f"{name}.toml")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out"
        sweep(spec, out)
        return assess(open_dataset(out), spec)


def _tables(*names: str) -> dict[str, pd.DataFrame]:
    return {name: read_frame(STUDY / f"{name}.parquet") for name in names}


def methods() -> Figure:
    """Contact methods and engines on the example well, from the stored result of the command."""
    return methods_figure(Comparison.model_validate_json((ROOT / "docs" / "methods.json").read_text(encoding="utf-8")))


def baselines() -> Figure:
    """The cost of each kernel over the baselines of the gate."""
    return history_figure(history.read())


PICTURES: dict[str, Callable[[], Figure]] = {
    "overview": overview, "chart": chart, "compare": compare, "limits": limits, "feeding": feeding, "monitor": monitor,
    "roadmap": roadmap, "run": run, "hydraulics": hydraulics, "wear": wear,
    "public_well": public_well, "judged_rows": judged_rows,
    "bands": bands, "stick_slip": stick_slip, "methods": methods,
    "baselines": baselines,
}  # fmt: skip
# Those drawn from the stored study of a public well, whose data are not part of the project.
STUDY = ROOT / "validation" / "results" / "volve_f4"
FROM_STUDY = ("public_well", "judged_rows")


def draw(name: str, folder: Path) -> Path:
    """Write a picture as PNG; returns its file."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{name}.png"
    with mpl.rc_context(plots.RC):
        PICTURES[name]().savefig(path, dpi=DPI)
    return path
