"""Stages 2 and 3 of the contact algorithm for free points, which keep no copy of their piece (see contact.py)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.mechanics.contact import (
    ALONE_FROM,
    ALONE_TO,
    FACTOR,
    FACTOR_AROUND,
    HOLE_RADIUS,
    START_MD,
    STIFFNESS,
    arc_owner,
    arc_wall,
    axis_offset,
    cylinder_owner,
    cylinder_wall,
    read_arc,
    wall_of_arc,
)
from fctd.mechanics.jit import entry, inlined, kernel
from fctd.mechanics.sampled import sampled_wall
from fctd.mechanics.state import CYLINDERS, LANES

# Points of one arc in a packed operation; with one or two points it does not pay.
TOGETHER, FEW = 64, 2


# Columns of the walls beside free points: PT, hole radius, stiffness, friction along the string, measured depth,
# friction around the string.
WALL_COLUMNS = 8


class Walls(NamedTuple):
    """Walls beside points, one row per point.

    offset (n, 3) : PT, from the hole axis to the point [m]; radius (n,) : hole radius [m]; stiffness (n,) [N/m, or
    N/m/m]; friction (n,) : factor along the string; md (n,) : measured depth [m]; around (n,) : factor around it.
    """

    offset: NDArray[np.float64]
    radius: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    friction: NDArray[np.float64]
    md: NDArray[np.float64]
    around: NDArray[np.float64]


def walls_in(out: NDArray[np.float64]) -> Walls:
    """The columns of ``query_walls`` by name."""
    return Walls(out[:, :3], out[:, 3], out[:, 4], out[:, 5], out[:, 6], out[:, 7])


@inlined
def write_wall(out, j, wall):
    """Write the wall beside free point j."""
    out[j, 0], out[j, 1], out[j, 2], out[j, 3], out[j, 4], out[j, 5], out[j, 6], out[j, 7] = wall


@kernel
def look_up_cylinder(C, points, j, owner, out):
    """Wall beside point j by a walk along the table; not inlined, since its square roots would slow the loop."""
    x, y, z = points[j, 0], points[j, 1], points[j, 2]
    owner[j] = cylinder_owner(C, owner[j], x, y, z)
    write_wall(out, j, cylinder_wall(C, owner[j], x, y, z))


@kernel
def query_cylinders(C, points, owner, out):
    """``query_walls`` in a hole of cylinders."""
    for j in range(points.shape[0]):
        x, y, z = points[j, 0], points[j, 1], points[j, 2]
        i = owner[j]
        px, py, pz, s = axis_offset(C, i, x, y, z)
        hole = C[i, HOLE_RADIUS]
        in_hole = px * px + py * py + pz * pz <= hole * hole
        # One branch: the processor predicts two separate ones wrongly more often.
        if in_hole & (C[i, ALONE_FROM] < s) & (s <= C[i, ALONE_TO]):
            md, around = C[i, START_MD] + s, C[i, FACTOR_AROUND]
            write_wall(out, j, (px, py, pz, hole, C[i, STIFFNESS], C[i, FACTOR], md, around))
        else:
            look_up_cylinder(C, points, j, owner, out)


@kernel
def walls_of_arc(arc, W, count):
    """Walls beside ``count`` points of one arc; W : 3 rows of ``TOGETHER`` coordinates, then WALL_COLUMNS of walls."""
    for k in range(count):
        px, py, pz, hole, stiffness, friction, md, around = wall_of_arc(arc, W[k], W[TOGETHER + k], W[2 * TOGETHER + k])
        W[3 * TOGETHER + k], W[4 * TOGETHER + k], W[5 * TOGETHER + k] = px, py, pz
        W[6 * TOGETHER + k], W[7 * TOGETHER + k], W[8 * TOGETHER + k] = hole, stiffness, friction
        W[9 * TOGETHER + k], W[10 * TOGETHER + k] = md, around


@kernel
def query_arcs(C, points, owner, out):
    """``query_walls`` in a hole of arcs: consecutive points in one arc are packed."""
    W = np.zeros((3 + WALL_COLUMNS) * TOGETHER)
    first, n = 0, points.shape[0]
    while first < n:
        i = arc_owner(C, owner[first], points[first, 0], points[first, 1], points[first, 2])
        count, same = 0, True
        while same:
            j = first + count
            W[count], W[TOGETHER + count], W[2 * TOGETHER + count] = points[j, 0], points[j, 1], points[j, 2]
            owner[j] = i
            count += 1
            j += 1
            same = count < TOGETHER and j < n and arc_owner(C, owner[j], points[j, 0], points[j, 1], points[j, 2]) == i
        if count > FEW:
            walls_of_arc(read_arc(C, i), W, (count + LANES - 1) // LANES * LANES)
            for k in range(count):
                for column in range(WALL_COLUMNS):
                    out[first + k, column] = W[(3 + column) * TOGETHER + k]
        else:
            for j in range(first, first + count):
                write_wall(out, j, arc_wall(C, i, points[j, 0], points[j, 1], points[j, 2]))
        first += count


@entry
def query_walls(C, geometry, points, owner, out):
    """Walls beside free points.  points : (n, 3) [m]; owner : (n,) first guess in, owner out.

    Where a hole is sampled they are those of its arcs: ``query_sampled`` has those of its cells.

    out : (n, WALL_COLUMNS); ``walls_in`` gives its columns by name.
    """
    if geometry == CYLINDERS:
        query_cylinders(C, points, owner, out)
    else:
        query_arcs(C, points, owner, out)


@entry
def query_sampled(C, points, radii, owner, out, slopes):
    """``query_walls`` in a sampled hole, beside points of a string with contact radii (n,) [m].

    slopes (n, 3) : gradient of the penetration, along which the wall presses.
    """
    for j in range(points.shape[0]):
        x, y, z = points[j, 0], points[j, 1], points[j, 2]
        owner[j] = arc_owner(C, owner[j], x, y, z)
        wall = sampled_wall(C, owner[j], x, y, z, radii[j])
        write_wall(
            out, j,
            (wall.px, wall.py, wall.pz, wall.hole, wall.stiffness, wall.friction, wall.md, wall.around),
        )  # fmt: skip
        slopes[j, 0], slopes[j, 1], slopes[j, 2] = wall.gx, wall.gy, wall.gz
