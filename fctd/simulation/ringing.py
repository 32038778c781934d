"""Axial ringing of a string that slides past the seams between the hole's cylinders, estimated without time steps.

A cylinder is a chord of the bend.  Along it the direction of the wall's force is tilted against the hole, from −½κℓ to
½κℓ, and jumps back at the seam.  Contact points whose distance is a multiple of the cylinder length pass seams
together, and where a harmonic of speed over cylinder length meets a natural frequency of the string, only mud damps
the oscillation.  The real hole has no seams, and a hole of arcs has none either.

The contact forces of the estimate are those of a soft string without friction, the modes those of the chain of masses
and springs.  A mode whose frequency ω changes slowly reaches the integral of its force times exp(−i∫ω dt).  The
estimate is good within a factor of two or three: it leaves out stiffness, clearance and friction, and the longer path
of points that leave the hole's axis.
"""

from typing import NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.mechanics import contact, state, waves
from fctd.model.drillstring import String
from fctd.model.operations import Phase
from fctd.model.wellbore import Wellbore
from fctd.simulation.run import Run

MODES = 2
STRIDE, SPAN = 10.0, 20.0  # [m] and [s] over which modes and contact forces are taken as constant, at most
SAMPLES = 8  # of the forces per period of the fastest mode, each a mean over its span


class Ringing(NamedTuple):
    """Expected swing of the hook load about its mean: a row for every stride of a run, a column for every mode.

    bit_depth (k,) [m]; frequency [Hz] and amplitude [N], both (k, MODES).
    """

    bit_depth: Array
    frequency: Array
    amplitude: Array

    def largest(self) -> tuple[float, float, float]:
        """Amplitude [N], frequency [Hz] and bit depth [m] of the largest swing; zeros where there is none."""
        if not self.amplitude.size:
            return 0.0, 0.0, 0.0
        row, mode = np.unravel_index(np.argmax(self.amplitude), self.amplitude.shape)
        return float(self.amplitude[row, mode]), float(self.frequency[row, mode]), float(self.bit_depth[row])


class Tilt(NamedTuple):
    """Direction of the cylinders minus that of the hole, integrated over measured depth: (k, 3) [m].

    start, step : first measured depth and distance of the rows [m].
    """

    start: float
    step: float
    integral: Array

    def means(self, edges: Array) -> Array:
        """Mean tilt (m, n, 3) of n points between successive rows of their measured depths (m + 1, n) [m]."""
        at = (edges - self.start) / self.step
        i = np.clip(at.astype(np.int64), 0, len(self.integral) - 2)
        value = self.integral[i] + (at - i)[..., None] * (self.integral[i + 1] - self.integral[i])
        return np.asarray(np.diff(value, axis=0) / np.diff(edges, axis=0)[..., None])


class Modes(NamedTuple):
    """The slowest axial modes, shape (n, MODES) of unit modal mass [kg^-1/2], all else (MODES,).

    frequency ω [rad/s]; damping [1/s]; pull : hook load of a unit modal impulse [kg^1/2 / s].
    """

    shape: Array
    frequency: Array
    damping: Array
    pull: Array


def expected_ringing(run: Run, phases: list[Phase]) -> Ringing:
    """Ringing caused by the seams between cylinders where a run feeds pipe at constant speed, each phase from rest."""
    depths: list[float] = []
    frequencies: list[Array] = []
    amplitudes: list[Array] = []
    if run.wall.seams and run.case.contact.enabled:
        tilt, probe, depth = cylinder_tilt(run.hole), state.copy_state(run.S), run.case.operations[0].start_md
        for motion, _ in phases:
            fed = 0.5 * (motion.feed_from + motion.feed_to) * motion.duration
            steady = motion.feed_from == motion.feed_to != 0
            strides = int(np.ceil(max(abs(fed) / STRIDE, motion.duration / SPAN))) if steady else 0
            reached = np.zeros(MODES, complex)
            for k in range(strides):
                middle = depth + (k + 0.5) / strides * fed
                string = run.upper_end.at_depth(middle, run, probe)
                if string.segments <= MODES:
                    continue
                modes = _modes(string, probe, run.laws)
                force, span = _forces(run, string, probe, tilt, modes, fed / strides, motion.feed_to)
                rate = 1j * modes.frequency - modes.damping
                left = span * np.arange(len(force), -1, -1)[:, None]
                reached = reached * np.exp(rate * left[0])
                reached += span * (force * np.exp(rate * (left[1:] + 0.5 * span))).sum(axis=0)
                depths.append(middle)
                frequencies.append(modes.frequency / (2 * np.pi))
                amplitudes.append(np.abs(reached) * modes.pull)
            depth += fed
    shape = (-1, MODES)
    return Ringing(np.array(depths), np.reshape(frequencies, shape), np.reshape(amplitudes, shape))


