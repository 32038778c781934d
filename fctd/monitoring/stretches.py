"""Stretches of a series in which the string does one thing off bottom: its readings there are those of a steady string.

The rules, whose numbers are in `Rules`:

- **in slips**: the hook load exceeds that of the block by less than a tenth of the string's weight.  Or it does by less
  than half of it, and the bit moves by less than half of what the block does: a string that slides into an
  extended-reach well is as light, and its bit moves with the block.
- **off bottom**: the bit is more than 1 m above the deepest point.  The bit leaves the bottom when the stretch of the
  weight on bit is drawn out of the string, a few decimetres, and the depth of a series is that of a rigid string.
- **rotating** (standing, up or down): at least 20 rev/min, at which the wall's speed is that of the pipe in the hole or
  more.  **pick-up** and **slack-off**: at most 5 rev/min, the noise of a resting sensor.  Between the two is neither.
- **standing**: block speed, over at least 3 s, below 0.01 m/s; **up** or **down**: above 0.02 m/s.  A block position of
  1 cm resolution has an error of 0.005 m/s over 3 s.
- A stretch ends with the second row in a row that is none of it, or where rows are more than 30 s apart: nobody knows
  what the string did in between.  The last row of a stretch is left out, since it may average over the change.
- **Settling**: the drive needs 5 s to its speed, and three round trips of a torsional wave, at 3,100 m/s, even out the
  string's torque; the axial wave is faster.  A stroke is settled where the block has moved by the stretch at reversal
  too: hook load up minus down, times the length, over 2 EA.
- What remains must last 8 s and have three rows, the fewest with quartiles.
- A stroke shorter than three times the stretch at reversal is left out: friction has not turned around everywhere.
- A stroke with more than 0.3 of the rotating torque locked in is left out: the wall's friction has one resultant, of
  which √(1 − 0.3²), 95 %, is left along the hole.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, Literal, NamedTuple, Protocol, get_args

import numpy as np
import pandas as pd

from fctd.arrays import Array

Mode = Literal["in_slips", "rotating", "rotating_up", "rotating_down", "pick_up", "slack_off"]
MODES: Final[tuple[Mode, ...]] = get_args(Mode)
ROTATING: Final = frozenset({"rotating", "rotating_up", "rotating_down"})
STROKES: Final = frozenset({"pick_up", "slack_off"})
OF_KIND: Final[dict[str, Mode]] = {"rotate_off_bottom": "rotating", "trip_out": "pick_up", "trip_in": "slack_off"}
OTHER: Final = ""
TORSION: Final = 3100.0  # [m/s], waves of torsion in steel pipe


@dataclass(frozen=True)
class Rules:
    """Limits of the rules above [m, m/s, rev/min, s]; follows : the bit's speed over the block's."""

    off_bottom: float = 1.0
    off_bottom_weight: float = 10e3  # [N], where a series has weight on bit and no hole depth
    standing: float = 0.01
    moving: float = 0.02
    follows: float = 0.5
    speed_over: float = 3.0
    turning: float = 20.0
    resting: float = 5.0
    gap: float = 30.0
    drive: float = 5.0
    round_trips: int = 3
    shortest: float = 8.0
    fewest: int = 3
    strokes_of_stretch: float = 3.0
    locked: float = 0.3


class Expected(Protocol):
    """What the rules need of the string, by bit depth (n,) [m]."""

    def slips_below(self, depth: Array) -> tuple[Array, Array]:
        """Weight indicator [N] below which the string hangs in the slips, and below which it does where the block
        moves and the bit does not."""
        ...

    def reversal(self, depth: float) -> float:
        """Stretch at reversal [m]."""
        ...

    def locked_share(self, depth: float, torque: float, rpm: float) -> float:
        """Share of the rotating torque that a reading [N m] is."""
        ...


class Quartiles(NamedTuple):
    """25 %, 50 % and 75 % of readings, and the standard error of the median (that of independent normal rows)."""

    p25: float
    median: float
    p75: float
    error: float


@dataclass(frozen=True)
class Stretch:
    """A stretch with its readings [SI].

    start, end : times [s]; first_row, last_row : in the file; samples : settled rows; torque : of the drive;
    hook_load : of the weight indicator; rpm, speed (upwards positive), flow : medians; left_out : why it tells no
    friction factor, else empty.  rows : the settled rows, with bit depth, hook load and torque.
    """

    mode: Mode
    start: float
    end: float
    first_row: int
    last_row: int
    bit_depth: float
    samples: int
    torque: Quartiles
    hook_load: Quartiles
    rpm: float
    speed: float
    flow: float
    left_out: str
    rows: Array


# Columns of the rows that a stretch gathers.
_ROW, _TIME, _DEPTH, _HOOK, _TORQUE, _RPM, _BLOCK, _FLOW, _SPEED, _LOWERED = range(10)


class Finder:
    """Finds the stretches of a series over time that comes in one piece or in several, with the same result.

    counts : stretches that were too short, by mode.
    """

    def __init__(self, expected: Expected, rules: Rules | None = None) -> None:
        self.expected, self.rules = expected, Rules() if rules is None else rules
        self.counts: Counter[str] = Counter()
        self._before: Array = np.empty((0, 3))  # time, block position and bit depth of the last rows
        self._deepest = -np.inf
        self._mode: str = OTHER
        self._rows: list[Array] = []
        self._stray: tuple[str, Array] | None = None
        self._last = -np.inf

    def feed(self, table: pd.DataFrame) -> Iterator[Stretch]:
        """The stretches that end in these rows, which follow those fed before."""
        if table.empty:
            return
        rows = self._columns(table)
        modes = self._modes(table, rows)
        for mode, row in zip(modes, rows, strict=True):
            if row[_TIME] - self._last > self.rules.gap:
                yield from self.finish()
            self._last = row[_TIME]
            if mode == self._mode:
                self._rows.append(row)
                self._stray = None
            elif self._stray is None and self._mode != OTHER:
                self._stray = (mode, row)
            else:
                stray = self._stray
                yield from self.finish()
                self._mode = mode
                self._rows = [stray[1], row] if stray is not None and stray[0] == mode else [row]

    def finish(self) -> Iterator[Stretch]:
        """End the stretch that is under way."""
        mode, rows = self._mode, self._rows
        self._mode, self._rows, self._stray = OTHER, [], None
        if mode != OTHER:
            found = self._read(next(m for m in MODES if m == mode), np.array(rows))
            if found is not None:
                yield found

    def _columns(self, table: pd.DataFrame) -> Array:
        """The rows with their speeds; remembers what the next rows need."""
        time, block = table["time_s"].to_numpy(float), table["block_position_m"].to_numpy(float)
        known = np.vstack((self._before, np.column_stack((time, block, table["bit_depth_m"].to_numpy(float)))))
        here = np.arange(len(self._before), len(known))
        then = np.searchsorted(known[:, 0], time - self.rules.speed_over, side="right") - 1
        step = time - known[then, 0]
        usable = (then >= 0) & (step <= self.rules.gap)
        speed, lowered = np.where(usable, (known[here, 1:] - known[then, 1:]).T / np.where(usable, step, 1.0), np.nan)
        self._before = known[known[:, 0] >= known[here[-1], 0] - 2 * self.rules.gap]
        flow = table["flow_m3_s"].to_numpy(float) if "flow_m3_s" in table else np.full(len(table), np.nan)
        columns = [table.index.to_numpy(float), time]
        columns += [table[name].to_numpy(float) for name in ("bit_depth_m", "weight_indicator_N", "drive_torque_N_m")]
        return np.column_stack([*columns, table["rpm"].to_numpy(float), block, flow, speed, lowered])

    def _modes(self, table: pd.DataFrame, rows: Array) -> list[str]:
        rules, depth, hook, rpm, speed = self.rules, *(rows[:, k] for k in (_DEPTH, _HOOK, _RPM, _SPEED))
        running = np.maximum.accumulate(np.concatenate(([self._deepest], depth)))[1:]
        self._deepest = float(running[-1])
        if "hole_depth_m" in table:
            hole = table["hole_depth_m"].to_numpy(float)
            off = np.where(np.isnan(hole), running, hole) - depth > rules.off_bottom
        elif "weight_on_bit_N" in table:
            off = table["weight_on_bit_N"].to_numpy(float) < rules.off_bottom_weight
        else:
            off = running - depth > rules.off_bottom
        own, still = self.expected.slips_below(depth)
        follows = np.abs(rows[:, _LOWERED]) >= rules.follows * np.abs(speed)
        slips = (hook < own) | ((hook < still) & (np.abs(speed) > rules.moving) & ~follows)
        turning, resting = rpm >= rules.turning, rpm <= rules.resting
        standing, up, down = np.abs(speed) < rules.standing, speed > rules.moving, speed < -rules.moving
        free = off & ~slips
        chosen = [slips, free & turning & standing, free & turning & up, free & turning & down, free & resting & up,
                  free & resting & down]  # fmt: skip
        return list(np.select(chosen, MODES, OTHER))

    def _read(self, mode: Mode, rows: Array) -> Stretch | None:
        """The readings of a stretch; None for one that is too short."""
        rules = self.rules
        depth = float(np.median(rows[:, _DEPTH]))
        settling = rules.drive + rules.round_trips * 2 * depth / TORSION
        travel = np.abs(rows[:, _BLOCK] - rows[0, _BLOCK])
        settled = rows[:, _TIME] >= rows[0, _TIME] + settling
        settled[-1] = False
        reversal = self.expected.reversal(depth) if mode in STROKES else 0.0
        kept = rows[settled & (travel >= reversal)]
        if len(kept) < rules.fewest or kept[-1, _TIME] - kept[0, _TIME] < rules.shortest:
            self.counts[f"{mode} too short"] += 1
            return None
        torque, rpm = quartiles(kept[:, _TORQUE]), float(np.median(kept[:, _RPM]))
        left_out = ""
        if mode in STROKES and travel.max() < rules.strokes_of_stretch * reversal:
            left_out = "stroke short of three times the stretch at reversal"
        elif mode in STROKES and self.expected.locked_share(depth, torque.median, rpm) > rules.locked:
            left_out = "torque locked in"
        return Stretch(
            mode, float(rows[0, _TIME]), float(rows[-1, _TIME]), int(rows[0, _ROW]), int(rows[-1, _ROW]),
            float(np.median(kept[:, _DEPTH])), len(kept), torque, quartiles(kept[:, _HOOK]), rpm,
            float(np.median(kept[:, _SPEED])), float(np.median(kept[:, _FLOW])), left_out,
            kept[:, [_DEPTH, _HOOK, _TORQUE]],
        )  # fmt: skip


def quartiles(values: Array) -> Quartiles:
    """Quartiles of readings, and the median's standard error."""
    low, middle, high = np.percentile(values, (25, 50, 75))
    spread = (high - low) / 1.349  # standard deviation of normal readings
    return Quartiles(float(low), float(middle), float(high), float(1.2533 * spread / np.sqrt(len(values))))


def by_depth(table: pd.DataFrame) -> Iterator[Stretch]:
    """The readings of a series by depth, one a row; operations other than ``OF_KIND`` are passed over."""
    nan = float("nan")
    for row, depth, kind, hook, torque, rpm, flow in zip(
        table.index, table["bit_depth_m"], table["operation"], table["weight_indicator_N"], table["drive_torque_N_m"],
        *(table[name] if name in table else np.full(len(table), nan) for name in ("rpm", "flow_m3_s")), strict=True,
    ):  # fmt: skip
        if kind in OF_KIND:
            of_torque, of_hook = (Quartiles(value, value, value, 0.0) for value in (float(torque), float(hook)))
            yield Stretch(OF_KIND[kind], nan, nan, row, row, float(depth), 1, of_torque, of_hook, float(rpm), nan,
                          float(flow), "", np.array([[depth, hook, torque]]))  # fmt: skip
