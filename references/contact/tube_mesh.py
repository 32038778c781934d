"""The hole as a triangle mesh: a tube of flat facets between rings on the axis of the hole.

Vertices lie on the wall, also on that of a sampled hole.  So facets of a round hole lie inside it: by the sagitta
r(1 − cos π/n) across the hole and by κℓ²/8 along the outside of a bend.  Normals point out of the hole, both ends are
open.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from fctd.arena.method import Settings
from fctd.arrays import Array, Contacts
from fctd.case import units
from fctd.case.errors import InputError, Table
from fctd.case.load import Case
from fctd.model.pieces import RUN_OUT, TO_MD
from fctd.model.wellbore import Wellbore, build_wellbore
from references.registry import import_optional

MOST_TRIANGLES = 20_000_000
# What studies try, from coarse to fine: facets around and distance of rings [m].
MESHES = tuple(
    {"facets": facets, "ring_spacing": ring} for facets, ring in ((12, 4.0), (24, 2.0), (48, 2.0), (96, 1.0))
)


class TubeOptions(Table):
    """Facets around the hole; largest distance between rings [m]; largest error of the facets in a bend [m].

    smooth_normals : whether a contact's normal is interpolated between those of the vertices.
    """

    facets: Annotated[int, units.Whole(at_least=3)] = 48
    ring_spacing: units.PositiveLength = 2.0
    chord_tolerance: units.PositiveLength | None = None
    smooth_normals: bool = False


@dataclass(frozen=True)
class Tube:
    """A mesh of a hole and the axis it was built on.

    mesh : trimesh.Trimesh, faces in order of depth, 2 · facets between two rings.
    options : options of the mesh.  md (k,) [m], centres (k, 3) [m] : depths and centres of the rings.
    radius : largest hole radius [m].
    """

    mesh: Any
    options: TubeOptions
    md: Array
    centres: Array
    across: Array
    aside: Array
    radius: float

    @cached_property
    def _rings(self) -> cKDTree:
        return cKDTree(self.centres)

    @property
    def facets(self) -> int:
        """Facets around the hole."""
        return self.options.facets

    @property
    def triangles(self) -> int:
        """Number of triangles."""
        return len(self.mesh.faces)

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Sagitta of facet and ring spacing together [m]; half of their angles together [rad]."""
        half, spacing = np.pi / self.facets, float(_spacing(self.options, curvature))
        sagitta = self.radius * (1 - np.cos(half)) + curvature * spacing**2 / 8
        return float(sagitta), float(np.hypot(half, 0.5 * curvature * spacing))

    def md_of(self, faces: NDArray[np.int64], points: Array) -> Array:
        """Measured depths (n,) [m] of points (n, 3) beside faces (n,)."""
        ring = np.clip(faces // (2 * self.facets), 0, len(self.md) - 2)
        return np.asarray(self.md[ring] + self._share(ring, points) * (self.md[ring + 1] - self.md[ring]))

    def md_near(self, points: Array) -> Array:
        """Measured depths (n,) [m] of points (n, 3) whose faces are not known."""
        return self.md_of(2 * self.facets * self.ring_above(points), points)

    def ring_above(self, points: Array) -> NDArray[np.int64]:
        """The ring (n,) above each of the points (n, 3): each lies between this one and the next."""
        _, ring = self._rings.query(points)
        before = np.clip(ring - 1, 0, None)
        start = self.centres[ring]
        ahead = np.sum((points - start) * (start - self.centres[before]), axis=1) >= 0
        return np.minimum(np.where(ahead, ring, before), len(self.md) - 2)

    def axis_beside(self, ring: NDArray[np.int64], points: Array) -> Array:
        """Feet (n, 3) of points (n, 3) on the chords of the axis below rings (n,)."""
        span = self.centres[ring + 1] - self.centres[ring]
        return np.asarray(self.centres[ring] + self._share(ring, points)[:, None] * span)

    def _share(self, ring: NDArray[np.int64], points: Array) -> Array:
        """Where points (n, 3) lie between rings (n,) and the next ones, as a share of the distance."""
        start = self.centres[ring]
        span = self.centres[ring + 1] - start
        return np.asarray(np.sum((points - start) * span, axis=1) / np.sum(span * span, axis=1))

    def face_beside(self, ring: NDArray[np.int64], points: Array) -> NDArray[np.int64]:
        """A face (n,) of the facet that points (n, 3) below rings (n,) face, seen from the axis."""
        span, offset = self.centres[ring + 1] - self.centres[ring], points - self.axis_beside(ring, points)
        across = np.asarray(self.mesh.vertices)[ring * self.facets] - self.centres[ring]
        aside = np.cross(span / np.linalg.norm(span, axis=1)[:, None], across)
        turn = np.arctan2(np.sum(offset * aside, axis=1), np.sum(offset * across, axis=1)) % (2 * np.pi)
        facet = np.minimum((turn * self.facets / (2 * np.pi)).astype(np.int64), self.facets - 1)
        return np.asarray(2 * (ring * self.facets + facet))

    def contacts(self, points: Array, radii: Array, near: Array, faces: NDArray[np.int64]) -> Contacts:
        """Contacts of points whose nearest points on the mesh (n, 3) and their faces (n,) are known."""
        to_wall = near - points
        distance = np.sqrt(np.sum(to_wall * to_wall, axis=1))
        outwards = self.normals[faces]
        side = np.where(np.sum(to_wall * outwards, axis=1) < 0, -1.0, 1.0)
        reliable = distance > 1e-9
        normal = np.where(
            reliable[:, None], side[:, None] * to_wall / np.where(reliable, distance, 1.0)[:, None], outwards
        )
        return Contacts(radii - side * distance, normal, self.md_of(faces, points))

    @cached_property
    def normals(self) -> Array:
        """Unit normals of the faces (m, 3), out of the hole."""
        return np.asarray(self.mesh.face_normals)

    @cached_property
    def vertex_normals(self) -> Array:
        """Unit normals of the vertices (k, facets, 3) by ring, means of those of the faces around, out of the hole."""
        return np.asarray(self.mesh.vertex_normals).reshape(len(self.md), self.facets, 3)

    def smoothed(self, hits: Contacts, points: Array) -> Contacts:
        """Contacts of points (n, 3) [m] with normals interpolated between the four vertices around each point."""
        known = np.isfinite(hits.md)
        md, places = hits.md[known], points[known]
        ring = np.clip(np.searchsorted(self.md, md, side="right") - 1, 0, len(self.md) - 2)
        down = ((md - self.md[ring]) / (self.md[ring + 1] - self.md[ring]))[:, None]
        offset = places - ((1 - down) * self.centres[ring] + down * self.centres[ring + 1])
        angle = np.arctan2((offset * self.aside[ring]).sum(axis=1), (offset * self.across[ring]).sum(axis=1))
        turns = angle / (2 * np.pi) * self.facets
        first = np.floor(turns).astype(int)
        share = (turns - first)[:, None]
        a, b = first % self.facets, (first + 1) % self.facets
        corners = self.vertex_normals
        above = (1 - share) * corners[ring, a] + share * corners[ring, b]
        below = (1 - share) * corners[ring + 1, a] + share * corners[ring + 1, b]
        mixed = (1 - down) * above + down * below
        normal = hits.normal.copy()
        normal[known] = mixed / np.linalg.norm(mixed, axis=1, keepdims=True)
        return hits._replace(normal=normal)


class MeshMethod(ABC):
    """Common part of the contact methods that query the tube mesh."""

    settings: ClassVar[Settings] = MESHES
    tube: Tube

    @abstractmethod
    def contacts(self, points: Array, radii: Array) -> Contacts:
        """Contacts with the facets as the library finds them; see ``ContactMethod.query``."""

    def query(self, points: Array, radii: Array) -> Contacts:
        """See ``ContactMethod.query``."""
        hits = self.contacts(points, radii)
        return self.tube.smoothed(hits, points) if self.tube.options.smooth_normals else hits

    @property
    def pieces(self) -> int:
        """Number of triangles."""
        return self.tube.triangles

    def error_bound(self, curvature: float) -> tuple[float, float]:
        """Errors of the mesh, see ``Tube.error_bound``."""
        return self.tube.error_bound(curvature)


def build_tube(case: Case, options: TubeOptions) -> Tube:
    """The mesh of a case's hole, from 10 m above the first station to 10 m beyond the last.

    Raises InputError for a ring spacing longer than the hole, or for more triangles than fit into memory.
    """
    trimesh = import_optional("trimesh", "trimesh", "a triangle mesh", "contact")
    hole = build_wellbore(case)
    reach = hole.total_depth - hole.md[0]
    if options.ring_spacing > reach and "ring_spacing" in options.model_fields_set:
        raise InputError(
            f"at most the length of the hole, {reach:g} m", key="ring_spacing", value=f"{options.ring_spacing:g} m"
        )
    md = _ring_depths(hole, options)
    if 2.0 * options.facets * len(md) > MOST_TRIANGLES:
        raise InputError(
            f"at most {MOST_TRIANGLES:.0g} triangles",
            key="facets",
            value=f"{2.0 * options.facets * len(md):.3g} triangles",
        )
    centres, across, aside = ring_frames(hole, md)
    angle = 2 * np.pi * np.arange(options.facets) / options.facets
    spokes = np.cos(angle)[:, None] * across[:, None] + np.sin(angle)[:, None] * aside[:, None]
    radius = hole.radii_towards(md, spokes)
    vertices = (centres[:, None] + radius[:, :, None] * spokes).reshape(-1, 3)
    mesh = trimesh.Trimesh(vertices, _faces(len(md), options.facets), process=False, validate=False)
    tube = Tube(mesh, options, md, centres, across, aside, float(radius.max()))
    check_tube(tube)
    return tube


def check_tube(tube: Tube) -> None:
    """Raise InputError unless the lateral surface is closed and its normals point out of the hole."""
    mesh, n = tube.mesh, tube.facets
    edges = np.sort(mesh.edges, axis=1)
    # One number per edge: sorting rows takes several times longer.
    _, counts = np.unique(edges[:, 0] * len(mesh.vertices) + edges[:, 1], return_counts=True)
    open_edges = int((counts == 1).sum())
    if open_edges != 2 * n or (counts > 2).any():
        raise InputError(
            f"a tube with {2 * n} open edges, those of its two ends", key="mesh", value=f"{open_edges} open edges"
        )
    faces = np.arange(len(mesh.faces))
    ring = faces // (2 * n)
    middle = 0.5 * (tube.centres[ring] + tube.centres[ring + 1])
    inwards = np.sum((mesh.triangles_center - middle) * tube.normals, axis=1) <= 0
    if not mesh.is_winding_consistent or inwards.any():
        raise InputError(
            "normals that all point out of the hole", key="mesh", value=f"{int(inwards.sum())} that do not"
        )


def curvature_at(hole: Wellbore, md: Array) -> Array:
    """Curvatures (n,) [1/m] of the pieces of a hole at measured depths (n,) [m]; 0 in cylinders and run-outs."""
    if hole.courses is None:
        return np.zeros_like(md)
    course = np.searchsorted(hole.courses.md, md, side="right") - 1
    inside = (md >= hole.md[0]) & (md <= hole.md[-1])
    return np.asarray(np.where(inside, hole.courses.curvature[course], 0.0))


def _spacing(options: TubeOptions, curvature: Array | float) -> Array:
    """Largest distance between rings [m] at these curvatures [1/m]: a chord of length ℓ is κℓ²/8 off its arc."""
    if options.chord_tolerance is None:
        return np.full_like(curvature, options.ring_spacing)
    chord = np.sqrt(8 * options.chord_tolerance / np.maximum(curvature, 1e-12))
    return np.asarray(np.minimum(options.ring_spacing, chord))


def _ring_depths(hole: Wellbore, options: TubeOptions) -> Array:
    """Measured depths of the rings: ends of the pieces, changes of size, and enough between them."""
    knots = hole.wall_along()[:, TO_MD]
    inside = knots[(knots > hole.md[0]) & (knots < hole.md[-1])]
    breaks = np.union1d(hole.md, inside)
    # Depths that differ by a rounding error would give triangles without area.
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > 1e-6])]
    breaks = np.concatenate([[breaks[0] - RUN_OUT], breaks, [breaks[-1] + RUN_OUT]])
    # A piece is a straight cylinder or an arc that may go on for hundreds of metres.
    spacing = _spacing(options, curvature_at(hole, 0.5 * (breaks[1:] + breaks[:-1])))
    counts = np.maximum(np.ceil(np.diff(breaks) / spacing - 1e-9).astype(int), 1)
    parts = [np.linspace(a, b, k, endpoint=False) for a, b, k in zip(breaks, breaks[1:], counts, strict=False)]
    return np.append(np.concatenate(parts), breaks[-1])


