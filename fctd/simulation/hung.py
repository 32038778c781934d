"""A string that hangs from a block: stands are added and racked back while it hangs in the slips.

Column 0 is the upper end of the string, held by the block or, in a connection, by the slips.  A stand joins at rest,
stretched and twisted as the load at the table asks, and leaves the force and torque on the string below as they are.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import state, topdrive
from fctd.mechanics.derrick import read_joint
from fctd.mechanics.drive import STIFF
from fctd.mechanics.moving_string import MovingString
from fctd.mechanics.topdrive import GRAVITY, Motion
from fctd.model.drillstring import String
from fctd.model.stands import Tally
from fctd.model.strokes import Stroke
from fctd.model.wellbore import Wellbore
from fctd.results.ledger import LOSSES
from fctd.simulation.upper_end import UpperEnd

PLACE, AXIS = [state.X, state.Y, state.Z], [state.AX, state.AY, state.AZ]
QUATERNION = [state.QW, state.QX, state.QY, state.QZ]
KINK = [state.KINK_X, state.KINK_Y]
STIFFNESS = [state.K_AXIAL, state.K_SHEAR, state.K_BEND, state.K_TWIST]
OF_JOINT = [*STIFFNESS, *KINK]


@dataclass(kw_only=True)
class Hung(UpperEnd):
    """A string that hangs from a block, and its stands.

    tally : all segments; buffer : a state buffer with all of them, not in motion; strokes : of the schedule; begun : so
    many of them, the last of which is the present one; table (3,) : where the axis of the hole crosses the rotary table
    [m]; stands : in the string; strain : stretch of the top stand over its length; last_direction : of the block,
    1 down, -1 up; speed_ratio : by how much a stroke is faster than planned, since pipe stretches.
    """

    in_derrick = True
    FACTS = ("start_depth", "stands", "strain", "last_direction", "in_slips", "speed_ratio", "begun")
    tally: Tally
    buffer: Array
    strokes: list[Stroke]
    table: Array
    stands: int
    strain: float = 0.0
    last_direction: int = 0
    speed_ratio: float = 1.0
    begun: int = 0

    def __post_init__(self) -> None:
        self.longest = self.tally.whole

    def start(self, S: Array, top: Array, bit_depth: float, hole: Wellbore) -> String:
        """Write the string with its bit at a depth [m] into fresh buffers; returns it unstretched, as it is laid."""
        self.write(S, self.stands)
        string = self.tally.string(self.stands, bit_depth)
        _, tangent = hole.at(string.top_md + np.cumsum(string.length))
        weight = float((string.weight * string.length * tangent[:, 2]).sum())
        self.strain = weight / float(string.of("EA")[0])
        height = -string.top_md * (1 + self.strain)
        top[topdrive.IN_DERRICK], top[topdrive.BLOCK_HEIGHT] = 1.0, height
        return self.tally.string(self.stands, float(self.tally.reach[self.stands]) - height)

    def write(self, S: Array, stands: int) -> None:
        """Write the constants of a string of so many stands into a buffer, clamped to column 0."""
        n, whole = int(self.tally.count[stands]), self.tally.whole
        state.columns(S)[:, 1 : n + 1] = state.columns(self.buffer)[:, whole.segments - n + 1 : whole.segments + 1]
        clamp(S, whole, whole.segments - n)

    def clamped(self) -> list[Array]:
        """Buffers of one segment, clamped to column 0: one for each kind of segment at the upper end of a stand."""
        whole, found = self.tally.whole, {}
        for k in (whole.segments - self.tally.count[1:]).tolist():
            S = state.new_state(1)
            state.columns(S)[:, 1] = state.columns(self.buffer)[:, k + 1]
            clamp(S, whole, k)
            found[whole.component[k], whole.length[k]] = S
        return list(found.values())

    def bit_depth(self, run: MovingString) -> float:
        height = float(run.top[topdrive.BLOCK_HEIGHT])
        return float(self.tally.reach[self.stands]) - height / (1 + self.strain)

    def laid_out(self, run: MovingString) -> String:
        return self.tally.string(self.stands, self.bit_depth(run))

    def at_depth(self, bit_depth: float, run: MovingString, probe: Array) -> String:
        stands = self.tally.stands_for(bit_depth)
        self.write(probe, stands)
        return self.tally.string(stands, bit_depth)

    def direction(self, kind: str) -> int:
        return self.last_direction

    def columns(self, run: MovingString) -> dict[str, Any]:
        return {"block_position_m": float(run.top[topdrive.BLOCK_HEIGHT]), "in_slips": self.in_slips}

    def moved(self, run: MovingString, motion: Motion) -> Motion:
        while self.begun < len(self.strokes) and self.strokes[self.begun].start <= run.time + 0.5 * run.step:
            self.begun += 1
            self._begin(run, self.strokes[self.begun - 1])
        if self.in_slips:
            motion = motion._replace(drive=STIFF)  # the slips hold the string, not the drive
        return motion._replace(feed_from=self.speed_ratio * motion.feed_from, feed_to=self.speed_ratio * motion.feed_to)

    def drills_on(self, run: MovingString, motion: Motion) -> bool | None:
        stroke = self.strokes[self.begun - 1] if self.begun else None
        if stroke is None or not stroke.by_weight or not motion.bit_from == motion.bit_to == 1:
            return None
        return bool(run.top[topdrive.BLOCK_HEIGHT] > stroke.target * (1 + self.strain))

    def delay(self, by: float) -> None:
        later = [stroke._replace(start=stroke.start + by) for stroke in self.strokes[self.begun :]]
        self.strokes = self.strokes[: self.begun] + later

    def _begin(self, run: MovingString, stroke: Stroke) -> None:
        connected = self.in_slips
        run.top[topdrive.TOP_FEED] = 0.0
        if stroke.change:
            run.refresh()
            before = sum(run.energy())
            (self._add if stroke.change > 0 else self._rack)(run)
            run.refresh()
            run.top[topdrive.FED_ENERGY] += sum(run.energy()) - before
        self.in_slips = stroke.in_slips
        if self.in_slips:
            return
        if connected:
            self.strain = self._stretch(run)
        height = float(run.top[topdrive.BLOCK_HEIGHT])
        self.speed_ratio = (height - stroke.target * (1 + self.strain)) / stroke.travel
        self.last_direction = 1 if stroke.travel > 0 else -1

    def _add(self, run: MovingString) -> None:
        """Screw the next stand onto the string; the block takes the load."""
        S, rows, all_rows = run.S, state.columns(run.S), state.columns(self.buffer)
        n, whole = run.segments, self.tally.whole.segments
        self.stands += 1
        m = int(self.tally.count[self.stands]) - n
        tangent, turn = S[AXIS].copy(), S[QUATERNION].copy()
        force, twist = _loads(S, 1)
        torque = S[state.K_TWIST + 1] * twist
        hinge = _hinge(S, 1)
        rows[:, m + 1 : m + n + 1] = rows[:, 1 : n + 1].copy()
        run.owner[m + 1 : m + n + 1] = run.owner[1 : n + 1].copy()
        rows[:, 1 : m + 1] = all_rows[:, whole - n - m + 1 : whole - n + 1]
        run.owner[1 : m + 1] = 0
        S[[k + m + 1 for k in OF_JOINT]] = self.buffer[[k + whole - n + 1 for k in OF_JOINT]]
        S[state.TURNS + m + 1] = 0.0
        clamp(S, self.tally.whole, whole - n - m)
        run.segments = n + m
        # From the joint at the table upwards; what a joint carries grows by the weight of the segment below it.
        for j in range(m + 1, 0, -1):
            hinge = hinge - _gap(S, j, force, tangent)
            turn = _turned(turn, twist - torque / S[state.K_TWIST + j])
            twist = 0.0
            S[[q + j - 1 for q in QUATERNION]], S[[a + j - 1 for a in AXIS]] = turn, tangent
            S[[x + j - 1 for x in PLACE]] = hinge - S[state.ARM_BOTTOM + j - 1] * tangent
            hinge = hinge - (S[state.ARM_BOTTOM + j - 1] + S[state.ARM_TOP + j - 1]) * tangent
            force = (force @ tangent - S[state.MASS + j - 1] * GRAVITY * tangent[2]) * tangent
        self._placed(run, m + 1, torque)

    def _rack(self, run: MovingString) -> None:
        """Set the slips below the top stand and rack it back."""
        S, rows = run.S, state.columns(run.S)
        n, m = run.segments, run.segments - int(self.tally.count[self.stands - 1])
        self.stands -= 1
        tangent, turn = S[AXIS].copy(), S[QUATERNION].copy()
        force, twist = _loads(S, m + 1)
        torque = S[state.K_TWIST + m + 1] * twist
        hinge = _hinge(S, m + 1)
        for row in LOSSES.values():
            S[row + m + 1] += S[row + 1 : row + m + 1].sum()
        rows[:, 1 : n - m + 1] = rows[:, m + 1 : n + 1].copy()
        run.owner[1 : n - m + 1] = run.owner[m + 1 : n + 1].copy()
        rows[:, n - m + 1 : n + 1] = rows[:, n + 1 : n + 2]
        run.segments = n - m
        clamp(S, self.tally.whole, self.tally.whole.segments - run.segments)
        S[state.TURNS + 1] = 0.0
        S[PLACE] = hinge - _gap(S, 1, force, tangent)
        S[QUATERNION] = _turned(turn, _loads(S, 1)[1] - torque / S[state.K_TWIST + 1])
        self._placed(run, 1, torque)

    def _placed(self, run: MovingString, joints: int, torque: float) -> None:
        """Height of the block, and whole turns of so many joints from the top, once the bodies are placed."""
        S = run.S
        run.top[topdrive.BLOCK_HEIGHT] = -(S[PLACE] - self.table) @ S[AXIS]
        for j in range(1, joints + 1):
            missing = torque / S[state.K_TWIST + j] - _loads(S, j)[1]
            S[state.TURNS + j] += 2 * math.pi * round(missing / (2 * math.pi))

    def _stretch(self, run: MovingString) -> float:
        """Stretch of the top stand over its length, from its upper end to the middle of its lower joint."""
        S, m = run.S, run.segments - int(self.tally.count[self.stands - 1])
        lower = S[[x + m for x in PLACE]] + S[state.ARM_BOTTOM + m] * S[[a + m for a in AXIS]]
        upper = _hinge(S, m + 1) if m < run.segments else lower
        return float((0.5 * (lower + upper) - S[PLACE]) @ S[AXIS]) / self.tally.length_of(self.stands) - 1


def clamp(S: Array, whole: String, k: int) -> None:
    """Clamp segment k of the whole string, which is body 1 of a buffer, to column 0: a spring of half its length.

    Clamped, it has no bend.
    """
    S[[row + 1 for row in KINK]] = 0.0
    for row, name in zip(STIFFNESS, ("EA", "shear", "EI", "GJ"), strict=True):
        section = whole.sections[int(whole.component[k])]
        S[row + 1] = getattr(section, name) / (0.5 * whole.length[k])


def _loads(S: Array, j: int) -> tuple[Array, float]:
    """Force (3,) of the springs of joint j on body j [N], and its twist [rad]."""
    x, y, z, twist = read_joint(S, j)
    return np.array([x, y, z]), twist


def _hinge(S: Array, j: int) -> Array:
    """Upper hinge point of body j (3,) [m]."""
    return np.asarray(S[[x + j for x in PLACE]] - S[state.ARM_TOP + j] * S[[a + j for a in AXIS]])


def _gap(S: Array, j: int, force: Array, above: Array) -> Array:
    """The gap of joint j (3,) [m] whose springs act on body j with a force (3,) [N]; above : axis of body j - 1."""
    along = above + S[[a + j for a in AXIS]]
    along /= np.linalg.norm(along)
    pull = force @ along
    return np.asarray(-(force - pull * along) / S[state.K_SHEAR + j] - pull * along / S[state.K_AXIAL + j])


def _turned(turn: Array, angle: float) -> Array:
    """A quaternion (4,), turned about the axis of its body by an angle [rad]."""
    w, x, y, z = turn
    c, s = math.cos(0.5 * angle), math.sin(0.5 * angle)
    return np.array([w * c - z * s, x * c + y * s, y * c - x * s, z * c + w * s])
