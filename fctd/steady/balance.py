"""Newton's method from the guess of a soft string, more carefully with every attempt."""

from fctd.steady.continuation import CONVERGED, NOT_FINITE, Pace
from fctd.steady.problem import FULL, Pose, Problem, Share

# With large steps most strings converge in some eight iterations.  A string with little clearance needs a pseudo-time
# that shrinks when the imbalance rises; one that buckles needs small steps to converge or to find a stable shape.
# Fields of Pace: iterations, first pseudo-time [s], growth, shrink, largest lateral step [m].
Attempt = tuple[int, float, float, float, float]
ATTEMPTS: tuple[Attempt, ...] = (
    (25, 0.2, 3.0, 1.0, 0.05),
    (60, 0.05, 3.0, 0.3, 0.02),
)
# Small steps of Newton's method find strings that are pushed so hard that they lie far from the guess.
SMALL_STEPS: Attempt = (300, 0.05, 1.5, 0.3, 0.005)
# Of a string that has no balance under any share of its loads, such as one a thousand times as stiff as steel, and of
# a buckled string with the analytic force of the helix, which is added to the loads of a first balance.
PATIENT: tuple[Attempt, ...] = (
    (80, 0.1, 1.5, 1.0, 0.02),
    (200, 0.1, 1.1, 1.0, 0.01),
    SMALL_STEPS,
)
# Of a string without a hole, which may hang far from where it is laid: the lateral limit is that of a wall.
IN_THE_OPEN: tuple[Attempt, ...] = ((300, 0.2, 3.0, 1.0, 1e9),)
LARGEST_TURN = 0.1  # [rad] per step


def balance(problem: Problem, attempts: tuple[Attempt, ...], share: Share = FULL) -> tuple[int, int, int]:
    """Iterate to a stable balance, more carefully with every attempt, or else to the first balance found.

    Returns code, iterations and number of unstable modes; leaves the pose in the problem.
    """
    total, code, negative = 0, NOT_FINITE, 0
    unstable: tuple[int, Pose] | None = None
    for iterations, tau, growth, shrink, shift in attempts:
        problem.lay_guess(share)
        allowed = problem.allowed
        pace = Pace(iterations, tau, growth, shrink, shift, LARGEST_TURN, allowed, allowed)
        code, done = problem.iterate(pace, share)
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
