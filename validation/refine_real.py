"""``fctd refine`` on a real survey of eight kilometres, bent a little everywhere."""

from validation.refine import judge
from validation.study import Context, Outcome, Study
from validation.wells import real_well


def run(context: Context) -> Outcome:
    """K05-ENC-05-S1, 5 in pipe in 8.5 in hole."""
    return judge(
        {"K05-ENC-05-S1": (real_well(context), 8161.0)},
        context,
        "Hole, string, mud and friction are assumed, the survey is real: 568 stations, 8,161 m.",
    )


STUDY = Study(
    "refine_real", "Does fctd refine land within its tolerance in a real well?", run, reproduce=False, needs=("data",)
)
