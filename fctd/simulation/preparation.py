"""Preparation of a run: hole, string and step, and the settling of the string before the first step."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from fctd.arrays import Array
from fctd.case.errors import InputError
from fctd.case.load import Case, naming_file
from fctd.case.message import quantity, span
from fctd.mechanics import dynamics, state, topdrive, waves
from fctd.mechanics.law_names import CODES
from fctd.mechanics.moving_string import HoleWall
from fctd.mechanics.rotations import quaternion_from_axis
from fctd.mechanics.stability import SHARES, stable_step, stiffest_mode, stiffest_torsion
from fctd.mechanics.topdrive import PerMetre
from fctd.mechanics.wall_law import tangent_over_linear
from fctd.model.bent_housings import put_bends
from fctd.model.derrick import with_derrick
from fctd.model.drilling import check_weight, driller_of, drive_of, expected_drilling, rock_of
from fctd.model.drillstring import LongSegmentError, String, lay_out
from fctd.model.first_runs import to_paste
from fctd.model.fluids import fluids_of
from fctd.model.operations import Phase, depth_range, rad_per_s, schedule
from fctd.model.stands import check_stands, hang, lay_out_stands
from fctd.model.string_in_hole import check_end, check_fit, fill
from fctd.model.strokes import stand_schedule
from fctd.model.torsion import axial_period_of, period_of
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.simulation.external_contact import QueriedWall, WallQuery
from fctd.simulation.features import ASKED, OWN, refuse
from fctd.simulation.flowing_mud import pumps
from fctd.simulation.hung import Hung
from fctd.simulation.run import Run
from fctd.simulation.upper_end import Fed, UpperEnd

LONGEST_SETTLING = 400.0  # [s] simulated
# Above these limits a run would take hours or not fit into memory, most likely by an error in the case.  A step of one
# segment takes some 20 ns, a record keeps 2 kB and a row of a profile 200 bytes.
MOST_SEGMENT_STEPS = 1e12
MOST_RECORDS = 200_000
FINE_STEP = 1e-4  # [s]: of a run with short, stiff pieces; a run that is too long with it is too long by its durations
MOST_PROFILE_ROWS = 2_000_000


def prepare(case: Case, contact: WallQuery | None = None) -> tuple[Run, list[Phase]]:
    """Build hole and string of a case, lay the string on the axis of the hole and choose the step.

    contact : a contact method that replaces the hole's own pieces.  Raises InputError for a case that cannot be
    simulated.
    """
    with naming_file(case):
        run, phases = _prepare(case)
        run.take_mud_along(case.operations[0])
        phases = [_driven(run, phase) for phase in phases]
        if contact is None:
            refuse(run, OWN, "a simulation")
        else:
            refuse(run, ASKED, "another contact method")
            run.wall = QueriedWall(contact, run.hole, run.segments)
        return run, phases


def _driven(run: Run, phase: Phase) -> Phase:
    """A phase with the drive and the driller of a run."""
    motion = phase.motion._replace(drive=run.drive)
    if run.case.operations[phase.operation].on_bottom and motion.bit_from + motion.bit_to > 0:
        motion = motion._replace(driller=driller_of(run.case, run.upper_end.longest, run.laws.rock))
    return Phase(motion, phase.operation)


def _prepare(case: Case) -> tuple[Run, list[Phase]]:
    if not case.operations:
        expected = "at least one operation to simulate, such as these lines at the end of the file"
        raise InputError(expected, key="operations", value=[], lines=to_paste(case.end_as_written))
    case.check_depths()
    first, shallowest, deepest = depth_range(case)
    for i, depth in enumerate(case.record.profile_at):
        if not shallowest <= depth <= deepest:
            raise InputError(
                f"a bit depth that the operations reach, {span(shallowest, deepest, 'm')}",
                key=f"record.profile_at[{i}]",
                value=quantity(depth, "m"),
            )
    hole = build_wellbore(case)
    if case.rig.feed != "stands":
        try:
            string = lay_out(case, shallowest, deepest)
            check_fit(string, hole, deepest)
            string = replace(string.lengthened(first - shallowest), fluids=fluids_of(case, first))
            check_end(string, hole)
            return _fed(case, hole, string, first - shallowest, deepest - first)
        except LongSegmentError:
            if case.rig.feed == "long_segment" or shallowest == deepest or case.string.components[-1].long_segment:
                raise
    return _hung(case, hole, first, shallowest, deepest)


def _fed(case: Case, hole: Wellbore, string: String, longer: float, shorter: float) -> tuple[Run, list[Phase]]:
    """A run whose top drive stands still, and feeds pipe into the top segment.

    longer, shorter : by which the top segment is longer and shorter than where it is shortest and longest [m].
    """
    n = string.segments
    S, top = state.new_state(n), np.zeros(topdrive.TOP_SIZE)
    pipe = fill(S, string, case, hole)
    _unbalance(S, string)
    top[topdrive.TOP_LENGTH] = string.length[0] if string.long_segment else 0.0
    lie_on_axis(S, string, hole)
    put_bends(S, case, string, hole)
    probes = [(state.copy_state(S), n)]
    if string.long_segment:  # the top segment is stiffest where it is shortest, for the drive where its waves come in
        shortest, longest = string.length[0] - longer, string.length[0] + shorter
        lengths = shortest, min(max(waves.STIFFEST * pipe.beside, shortest), longest), longest
        probes = [(state.copy_state(S), n) for _ in lengths]
        for length, (probe, _) in zip(lengths, probes, strict=True):
            topdrive.put_long_segment(probe, length, pipe)
    phases = schedule(case.operations)
    rate = _layer_rate(case, string.lengthened(shorter))
    return _run(case, hole, string, Fed(string), S, top, pipe, probes, phases, rate), phases


def _hung(case: Case, hole: Wellbore, first: float, shallowest: float, deepest: float) -> tuple[Run, list[Phase]]:
    """A run whose string hangs from a block that moves; bit depths [m]."""
    tally = lay_out_stands(case, shallowest, deepest).filled(fluids_of(case, first))
    hole = with_derrick(hole, case.rig.derrick_height)
    check_stands(tally, hole, shallowest)
    whole = tally.whole
    phases, strokes = stand_schedule(case.operations, tally, case.rig, expected_drilling(case, whole))
    buffer, S, top = state.new_state(whole.segments), state.new_state(whole.segments), np.zeros(topdrive.TOP_SIZE)
    pipe = fill(buffer, whole, case, hole)
    hang(buffer, whole.segments)
    _unbalance(buffer, whole)
    put_bends(buffer, case, whole)
    stands = tally.stands_for(first)
    check_end(tally.string(stands, first), hole)
    upper_end = Hung(tally=tally, buffer=buffer, strokes=strokes, table=hole.at(np.zeros(1))[0][0], stands=stands)
    string = upper_end.start(S, top, first, hole)
    lie_on_axis(S, string, hole)
    put_bends(S, case, string, hole)
    probes = [(buffer, whole.segments), *((probe, 1) for probe in upper_end.clamped())]
    return _run(case, hole, string, upper_end, S, top, pipe, probes, phases, _layer_rate(case, whole)), phases


def _run(
    case: Case, hole: Wellbore, string: String, upper_end: UpperEnd, S: Array, top: Array, pipe: PerMetre,
    probes: list[tuple[Array, int]], phases: list[Phase], layer_rate: float,
) -> Run:  # fmt: skip
    """The run of a string that lies in its hole.

    probes : buffers with the string where it is stiffest, and their numbers of segments; that of the first is the
    largest of the run.  layer_rate [1/s] : of the mud's boundary layers.
    """
    n, most = string.segments, probes[0][1]
    laws = state.Laws(
        geometry=hole.geometry if case.contact.enabled else state.OPEN,
        friction=CODES[case.contact.friction_law],
        friction_scale=1.0,
        contact_damping=case.contact.damping,
        joint_damping=case.solver.joint_damping,
        shape_damping=case.solver.shape_damping,
        settling=0.0,
        **_wall_laws(case),
        rock=rock_of(case),
        torsion_damping=_torsion_damping(case, string),
        layer_rate=layer_rate,
        unbalanced=any(component.eccentricity for component in case.string.components),
        bent=any(component.bend for component in case.string.components),
        given=pumps(case),
        orthotropic=hole.orthotropic if case.contact.enabled else None,
        corners=hole.corners if case.contact.enabled else None,
        bows=True if case.contact.enabled and any(part.has_bows for part in case.string.components) else None,
    )
    limit = min(_step_limit(probe, count, case, hole, laws) for probe, count in probes)
    wanted = case.solver.step
    step = SHARES[wanted] * limit if isinstance(wanted, str) else wanted
    if step > limit * (1 + 1e-9):
        raise InputError(
            f"'auto', 'largest' or at most the stable step, {limit:.4g} s", key="solver.step", value=f"{step:g} s"
        )
    tangent = hole.at(string.top_md + np.cumsum(string.length))[1][:, 2]
    check_weight(case, float((string.weight * string.length * tangent).sum()))
    _check_cost(case, most, step, phases)
    spring = max(float(probe[state.K_TWIST + 1]) + waves.stiffness_in_torsion(probe) for probe, _ in probes)
    damper = (laws.joint_damping + laws.torsion_damping) * spring
    # A walk from the top would stop at the first slab that contains a point; past 90° that may be a distant piece.
    owner = np.zeros(most + 2, np.int64)
    owner[1 : n + 1] = hole.owners(contact_points(S, n))
    run = Run(
        case=case, hole=hole, string=string, upper_end=upper_end, pipe=pipe, S=S, top=top, owner=owner, segments=n,
        step=step, laws=laws, wall=own_wall(case, hole), drive=drive_of(case, string, spring, damper, step),
    )  # fmt: skip
    upper_end.begin(run)
    return run


def _wall_laws(case: Case) -> dict[str, float]:
    """The fields of ``Laws`` for a wall of another law than the linear one, and for mud cake on permeable walls."""
    cake = case.mud.cake
    given = dict(zip(("wall_exponent", "wall_reference"), case.contact.wall_law, strict=True))
    if cake is not None and any(interval.overbalance for interval in case.wellbore.intervals):
        given |= {"cake_thickness": cake.thickness, "cake_time": cake.time, "cake_friction": cake.friction}
    return given


def _unbalance(S: Array, string: String) -> None:
    """Write the unbalance of the bodies into a filled buffer."""
    unbalance = string.of("mass") * string.of("eccentricity") * string.length
    state.row(S, state.UNBALANCE, string.segments)[:] = unbalance


def _layer_rate(case: Case, longest: String) -> float:
    """Rate of the mud's boundary layers [1/s]: the lowest axial frequency of the run, that of the longest string.

    At four times this frequency their drag is again that of Stokes, at ten times it is 0.6 of it.
    """
    return float(2 * np.pi / axial_period_of(longest)) if case.mud.unsteady else 0.0


def _torsion_damping(case: Case, string: String) -> float:
    """Damping time [s] of torsion; damping in proportion to stiffness has the loss factor η = τω at a frequency ω."""
    factor = case.solver.loss_factor
    return factor * period_of(string) / (2 * np.pi) if factor else 0.0


def own_wall(case: Case, hole: Wellbore) -> HoleWall:
    """The wall made of the pieces of the case's own hole."""
    return HoleWall(hole.pieces, case.wellbore.geometry)


