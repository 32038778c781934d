"""Sampled distance: the signed distance from the wall on regular grids along the hole, interpolated at a point.

The hole is cut into short chunks, each with a grid in axes of its own, so that grids are narrow, single precision
holds at any depth, and a point costs one look-up.  Any wall can be sampled: the hole itself, or a triangle mesh.
Between grid points the distance is interpolated by quadratic B-splines (error with the third power of the cell in a
round hole) or linearly (second power).  Memory grows with the inverse third power.
"""

from collections.abc import Callable
from typing import ClassVar, Literal

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.ndimage import spline_filter
from scipy.spatial import cKDTree

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.load import Case
from fctd.model.pieces import RUN_OUT
from fctd.model.section import contact_radii
from fctd.model.wellbore import build_wellbore
from references.contact.libigl import LibIgl
from references.contact.tube_mesh import TubeOptions, ring_frames

# Longest chunk of hole [m], and sections and directions in which its size is measured.
CHUNK, SECTIONS, DIRECTIONS = 2.0, 9, 24
# Cells beyond the wall and the ends of a chunk: a spline's weights fall by six from one grid point to the next.
MARGIN = 2
# How far into the wall the grids reach [m]; deeper points are rare, and are looked up in the wall itself.
REACH = 0.02
MOST_MEMORY = 4e9  # of all grids [B]
# Columns of a frame: corner of the grid [m], its three axes, middle of the chunk [m], its length [m], how far it begins
# below the corner [m], measured depth of its top [m], metres of measured depth per metre along it.
CORNER, AXES, MIDDLE = slice(0, 3), slice(3, 12), slice(12, 15)
LENGTH, BEFORE, TOP, STRETCH = range(15, 19)
# Norm of the error of quadratic spline interpolation over h³|f‴|, and the largest sum of |f‴| over the two directions
# across a hole for the distance from its axis, times the square of that distance.
SPLINE, THIRD = 1 / 24, 1.5 * np.sqrt(2)


CELLS = (0.04, 0.028, 0.02, 0.014)  # [m]: what studies try


class SdfOptions(TubeOptions):
    """cell : distance of grid points [m].  source : what is sampled; by default the hole if it is round, else a mesh.

    facets, ring_spacing, chord_tolerance, smooth_normals : of the mesh.
    """

    cell: units.PositiveLength = 0.02
    interpolation: Literal["quadratic", "linear"] = "quadratic"
    source: Literal["hole", "mesh"] | None = None