def cylinder_tilt(hole: Wellbore) -> Tilt:
    """Tilt of a hole of cylinders, whose own direction is linear between their middles.

    In an overlap Eq. 24 blends the walls, which lie a kink times v·ℓ apart at the share v of the lower one: the blend
    is v²·ℓ further, so that its direction turns by twice the share, and jumps back at the end.
    """
    ends, chords = hole.md, hole.directions[:-1]
    overlap = np.maximum(hole.pieces[:, contact.OVERLAP], 1e-3)
    step = 0.1 * max(float(overlap[:-1].min(initial=1.0)), 0.1)
    md = np.arange(ends[0] + 0.5 * step, ends[-1], step)
    i = np.clip(np.searchsorted(ends, md, side="right") - 1, 0, len(chords) - 1)
    above = np.maximum(i - 1, 0)
    lower = (md - ends[i]) / overlap[above]
    share = np.where(lower < 1, 2 * lower, 1.0)[:, None]
    middle = 0.5 * (ends[1:] + ends[:-1])
    tilt = (1 - share) * chords[above] + share * chords[i]
    tilt -= np.stack([np.interp(md, middle, part) for part in chords.T], axis=1)
    return Tilt(float(ends[0]), step, np.vstack([np.zeros(3), np.cumsum(step * tilt, axis=0)]))


def _modes(string: String, probe: Array, laws: state.Laws) -> Modes:
    """Modes of a string hanging from the top drive, whose constants are in a state buffer."""
    from scipy.linalg import eig_banded  # slow to import, and a steady string needs none

    n = string.segments
    k, mass, mud = (state.row(probe, offset, n) for offset in (state.K_AXIAL, state.MASS, state.MUD_AXIAL))
    # The waves within a long segment come first: their springs reach from them to its lower end, and to the top.
    signs, masses, springs = np.reshape(waves.hung(probe, 0), (-1, 3)).T
    first = len(signs)
    mass = np.concatenate([masses, mass])
    bands = np.zeros((max(first, 1) + 1, first + n))
    bands[0] = np.concatenate([springs, k + np.append(k[1:], 0.0)])
    bands[0, first] += springs.sum()
    bands[1, first:-1] = -k[1:]
    for wave in range(first):
        bands[first - wave, wave] = -signs[wave] * springs[wave]
    for apart, band in enumerate(bands):
        band[: len(mass) - apart] /= np.sqrt(mass[apart:] * mass[: len(mass) - apart])
    square, vectors = eig_banded(bands, lower=True, select="i", select_range=(0, MODES - 1))
    # The bit moves the same way in every stride, from which the oscillation goes on to the next.
    moved: Array = vectors * np.sign(vectors[-1]) / np.sqrt(mass)[:, None]
    shape, frequency = moved[first:], np.sqrt(square)
    # The mud's boundary layers follow slow modes, and brake quick ones.
    layers = (state.row(probe, state.LAYER_DRAG, n) @ shape**2) * square / (square + laws.layer_rate**2)
    damping = 0.5 * (mud @ shape**2 + layers + laws.joint_damping * square)
    pull = k[0] * shape[0] + springs @ (moved[:first] - signs[:, None] * shape[0])
    return Modes(shape, frequency, damping, np.abs(pull) / frequency)


def _forces(
    run: Run, string: String, probe: Array, tilt: Tilt, modes: Modes, length: float, speed: float
) -> tuple[Array, float]:
    """Modal forces (m, MODES) over a stride about the string's depth, and the time of each [s].

    length [m] and speed [m/s] of the stride, both negative where pipe is pulled out.
    """
    n = string.segments
    weight = string.weight * string.length
    md = string.top_md + np.cumsum(string.length)
    for _ in range(2):
        points, tangents = run.hole.at(md)
        tension = np.append(np.cumsum((weight * tangents[:, 2])[:0:-1])[::-1], 0.0)
        chords = np.diff(points, axis=0)
        reach = np.linalg.norm(chords, axis=1)
        # A segment is a chord of the bend and stretched; these few centimetres decide when it passes a seam.
        md[1:] += np.cumsum(string.length[1:] * (1 + tension[:-1] / string.of("EA")[1:]) - reach)
    load = np.zeros((n, 3))
    load[:, 2] = 0.5 * (weight + np.append(weight[1:], 0.0))
    load[1:-1] += tension[1:-1, None] * np.diff(chords / reach[:, None], axis=0)
    load -= (load * tangents).sum(axis=1)[:, None] * tangents
    places = md + state.row(probe, state.ARM_CONTACT, n) - state.row(probe, state.ARM_BOTTOM, n)
    pressed = load.any(axis=1)
    count = int(np.ceil(abs(length / speed) * modes.frequency[-1] * SAMPLES / (2 * np.pi)))
    edges = np.linspace(-0.5, 0.5, count + 1)[:, None] * length
    force = (load[pressed] * tilt.means(places[pressed] + edges)).sum(axis=-1) @ modes.shape[pressed]
    return force, abs(length / speed) / count