def _check_cost(case: Case, segments: int, step: float, phases: list[Phase]) -> None:
    """Raise InputError for a run that would take hours or too much memory; step [s]."""
    most = MOST_SEGMENT_STEPS / dynamics.padded_columns(segments)
    lasting = [0.0] * len(case.operations)
    for phase in phases:
        lasting[phase.operation] += phase.motion.duration
    duration = sum(lasting)
    if duration > most * max(step, FINE_STEP):
        k = int(np.argmax(lasting))
        key = "duration" if "duration" in type(case.operations[k]).model_fields else "speed"
        raise InputError(
            f"a run of at most {most * step / 3600:.3g} h, in steps of {1e3 * step:.3g} ms of {segments} segments",
            key=f"operations[{k}].{key}",
            value=f"{lasting[k] / 3600:.3g} h",
        )
    if (duration + LONGEST_SETTLING) / step > most:
        raise InputError(
            f"masses, stiffnesses, dampings and durations that need at most {most:.2g} steps of {segments} segments",
            key="solver.step",
            value=f"{step:.3g} s for {duration:g} s and up to {LONGEST_SETTLING:g} s of settling",
        )
    if duration / case.record.interval > MOST_RECORDS:
        raise InputError(f"at most {MOST_RECORDS} records", key="record.interval", value=f"{case.record.interval:g} s")
    profiles = len(case.record.profile_at)
    if profiles * (segments + 1) > MOST_PROFILE_ROWS:
        raise InputError(
            f"at most {MOST_PROFILE_ROWS // (segments + 1)} profiles of {segments} segments",
            key="record.profile_at",
            value=f"{profiles} depths",
        )


