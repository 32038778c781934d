"""Statements about runs in time: a drawn string comes to its steady loads, a run resumes."""

from collections import deque

from fctd.answers.run import simulate
from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.simulation.simulate import Simulation
from tests.equivalence.answers import ARM, Answers, changed, plain
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.table import applies, statement
from tests.simulation.kept import gone_on, same, stopped

# Of the weight; of the torque, and of the weight times ``ARM`` where there is next to none: pipe is fed meanwhile, mud
# and laws of friction regularise what is at rest, and a run ends seconds after its start.
HOOKLOAD, TORQUE, LEAST_TORQUE = 2e-3, 0.04, 1e-3
KEPT = {"rig": ("block_weight", "guide_friction", "sheave_efficiency"), "bit": ("end",)}
SEGMENT = 12.0  # [m]
IN_TIME = ("static_friction", "decay_speed", "overbalance")


def short_run(drawn: Drawn, kind: str, length: float) -> Case:
    """The drawn case with a slow operation of a kind over a length [m], for which pipe is fed at the top.

    The law of friction is Coulomb's.  The default layout of a string that moves is coarser at the bit than that of a
    steady one, which is 6 % of the contact force beside a stabiliser of nearly full gauge: its components have segments
    of one length.  Raises NotApplicableError of a case that a run in time refuses.
    """

    def write(raw: Raw) -> None:
        above = round(drawn.depth - length, 3)
        ends = (above, drawn.depth) if kind == "trip_in" else (drawn.depth, above)
        run = {"kind": kind, "from_md": ends[0], "to_md": ends[1], "speed": 0.1, "ramp_time": 3.0}
        raw["operations"] = [run | ({"rpm": 20.0} if kind == "back_ream" else {})]
        for table, keys in KEPT.items():
            raw[table] = {key: value for key, value in raw.get(table, {}).items() if key in keys}
        raw["rig"]["feed"] = "long_segment"
        raw["contact"], raw["solver"], raw["record"] = {}, {}, {"interval": 0.25}
        raw["mud"] = {key: value for key, value in raw["mud"].items() if key != "cake"}
        raw["mud"].setdefault("lateral_damping", 100.0)
        for spec, part in zip(drawn.case.string.components, raw["string"]["components"], strict=True):
            part |= {"segment_length": SEGMENT} if spec.cut_by_default else {}
        for row in raw["wellbore"]["intervals"]:
            for key in IN_TIME:
                row.pop(key, None)

    try:
        case = changed(drawn, write)
        Simulation(case)
    except InputError:
        case = None
    applies(case)
    assert case is not None
    return case


@statement("a drawn string in time = its steady string", slow=True)
def drawn_in_time(drawn: Drawn) -> None:
    """Hook load and torque of the second half of a trip or of reaming, within 0.2 % of weight and 4 %."""
    kind = drawn.dice(70).pick(["trip_in", "trip_out", "back_ream"])
    bent = drawn.has("bend")
    applies(kind != "back_ream" or not bent)  # one toolface is not a turn's mean
    case = short_run(drawn, kind, 1.6)
    result = simulate(case)
    assert result.status == "completed", f"{kind}: {result.status}: {result.message}"
    time = result.history["time_s"]
    rows = result.history[time > 0.5 * time.max()].mean(numeric_only=True)
    steady = Answers(case, float(rows["bit_depth_m"]))
    point, weight = steady[kind], steady.weight
    applies(plain(point))
    off = abs(rows["hookload_N"] - point.hookload)
    assert off <= HOOKLOAD * weight, f"{kind}: hook load {rows['hookload_N']:.6g} and {point.hookload:.6g}"
    if bent:
        return  # the row holds its toolface, and the top drive of a run leaves the string to turn to where it rests
    off, allowed = abs(rows["surface_torque_N_m"] - point.surface_torque), LEAST_TORQUE * ARM * weight
    assert off <= allowed + TORQUE * abs(point.surface_torque), (
        f"{kind}: torque {rows['surface_torque_N_m']:.5g} and {point.surface_torque:.5g}"
    )


@statement("a run saved and resumed = straight through", slow=True)
def run_resumed(drawn: Drawn) -> None:
    """Stopped at a drawn record: tables, notes and counts to the bit."""
    dice = drawn.dice(71)
    case = short_run(drawn, dice.pick(["trip_in", "trip_out", "back_ream"]), 0.5)
    whole = Simulation(case)
    deque(whole, maxlen=0)
    result = whole.result()
    resumed = gone_on(case, *stopped(Simulation(case), dice.whole(1, len(result.history))))
    deque(resumed, maxlen=0)
    same(resumed.result(), result)