class Sdf:
    """A grid for each chunk of the hole; each point keeps its chunk from one query to the next."""

    name = "sdf"
    distribution: ClassVar[str] = "fctd"
    does: ClassVar[str] = "distance sampled on grids along the hole, for any wall, interpolated"
    gives_clearance = True
    Options: ClassVar[type[Table]] = SdfOptions
    settings: ClassVar[Settings] = (
        *({"cell": cell} for cell in CELLS),
        *({"cell": cell, "interpolation": "linear"} for cell in CELLS[::2]),
    )

    def __init__(self, case: Case, options: SdfOptions) -> None:
        self.options, self.hole = options, build_wellbore(case)
        source = options.source or ("hole" if self.hole.is_round else "mesh")
        mesh = TubeOptions.model_validate(options.model_dump(include=set(TubeOptions.model_fields)))
        self._mesh = LibIgl(case, mesh) if source == "mesh" else None
        self._linear = options.interpolation == "linear"
        if source == "hole" and not self.hole.is_round:
            raise InputError("mesh, since no distance is known from the wall of a caliper", key="source", value="hole")
        # Where the string touches a round hole, its axis lies at least this far from that of the hole [m].
        self._clearance = self.hole.narrowest - max(contact_radii(case.string.components))
        if options.cell > self._clearance:
            raise InputError(
                f"at most {self._clearance:.3g} m, the clearance of the string: where it touches, its axis is near "
                "that of the hole, beside which the distance from the wall has a kink; or another method",
                key="sdf.cell",
                value=f"{options.cell:g} m",
            )
        self._frames, self._shapes, self._grid = self._sampled()
        self._middles = cKDTree(self._frames[:, MIDDLE])
        self._chunk = np.empty(0, np.int64)

    def query(self, points: Array, radii: Array) -> Contacts:
        """See ``ContactMethod.query``."""
        points = np.ascontiguousarray(points, dtype=float)
        n = len(points)
        if len(self._chunk) != n:
            self._chunk = self._nearest(points)
        found = Contacts(np.empty(n), np.empty((n, 3)), np.empty(n))
        self._look_up(points, self._chunk, found)
        lost = np.flatnonzero(np.isnan(found.penetration))
        if len(lost):  # points that have jumped: their chunks are searched anew
            chunk, again = self._nearest(points[lost]), Contacts(*(part[lost] for part in found))
            self._look_up(points[lost], chunk, again)
            deep = np.flatnonzero(np.isnan(again.penetration))
            if len(deep):  # and points beyond the grids
                for part, exact in zip(again, self._source(points[lost][deep]), strict=True):
                    part[deep] = exact
            self._chunk[lost] = chunk
            for part, values in zip(found, again, strict=True):
                part[lost] = values
        return found._replace(penetration=found.penetration + radii)

    @property
    def pieces(self) -> int:
        """Number of grid points."""
        return len(self._grid)

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Remainder of the interpolation of the distance from a circle, where the string touches it.

        With a mesh its errors come on top, and half of the angle between two facets over a cell.
        """
        h = self.options.cell
        nearest = max(self._clearance - np.sqrt(2) * h, 1e-12)
        if self._linear:
            bend = 1 / nearest + curvature
            depth, turn = 0.125 * h**2 * bend, 0.5 * h * bend
        else:
            depth, turn = SPLINE * THIRD * h**3 / nearest**2, 0.25 * THIRD * h**2 / nearest**2
        depth, turn = min(depth, h / np.sqrt(2)), min(turn, np.pi)  # beside the axis
        if self._mesh is not None:
            facets = self._mesh.tube.error_bound(curvature)
            depth, turn = depth + facets[0] + 0.25 * h * np.pi / self._mesh.tube.facets, turn + 2 * facets[1]
        return float(depth), float(turn)

    def _look_up(self, points: Array, chunk: NDArray[np.int64], found: Contacts) -> None:
        _query(self._frames, self._shapes, self._grid, self.options.cell, self._linear, points, chunk, *found)

    def _nearest(self, points: Array) -> NDArray[np.int64]:
        return np.asarray(self._middles.query(points)[1], np.int64)

    def _source(self, points: Array) -> Contacts:
        """Contacts of points without extent (n, 3) [m] with the wall that is sampled."""
        source: Callable[[Array, Array], Contacts] = self.hole.contacts if self._mesh is None else self._mesh.query
        return source(points, np.zeros(len(points)))

    def _distance(self, points: Array, piece: int) -> Array:
        """Distance (n,) [m] beyond the wall that is sampled, of points (n, 3) [m] near a piece of the hole."""
        if self._mesh is not None:
            return self._source(points).penetration
        walls = self.hole.walls(points, np.full(len(points), piece))
        return np.asarray(np.sqrt(np.einsum("ij,ij->i", walls.offset, walls.offset)) - walls.radius)

    def _sampled(self) -> tuple[Array, NDArray[np.int64], NDArray[np.float32]]:
        """Frames (m, 19), shapes (m, 4) and samples of all chunks, one after the other.

        A shape: number of the first sample, and how many samples stand along each axis.
        """
        h, hole, reach = self.options.cell, self.hole, RUN_OUT + self.hole.total_depth
        md = np.linspace(hole.md[0] - RUN_OUT, reach, 1 + int(np.ceil((reach - hole.md[0] + RUN_OUT) / CHUNK)))
        centres, across, _ = ring_frames(hole, md)
        along = np.diff(centres, axis=0)
        length = np.linalg.norm(along, axis=1)
        along /= length[:, None]
        first = across[:-1] - np.sum(across[:-1] * along, axis=1)[:, None] * along
        first /= np.linalg.norm(first, axis=1, keepdims=True)
        second = np.cross(along, first)
        half = np.ceil((self._widest(md, centres, along) + REACH) / h).astype(int) + MARGIN
        # The end planes of neighbours lean against each other.
        lean = np.append(np.linalg.norm(np.diff(along, axis=0), axis=1), 0.0)
        before = np.ceil(np.sqrt(2) * half * np.maximum(lean, np.roll(lean, 1))).astype(int) + MARGIN
        counts = np.column_stack([2 * half + 1, 2 * half + 1, np.ceil(length / h).astype(int) + 2 * before + 1])
        sizes = counts.prod(axis=1)
        if 4 * sizes.sum() > MOST_MEMORY:
            raise InputError(
                f"a larger cell, with which the grids of {md[-1] - md[0]:.0f} m of hole take at most "
                f"{MOST_MEMORY / 1e9:g} GB",
                key="sdf.cell",
                value=f"{h:g} m, which takes {4e-9 * sizes.sum():.1f} GB",
            )
        starts = np.concatenate([[0], np.cumsum(sizes)[:-1]])
        corner = centres[:-1] - h * (half[:, None] * (first + second) + before[:, None] * along)
        middle = 0.5 * (centres[:-1] + centres[1:])
        frames = np.column_stack(
            [corner, first, second, along, middle, length, h * before, md[:-1], np.diff(md) / length]
        )
        grid = np.empty(int(sizes.sum()), np.float32)
        pieces = self.hole.nearest(middle)
        for frame, piece, start, count in zip(frames, pieces, starts.tolist(), counts.tolist(), strict=True):
            u, v, w = (
                h * np.arange(k)[:, None] * axis for k, axis in zip(count, frame[AXES].reshape(3, 3), strict=True)
            )
            places = (frame[CORNER] + u)[:, None, None] + v[:, None] + w
            values = self._distance(places.reshape(-1, 3), piece).reshape(count)
            grid[start : start + values.size] = (values if self._linear else spline_filter(values, order=2)).ravel()
        return frames, np.column_stack([starts, counts]).astype(np.int64), grid

    def _widest(self, md: Array, centres: Array, along: Array) -> Array:
        """Largest distance (m,) [m] of the wall of each chunk from its chord, sampled in sections and directions."""
        angle = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
        widest = np.zeros(len(along))
        for share in np.linspace(0.0, 1.0, SECTIONS):
            there = (1 - share) * md[:-1] + share * md[1:]
            axis, across, aside = ring_frames(self.hole, there)
            spokes = np.cos(angle)[:, None] * across[:, None] + np.sin(angle)[:, None] * aside[:, None]
            sag = axis - ((1 - share) * centres[:-1] + share * centres[1:])
            radius = self.hole.radii_towards(there, spokes).max(axis=1)
            widest = np.maximum(widest, radius + np.linalg.norm(sag, axis=1))
        return widest


@njit(error_model="numpy", inline="always")
def _quadratic(t):  # type: ignore[no-untyped-def]
    """Quadratic B-splines of three neighbours at a distance t of −½ to ½ from the middle one, and their slopes."""
    return (0.5 * (0.5 - t) ** 2, 0.75 - t * t, 0.5 * (0.5 + t) ** 2), (t - 0.5, -2 * t, t + 0.5)


@njit(error_model="numpy", inline="always")
def _linear(t):  # type: ignore[no-untyped-def]
    """Weights of two neighbours at a distance t of 0 to 1 from the first, and their slopes; a third has none."""
    return (1 - t, t, 0.0), (-1.0, 1.0, 0.0)


@njit(error_model="numpy", cache=True)
def _query(frames, shapes, grid, cell, linear, points, chunk, distance, normal, md):  # type: ignore[no-untyped-def]
    """Distance from the wall [m], positive beyond it, its direction, and measured depth [m]; NaN beyond the grids."""
    last = frames.shape[0] - 1
    inverse = 1 / cell
    for j in range(points.shape[0]):
        k, way = chunk[j], 0
        while True:  # to the chunk between whose ends the point lies
            f = frames[k]
            dx, dy, dz = points[j, 0] - f[0], points[j, 1] - f[1], points[j, 2] - f[2]
            w = dx * f[9] + dy * f[10] + dz * f[11]
            along = w - f[BEFORE]
            if along < 0 and k > 0 and way <= 0:
                k, way = k - 1, -1
            elif along > f[LENGTH] and k < last and way >= 0:
                k, way = k + 1, 1
            else:
                break
        chunk[j] = k
        u = (dx * f[3] + dy * f[4] + dz * f[5]) * inverse
        v = (dx * f[6] + dy * f[7] + dz * f[8]) * inverse
        w *= inverse
        if linear:
            a, b, c = int(np.floor(u)), int(np.floor(v)), int(np.floor(w))
            (wu, su), (wv, sv), (ww, sw) = _linear(u - a), _linear(v - b), _linear(w - c)
            reach = 2
        else:
            a, b, c = int(np.floor(u + 0.5)), int(np.floor(v + 0.5)), int(np.floor(w + 0.5))
            (wu, su), (wv, sv), (ww, sw) = _quadratic(u - a), _quadratic(v - b), _quadratic(w - c)
            a, b, c, reach = a - 1, b - 1, c - 1, 3
        start, nu, nv, nw = shapes[k]
        if a < 0 or b < 0 or c < 0 or a + reach > nu or b + reach > nv or c + reach > nw:
            distance[j] = np.nan
            continue
        value, gu, gv, gw = 0.0, 0.0, 0.0, 0.0
        for p in range(reach):
            for q in range(reach):
                at = start + ((a + p) * nv + b + q) * nw + c
                line, slope = 0.0, 0.0
                for r in range(reach):
                    line += ww[r] * grid[at + r]
                    slope += sw[r] * grid[at + r]
                value += wu[p] * wv[q] * line
                gu += su[p] * wv[q] * line
                gv += wu[p] * sv[q] * line
                gw += wu[p] * wv[q] * slope
        distance[j] = value
        nx, ny, nz = (
            gu * f[3] + gv * f[6] + gw * f[9],
            gu * f[4] + gv * f[7] + gw * f[10],
            gu * f[5] + gv * f[8] + gw * f[11],
        )
        size = 1 / max(np.sqrt(nx * nx + ny * ny + nz * nz), 1e-300)
        normal[j, 0], normal[j, 1], normal[j, 2] = size * nx, size * ny, size * nz
        md[j] = f[TOP] + f[STRETCH] * along