def _step_limit(S: Array, n: int, case: Case, hole: Wellbore, laws: state.Laws) -> float:
    """Largest stable step of a run [s], whose string of n segments is in a buffer where it is stiffest.

    Raises InputError where masses and stiffnesses give no finite frequency.
    """
    spin = max(rad_per_s(o.rpm) for o in case.operations)
    wall = hole.stiffest_wall if case.contact.enabled else 0.0
    wall *= tangent_over_linear(*case.contact.wall_law, case.contact.largest_penetration)
    try:
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            frequency = stiffest_mode(S, n, wall, laws.rock.stiffness)
    except np.linalg.LinAlgError:
        frequency = np.inf
    if not 0 < frequency < np.inf:
        raise InputError(
            "masses and stiffnesses with which a stable step can be computed",
            key="string.components",
            value=f"a stiffest mode of {frequency:g} rad/s",
        )
    own = case.solver.joint_damping
    torsion = stable_step(stiffest_torsion(S, n), own + laws.torsion_damping, spin)
    return min(stable_step(frequency, own, spin), torsion)


def contact_points(S: Array, n: int) -> Array:
    """Contact points of the segments (n, 3) [m]; axes must be up to date."""
    arm = state.row(S, state.ARM_CONTACT, n)
    pairs = ((state.X, state.AX), (state.Y, state.AY), (state.Z, state.AZ))
    return np.stack([state.row(S, p, n) + arm * state.row(S, a, n) for p, a in pairs], axis=1)