def ring_frames(hole: Wellbore, md: Array) -> tuple[Array, Array, Array]:
    """Centres and two unit vectors across the hole (k, 3), transported along the axis without twist."""
    inside = np.clip(md, hole.md[0], hole.md[-1])
    centres, tangents = hole.at(inside)
    centres = centres + (md - inside)[:, None] * tangents
    # A ring between two straight pieces is normal to the mean of their directions.
    before = np.vstack([tangents[:1], np.diff(centres, axis=0)])
    before /= np.linalg.norm(before, axis=1, keepdims=True)
    after = np.vstack([before[1:], before[-1:]])
    tangents = before + after
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    across = np.empty_like(tangents)
    last = np.eye(3)[np.argmin(np.abs(tangents[0]))]
    for k, tangent in enumerate(tangents):
        last = last - (last @ tangent) * tangent
        last /= np.sqrt(last @ last)
        across[k] = last
    return centres, across, np.cross(tangents, across)


def _faces(rings: int, facets: int) -> NDArray[np.int64]:
    """Two triangles for each facet between two rings, in order of depth, wound so that normals point outwards."""
    row = facets * np.arange(rings - 1)[:, None]
    here = np.arange(facets)[None, :]
    turn = (here + 1) % facets
    a, b, c, d = row + here, row + turn, row + facets + here, row + facets + turn
    return np.stack([np.stack([a, b, c], axis=-1), np.stack([b, d, c], axis=-1)], axis=2).reshape(-1, 3)
