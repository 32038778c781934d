"""Does a sweep lose or change rows when a worker, the client, the scheduler, the disk or a sample fails?"""

import tempfile
from pathlib import Path

import pandas as pd

from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.swept_faults import LATER, SAMPLES, Sweeps

FAULTS = 20


def run(context: Context) -> Outcome:
    """Twenty seeded faults of one sweep, each resumed by the same command; one in the quick mode."""
    seeds = range(1 if context.quick else FAULTS)
    with tempfile.TemporaryDirectory(prefix="fctd-sweep-faults-") as folder:
        sweeps = Sweeps(Path(folder))
        tried = [sweeps.try_fault(seed) for seed in context.progress(seeds, "faults")]
    table = pd.DataFrame([vars(of) | {"wrong": of.wrong or "nothing"} for of in tried])
    return Outcome(
        tables={"faults": table},
        checks=[
            Check("faults of a sweep", len(tried), len(seeds), "at_least", "", "as many as were asked for"),
            Check("of them, those after which the sweep does not resume to the same rows, to the last bit",
                  sum(bool(of.wrong) for of in tried), 0, "at_most", "", "the rows of an undisturbed run"),
        ],
        notes=[
            f"A sweep of {SAMPLES} samples on two workers. A death comes up to {LATER:g} s after the first part of "
            "rows; the disk is full at the first part that is written. A sample that hangs or crashes is a row that "
            "says so, and all others are compared.",
            *(f"seed {of.seed}, {of.fault}: {of.wrong}" for of in tried if of.wrong),
        ],
        display={"faults": "Faults of a sweep, and what is wrong after it was resumed"},
    )  # fmt: skip


STUDY = Study("sweep_faults", "Does a sweep lose or change rows when something of it dies?", run)
