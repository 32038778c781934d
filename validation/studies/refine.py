"""``fctd refine`` on wells it was not tuned on: is the error within the tolerance, and does grading help?"""

from fctd import Case
from validation.cases import load
from validation.cases.wells import COLLAR, HEAVY, S_WELL, TURN, assembly, well
from validation.harness.study import Context, Outcome, Study
from validation.parts.refinement import judge


def wells() -> dict[str, tuple[Case, float]]:
    """Cases and bit depths on which no number of ``fctd refine`` was chosen."""
    return {
        "johancsik3": (load("johancsik3"), 3718.0),
        "S-well": (well("S-well", S_WELL, assembly((COLLAR, 120.0), (HEAVY, 150.0)), {}), S_WELL[-1][0]),
        "build and turn": (well("turn", TURN, assembly((COLLAR, 90.0)), {}, 0.3, "paper"), TURN[-1][0]),
    }


def run(context: Context) -> Outcome:
    """The three wells."""
    return judge(
        wells(),
        context,
        "The layouts' and the estimate's numbers were chosen on paper-well, its variant b, the 4.5°/30 m build, the "
        "catenary, the 30°/100 ft well and wells drawn at random; the wells here were written down before that, and "
        "none was run until the numbers were fixed.",
    )


STUDY = Study(
    "refine",
    "Is the error of fctd refine within its tolerance on wells it was not tuned on, and does grading help?",
    run,
    reproduce=True,
)
