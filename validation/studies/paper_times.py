"""The paper's times (§6.3, §7): the tripping speeds they imply, and our times for the same trip."""

from functools import partial

import pandas as pd

from fctd import simulate
from references import engines
from references.engines import gate
from references.timing.stopwatch import race
from validation.cases import load, trip
from validation.harness.study import ENDS, Check, Context, Outcome, Study, quartiles_of, ratio_check
from validation.parts.windows import completed

# §6.3: 0 to 2250 m of survey depth took FCTD 4 h and Adams 34 h; 150 m of vertical hole without contact 4 s and 12 s.
HOURS, ADAMS_HOURS, DEPTH = 4.0, 34.0, 2250.0
FREE_SECONDS, ADAMS_FREE_SECONDS, FREE_LENGTH = 4.0, 12.0, 150.0
KICK_OFF = 1750.0
HOUR = 3600.0
SPEED = 0.5  # [m/s], assumed in paper-well: a stand of 28 m in a minute
SLOW = 0.3  # [m/s]: a stand in a minute and a half
STAND = 28.0  # [m]: three joints
CONNECTION = 180.0  # [s]: longest connection that counts as usual in tripping, our assumption


def implied() -> pd.DataFrame:
    """The speed above which each of the paper's runs takes longer than the trip it computes."""
    runs = [
        ("FCTD, the whole survey depth, 0 to 2250 m", DEPTH, HOURS * HOUR),
        ("FCTD, from the kick-off on, 1750 to 2250 m", DEPTH - KICK_OFF, HOURS * HOUR),
        ("Adams, the whole survey depth", DEPTH, ADAMS_HOURS * HOUR),
        ("FCTD, 150 m of vertical hole without contact", FREE_LENGTH, FREE_SECONDS),
        ("Adams, the same", FREE_LENGTH, ADAMS_FREE_SECONDS),
    ]
    rows = [
        {
            "paper_run": name,
            "tripped_m": length,
            "took_s": took,
            "took_per_m_s": took / length,
            "real_time_up_to_m_s": length / took,
            "real_time_factor_at_half_a_metre_a_second": length / SPEED / took,
        }
        for name, length, took in runs
    ]
    return pd.DataFrame(rows)


def connection(took: float) -> float:
    """Connection time per stand [s] at which a trip lasts as long as computing it, ``took`` [s/m]."""
    return STAND * (took - 1 / SPEED)


def measured(rounds: int) -> pd.DataFrame:
    """The same trips by the engine: with contact from the kick-off on, and 150 m without any wall.

    Both take turns; a time per metre is processor time, settling included, and a ratio that of one round.
    """
    trips = {
        "1750 to 2250 m, with contact": load(
            "paper_well", operations=trip(KICK_OFF, DEPTH, SPEED, ramp=10.0), contact__friction_law="paper"
        ),
        "150 m of vertical hole without contact": load(
            "paper_well",
            operations=trip(KICK_OFF, KICK_OFF + FREE_LENGTH, SPEED, ramp=10.0),
            contact__friction_law="paper",
            contact__enabled=False,
            wellbore__survey=None,
            wellbore__stations=[[0, 0, 0], [4300, 0, 0]],
        ),
    }
    lengths = dict(zip(trips, (DEPTH - KICK_OFF, FREE_LENGTH), strict=True))
    runs = {name: completed(simulate(case)).run for name, case in trips.items()}
    actions = {name: partial(simulate, case) for name, case in trips.items()}
    times = race(actions, lengths, rounds, list(trips)[1]).to_dict("records")
    rows = [
        {
            "our_run": name,
            "tripped_m": lengths[name],
            **{key: run[key] for key in ("segments", "steps", "simulated_s")},
            "step_ms": 1e3 * run["step_s"],
            **{f"time_per_m_ms{end}": found[f"ns{end}"] / 1e6 for end in ENDS},
            **{
                f"real_time_factor{end}": 1e9 * run["simulated_s"] / lengths[name] / found[f"ns{slow}"]
                for end, slow in zip(ENDS, ("", "_high", "_low"), strict=True)
            },
            **{f"ratio{end}": found[f"ratio{end}"] for end in ENDS},
        }
        for (name, run), found in zip(runs.items(), times, strict=True)
    ]
    # The page strikes these times through if the engine fails the gate before any speed.
    return pd.DataFrame(rows).assign(gate=gate.verdict(gate.examine(engines.build("fctd"))))


def run(context: Context) -> Outcome:
    """Arithmetic with the paper's numbers, and two runs."""
    papers, ours = implied(), measured(3 if context.quick else 9)
    whole, free = papers.iloc[0], papers.iloc[3]
    papers_ratio = whole["took_per_m_s"] / free["took_per_m_s"]
    touching = ours.iloc[0]
    return Outcome(
        tables={"implied": papers, "ours": ours},
        checks=[
            Check("tripping speed up to which the paper's 4 h for 2250 m are real time",
                  float(whole["real_time_up_to_m_s"]), SLOW, "at_least", "m/s",
                  "§7: faster than real time; a stand of 28 m in a minute and a half"),
            Check("length of a connection from which on the paper's 4 h are real time, stands run at 0.5 m/s",
                  connection(float(whole["took_per_m_s"])), CONNECTION, "at_most", "s",
                  "§7: faster than real time; a connection takes some three minutes"),
            ratio_check("real-time factor of the engine, 1750 to 2250 m at 0.5 m/s",
                        quartiles_of(touching, "real_time_factor"), 1.0, "at_least", "§7: faster than real time"),
            Check("the paper's time per metre with contact over that without", float(papers_ratio), 2.0, "at_most", "",
                  "§1: minimal effort; contact that costs no more than the rest of the step"),
            ratio_check("the engine's time per metre with contact over that without", quartiles_of(touching, "ratio"),
                        2.0, "at_most", "§1: minimal effort; contact that costs no more than the rest of the step"),
        ],
        notes=[
            "The paper prints neither tripping speed nor step. Four hours for 2250 m are real time up to 0.16 m/s, "
            "or 560 m per hour: the average speed of a trip with connections of two minutes, but pipe between "
            "connections runs faster. If the four hours are for the 500 m from the kick-off on, the speed is 0.035 "
            "m/s.",
            "Its run without contact took 27 ms per metre, its trip 6.4 s per metre, 240 times as much. Steps, "
            "segments and speeds of the two runs may have differed; if they did not, contact took nearly all of the "
            "four hours.",
            "Ours have 61 segments on one core; the free one hangs in a vertical hole. Times are processor times, "
            "settling included and compiling left out. Both runs take turns: low and high are the quartiles of the "
            "rounds, of a ratio those of the ratios within the rounds.",
        ],
        display={"implied": "The paper's runs", "ours": "Our runs"},
    )  # fmt: skip


STUDY = Study(
    "paper_times",
    "What tripping speed and what cost of contact do the paper's times imply?",
    run,
    reproduce=True,
    timed=True,
)
