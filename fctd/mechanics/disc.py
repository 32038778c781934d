"""A disc in a section of hole: how far its centre moves from the axis in each direction until it touches the wall."""

import numpy as np

from fctd.mechanics.jit import entry, inlined, kernel

# Normals of neighbouring directions that differ by more than this are those of two places that the disc touches at
# once [rad]; the normal of a smooth wall turns by far less.
TWO_PLACES = 0.1
# Largest half angle between two normals [rad]: sides of a groove that face each other would hold the disc by any force.
STEEPEST = 1.45
# Halvings of the angle between two directions in which the corner lies; parabolas that find the place of contact.
HALVINGS, PARABOLAS = 12, 3
# So many angles to both sides may be touched next, as the direction changes.
NEAR = 4
# Points of a wall whose radii differ by this share are those of an edge, which the disc touches itself.
EDGE = 0.15


@inlined
def touched(wall, row, q, radius, sines, cosines):
    """Way of the centre of a disc from the axis in direction q until it touches [m], the number of the angle that it
    touches, counted on from q, and the angle of its normal then.

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
    return least, q + at - side, angle + np.arctan2(reach * sines[at], reach * cosines[at] - least)


@inlined
def between(angle):
    """An angle between −π and π [rad]."""
    return angle - 2 * np.pi * np.floor(angle / (2 * np.pi) + 0.5)


@inlined
def way_to(wall, row, place, angle, radius):
    """Way of the centre of a disc in a direction until it touches the wall at a place, infinite where it passes it.

    wall (n, J) : radii [m]; place : number of an angle, which may lie between two of them; angle : of the way [rad].
    Returns the way [m] and how far the place lies aside of it and ahead of it [m].
    """
    count = wall.shape[1]
    k = int(np.floor(place + 0.5))
    t = place - k
    here, before, after = wall[row, k % count], wall[row, (k - 1) % count], wall[row, (k + 1) % count]
    reach = here + 0.5 * t * (after - before) + 0.5 * t * t * (after - 2 * here + before)
    off = place * 2 * np.pi / count - angle
    aside, ahead = reach * np.sin(off), reach * np.cos(off)
    left = radius * radius - aside * aside
    if left < 0 or ahead < 0:
        return np.inf, aside, ahead
    return ahead - np.sqrt(left), aside, ahead


@inlined
def touch_near(wall, row, at, angle, radius):
    """Where a disc on its way in a direction [rad] touches the wall near the number of an angle.

    It touches at the least of the ways, which parabolas through three of them find.  Returns the way [m], the number of
    the angle that is next to the place, and the angle of the normal there [rad].
    """
    least, found = np.inf, at
    for k in range(at - NEAR, at + NEAR + 1):
        way, _, _ = way_to(wall, row, float(k), angle, radius)
        if way < least:
            least, found = way, k
    count = wall.shape[1]
    own = wall[row, found % count]
    is_smooth = max(abs(wall[row, (found - 1) % count] - own), abs(wall[row, (found + 1) % count] - own)) < EDGE * own
    place, h = float(found), 1.0
    for _ in range(PARABOLAS if is_smooth else 0):
        before, _, _ = way_to(wall, row, place - h, angle, radius)
        here, _, _ = way_to(wall, row, place, angle, radius)
        after, _, _ = way_to(wall, row, place + h, angle, radius)
        bend = before - 2 * here + after
        t = 0.5 * (before - after) / bend if 0 < bend < np.inf else 0.0
        place, h = place + h * min(max(t, -0.5), 0.5), 0.25 * h
    way, aside, ahead = way_to(wall, row, place, angle, radius)
    return way, found, angle + np.arctan2(aside, ahead - way)


@kernel
def corner(wall, row, q, first, second, radius):
    """Normals (2) [rad] of the two places that a disc touches at once between the directions q and q + 1.

    first, second : numbers of the angles that it touches in these.  The direction is found by halving.
    """
    step = 2 * np.pi / wall.shape[1]
    low, high = (q - 0.25) * step, (q + 1.25) * step  # in one of the two the disc may touch both
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        one, one_at, _ = touch_near(wall, row, first, middle, radius)
        other, other_at, _ = touch_near(wall, row, second, middle, radius)
        if one <= other:
            low, first = middle, one_at
        else:
            high, second = middle, other_at
    _, _, one_normal = touch_near(wall, row, first, low, radius)
    _, _, other_normal = touch_near(wall, row, second, high, radius)
    return one_normal, other_normal


@entry
def roll_disc(wall, radius, cells, ways, corners):
    """Fill ways (n, cells) [m] of the centre of a disc of a radius [m] from the axis until it touches, and corners.

    wall (n, J) : radii of sections [m] at J equal angles, a multiple of ``cells``, of which every J/cells-th is that
    of a column.  corners (n, cells, 2) : where the disc touches two places at once within a cell and a half, the angle
    midway between both normals, and half of that between them [rad]; elsewhere 0.
    """
    sections, count = wall.shape
    per_cell, side = count // cells, count // 4
    beside = np.arange(-side, side + 1) * (2 * np.pi / count)
    sines, cosines = np.sin(beside), np.cos(beside)
    way, normal, place = np.empty(count), np.empty(count), np.empty(count, np.int64)
    middle, half = np.empty(count), np.empty(count)
    reach = per_cell + per_cell // 2
    for row in range(sections):
        corners[row] = 0.0
        if (wall[row] == wall[row, 0]).all():
            ways[row] = wall[row, 0] - radius
            continue
        for q in range(count):
            way[q], place[q], normal[q] = touched(wall, row, q, radius, sines, cosines)
        for q in range(count):
            half[q] = 0.0
            following = (q + 1) % count
            if between(normal[following] - normal[q]) > TWO_PLACES:
                second = place[following] + (count if following == 0 else 0)
                one, other = corner(wall, row, q, place[q], second, radius)
                # Both may be one place after all, whose normal turns fast: rounding alone would then pick the middle.
                if between(other - one) > TWO_PLACES:
                    middle[q] = one + 0.5 * between(other - one)
                    half[q] = min(0.5 * between(other - one), STEEPEST)
        for k in range(cells):
            q = k * per_cell
            ways[row, k] = way[q]
            for near in range(q - reach, q + reach):
                at = (near + count) % count
                if half[at] > corners[row, k, 1]:
                    corners[row, k, 0], corners[row, k, 1] = middle[at], half[at]
