"""Newton's method from the guess of a soft string, more carefully with every attempt."""

from fctd.steady.continuation import CONVERGED, NOT_FINITE, Pace
from fctd.steady.problem import FULL, Pose, Problem, Share

# With large steps most strings converge in some eight iterations.  A string with little clearance needs a pseudo-time
# that shrinks when the imbalance rises; one that buckles needs small steps to converge or to find a stable shape.
# Fields of Pace: iterations, first pseudo-time [s], growth, shrink, largest lateral step [m], narrow.
Attempt = tuple[int, float, float, float, float, float]
ATTEMPTS: tuple[Attempt, ...] = (
    (25, 0.2, 3.0, 1.0, 0.05, 1.0),
    (60, 0.05, 3.0, 0.3, 0.02, 1.0),
)
# A caliper's wall turns within a cell, some 2 cm, and a ridge of it that is narrower than the hole lets a string roll
# off to either side.  A point that leaves it in one step is laid deep into the wall by the next, and back, for ever:
# steps are a twentieth of a cell, and narrower after such a one.
IN_A_ROUGH_HOLE: Attempt = (1500, 0.05, 1.5, 0.3, 1e-3, 0.5)
# Small steps of Newton's method find strings that are pushed so hard that they lie far from the guess.
SMALL_STEPS: Attempt = (300, 0.05, 1.5, 0.3, 0.005, 1.0)
# Of a string that has no balance under any share of its loads, such as one a thousand times as stiff as steel, and of
# a buckled string with the analytic force of the helix, which is added to the loads of a first balance.
PATIENT: tuple[Attempt, ...] = (
    (80, 0.1, 1.5, 1.0, 0.02, 1.0),
    (200, 0.1, 1.1, 1.0, 0.01, 1.0),
    SMALL_STEPS,
)
# Of a string without a hole, which may hang far from where it is laid: the lateral limit is that of a wall.
IN_THE_OPEN: tuple[Attempt, ...] = ((300, 0.2, 3.0, 1.0, 1e9, 1.0),)
LARGEST_TURN = 0.1  # [rad] per step


def attempts_of(problem: Problem) -> tuple[Attempt, ...]:
    """The attempts at a row before all other methods."""
    return ATTEMPTS if problem.hole.is_round else (*ATTEMPTS, IN_A_ROUGH_HOLE)


def balance(problem: Problem, attempts: tuple[Attempt, ...], share: Share = FULL) -> tuple[int, int, int]:
    """Iterate to a stable balance, more carefully with every attempt, or else to the first balance found.

    Returns code, iterations and number of unstable modes; leaves the pose in the problem.
    """
    total, code, negative = 0, NOT_FINITE, 0
    unstable: tuple[int, Pose] | None = None
    for attempt in attempts:
        problem.lay_guess(share)
        allowed = problem.allowed
        code, done = problem.iterate(Pace(*attempt, LARGEST_TURN, allowed, allowed), share)
        total += done
        if code != CONVERGED:
            continue
        negative = problem.unstable_modes(share)
        if negative == 0:
            return code, total, 0
        if unstable is None:
            unstable = negative, problem.copy_pose()
    if unstable is not None:
        code, negative = CONVERGED, unstable[0]
        problem.put_pose(unstable[1])
    return code, total, negative
