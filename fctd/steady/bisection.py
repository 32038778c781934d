"""Up to which loads a string has a balance, in a few trials.

A string whose segments are too long for its waves has no shape that is worth many small steps (climb.py).  Halving the
loads says whether it lies still under those of the operation, whether its slack-off is spent, or up to which share of
them a shape was found.
"""

from fctd.steady.balance import LARGEST_TURN, SMALL_STEPS, attempts_of, balance
from fctd.steady.climb import LOW_FRICTION, Climb, Step, close, come_to_rest, keep, rolls
from fctd.steady.continuation import CONVERGED, Pace
from fctd.steady.problem import FULL, Problem, Share

# A balance that is found from the guess of a soft string takes 10 to 60 iterations, seldom more than 100.
ITERATIONS = 100
# With three trials the end is known to an eighth of what lies between the first balance and the loads.
TRIALS = 3


def bisect(problem: Problem) -> Climb:
    """A path of a few balances from less to more friction, or, without one at little friction, to more weight on bit.

    Its pose is that at full loads where they have a balance, as a rule its only one.  Else the problem is left in the
    last balance.  Without any balance the path is empty.
    """
    path = Climb()
    if _is_found(problem, path, FULL) or _is_found_patiently(problem, path, FULL):
        path.pose = path.balances[0].pose
        return path
    path.none_at.append(FULL)
    if _is_found(problem, path, Share(LOW_FRICTION, 1.0)):
        high = FULL
    else:
        high = Share(LOW_FRICTION, 1.0)
        path.none_at.append(high)
        if problem.weight_on_bit == 0 or not _is_found(problem, path, Share(LOW_FRICTION, 0.0)):
            return path
    for _ in range(TRIALS):
        low = path.balances[-1].share
        aim = Share(0.5 * (low.friction + high.friction), 0.5 * (low.weight + high.weight))
        # Beyond loads at which the string snaps, the guess may find what a step from less load does not.
        if not (_settles(problem, path, aim) or _is_found(problem, path, aim)):
            is_rolled = rolls(problem, aim)
            if not _is_found_anew(problem, path, aim):
                high, path.rolls = aim, is_rolled
                path.none_at.append(aim)
                problem.put_pose(path.balances[-1].pose)
        spent_at = _spent_at(path.steps, problem.case.rig.push)
        if path.rolls or spent_at < 1:
            break  # what keeps the string from its loads is known
    if high == FULL and not path.rolls and not spent_at < 1 and _settles(problem, path, FULL):
        path.pose = path.balances[-1].pose
    path.is_cut = problem.is_spent
    close(problem, path)
    if not path.spent_at < 1:
        path.spent_at = spent_at
    return path


def _is_found(problem: Problem, path: Climb, share: Share) -> bool:
    """Whether the guess of a soft string comes to rest."""
    problem.lay_guess(share)
    return _settles(problem, path, share)


def find_anew(problem: Problem, path: Climb) -> None:
    """Fill ``anew_at`` of a path that ends before its loads; pose and allowance of the problem stay.

    Begun anew, a string may be found to which the path does not lead.
    """
    pose, allowance = problem.copy_pose(), problem.allowance.left
    tried = (share for share in path.none_beyond() if share != FULL)
    path.anew_at = [share for share in tried if _is_found_anew(problem, Climb(), share)]
    problem.put_pose(pose)
    problem.allowance.left = allowance


def _is_found_anew(problem: Problem, path: Climb, share: Share) -> bool:
    """Whether the first methods tried for a row of these loads find a stable balance; it is added to the path.

    Newton's method is tried with friction at the string's surface, as it is for a row.
    """
    at_axis, problem.at_axis = problem.at_axis, 0
    code, iterations, negative = balance(problem, attempts_of(problem), share)
    problem.at_axis = at_axis
    path.iterations += iterations
    if code != CONVERGED or negative > 0:
        return _is_found_patiently(problem, path, share)
    keep(problem, path, share)
    return True


def _is_found_patiently(problem: Problem, path: Climb, share: Share) -> bool:
    """Whether small steps of Newton's method find a string that slides; one that turns would roll round the hole."""
    if problem.rates.spin != 0:
        return False
    problem.lay_guess(share)
    code, done = problem.iterate(Pace(*SMALL_STEPS, LARGEST_TURN, problem.allowed, problem.allowed), share)
    path.iterations += done
    return code == CONVERGED and _settles(problem, path, share)


def _settles(problem: Problem, path: Climb, share: Share) -> bool:
    """Whether the string comes to rest from its pose; its balance is added to the path."""
    code, done = come_to_rest(problem, ITERATIONS, share)
    path.iterations += done
    if code == CONVERGED:
        keep(problem, path, share)
    return code == CONVERGED


def _spent_at(steps: list[Step], push: float) -> float:
    """Share of the loads at which slack-off is spent, at the latest: NaN beyond the loads of the operation.

    By a line through the last two balances: a hook load falls faster, as friction grows with the compression.

    push : of the block [N].
    """
    if len(steps) < 2 or not steps[-1].hookload < steps[-2].hookload:
        return float("nan")
    (before, held), (now, holds) = steps[-2:]
    at = now + (now - before) * (holds + push) / (held - holds)
    return at if at < 1 else float("nan")
