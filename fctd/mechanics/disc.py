"""A disc in a section of hole: how far its centre moves from the axis in each direction until it touches the wall."""

import numpy as np

from fctd.mechanics.jit import entry, inlined

# Normals of neighbouring directions that differ by more than this are those of two places that the disc touches at
# once [rad]; the normal of a smooth wall turns by far less.
TWO_PLACES = 0.1
# A groove whose sides face each other, within this [rad], would hold the disc with any force.
STEEPEST = 0.1


@inlined
def touched(wall, row, q, radius, sines, cosines):
    """Way of the centre of a disc from the axis in direction q until it touches [m], and the angle of its normal then.

    wall (n, J) : radii [m] at J equal angles, of which q is one; sines, cosines : of the angles from −90° to 90° beside
    it.  A point of the wall at the angle Δ is touched after R cos Δ − √(r² − R² sin² Δ).
    """
    count, side = wall.shape[1], len(sines) // 2
    least, at = np.inf, side
    for k in range(len(sines)):
        reach = wall[row, (q + k - side + count) % count]
        aside = reach * sines[k]
        left = radius * radius - aside * aside
        if left >= 0 and reach * cosines[k] - np.sqrt(left) < least:
            least, at = reach * cosines[k] - np.sqrt(left), k
    reach = wall[row, (q + at - side + count) % count]
    angle = q * 2 * np.pi / count
    return least, angle + np.arctan2(reach * sines[at], reach * cosines[at] - least)


@inlined
def between(angle):
    """An angle between −π and π [rad]."""
    return angle - 2 * np.pi * np.floor(angle / (2 * np.pi) + 0.5)


@entry
def roll_disc(wall, radius, cells, ways, grips):
    """Fill ways (n, cells) [m] of the centre of a disc of a radius [m] from the axis until it touches, and grips.

    wall (n, J) : radii of sections [m] at J equal angles, a multiple of ``cells``, of which every J/cells-th is that
    of a column.  A disc that touches two places is pressed onto each by more than the force that holds it there: grip
    is the sum of both forces over theirs together, less 1.  It is cos δ/cos β − 1, with the two normals at β to either
    side of their middle, and the force at δ from it.
    """
    sections, count = wall.shape
    per_cell, side = count // cells, count // 4
    beside = np.arange(-side, side + 1) * (2 * np.pi / count)
    sines, cosines = np.sin(beside), np.cos(beside)
    way, normal = np.empty(count), np.empty(count)
    for row in range(sections):
        if (wall[row] == wall[row, 0]).all():
            ways[row], grips[row] = wall[row, 0] - radius, 0.0
            continue
        for q in range(count):
            way[q], normal[q] = touched(wall, row, q, radius, sines, cosines)
        for k in range(cells):
            ways[row, k] = way[k * per_cell]
        for k in range(cells):
            q = k * per_cell
            widest, at = 0.0, q
            for near in range(-per_cell, per_cell):
                turned = between(normal[(q + near + 1 + count) % count] - normal[(q + near + count) % count])
                if turned > widest:
                    widest, at = turned, (q + near + count) % count
            grips[row, k] = 0.0
            if widest < TWO_PLACES:
                continue
            slope = (ways[row, (k + 1) % cells] - ways[row, (k - 1 + cells) % cells]) * cells / (4 * np.pi)
            force = q * 2 * np.pi / count - np.arctan2(slope, ways[row, k])
            half = min(0.5 * widest, 0.5 * np.pi - STEEPEST)
            off = between(force - normal[at] - 0.5 * widest)
            if abs(off) < half:
                grips[row, k] = np.cos(off) / np.cos(half) - 1
