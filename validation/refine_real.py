"""``fctd refine`` on a real survey of eight kilometres, bent a little everywhere."""

from validation.cases import load
from validation.refine import judge
from validation.study import Context, Outcome, Study


def run(context: Context) -> Outcome:
    """K05-ENC-05-S1, 5 in pipe in 8.5 in hole."""
    assert context.data is not None  # the study needs it, so the runner has looked
    survey = context.data / "surveys" / "nlog_K05-ENC-05-S1.csv"
    return judge(
        {"K05-ENC-05-S1": (load("nlog_k05", wellbore__survey=survey), 8161.0)},
        context,
        "Hole, string, mud and friction are assumed, the survey is real: 568 stations, 8,161 m.",
    )


STUDY = Study(
    "refine_real", "Does fctd refine land within its tolerance in a real well?", run, reproduce=False, needs=("data",)
)