def lie_on_axis(S: Array, string: String, hole: Wellbore) -> None:
    """Place the string on the axis of the hole, unstretched, every joint on the axis."""
    md = string.top_md
    (start,), (tangent,) = hole.at(np.array([md]))
    joints = [start]
    for length in string.length:
        # The chord must be as long as the segment; in a bend the axis is a little longer.
        guess = md + length
        for _ in range(3):
            guess += length - np.linalg.norm(hole.at(np.array([guess]))[0][0] - joints[-1])
        md = guess
        joints.append(hole.at(np.array([md]))[0][0])
    points = np.array(joints)
    axes = np.diff(points, axis=0) / np.linalg.norm(np.diff(points, axis=0), axis=1, keepdims=True)
    n = string.segments
    centre = points[1:] - axes * state.row(S, state.ARM_BOTTOM, n)[:, None]
    turned = _transported(np.vstack([tangent, axes]))
    for k, offset in enumerate((state.X, state.Y, state.Z)):
        S[offset] = start[k]
        state.row(S, offset, n)[:] = centre[:, k]
    for k, offset in enumerate((state.AX, state.AY, state.AZ)):
        S[offset] = tangent[k]
        state.row(S, offset, n)[:] = axes[:, k]
    for k, offset in enumerate((state.QW, state.QX, state.QY, state.QZ)):
        S[offset] = turned[0, k]
        state.row(S, offset, n)[:] = turned[1:, k]


def _transported(axes: Array) -> Array:
    """Quaternions of a chain of axes (n, 3) without twist from one to the next, shape (n, 4)."""
    out = np.empty((len(axes), 4))
    out[0] = quaternion_from_axis(axes[:1])[0]
    for k, (before, after) in enumerate(pairwise(axes)):
        # The shortest rotation that takes ``before`` to ``after``, applied on the left.
        w, v = 1 + before @ after, np.cross(before, after)
        q0, q = out[k, 0], out[k, 1:]
        out[k + 1] = np.concatenate([[w * q0 - v @ q], w * q + q0 * v + np.cross(v, q)])
        out[k + 1] /= np.linalg.norm(out[k + 1])
    return out
