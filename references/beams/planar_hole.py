"""A hole in one vertical plane as exact circular arcs: the wall for beam finite elements.

No code is shared with FCTD's cylinders or arcs: the arcs are computed from the stations by plane geometry.
Points are (depth z down, horizontal x along the azimuth of the hole) [m].
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fctd.arrays import Array


class Axis(NamedTuple):
    """The axis of the hole seen from points of shape (...).

    offset (...) [m] : signed distance from the axis, positive to the high side (in the vertical: along x).
    tangent, normal (2, ...) : unit vectors downhole and to the high side.  Normal is the gradient of offset.
    turn (...) [1/m] : κ/(1 − κ offset), the rotation of tangent and normal per metre along the hole.
    md (...) [m] : measured depth.
    """

    offset: Array
    tangent: Array
    normal: Array
    turn: Array
    md: Array


class PlanarHole:
    """Stations joined by circular arcs in one plane, straight before the first and after the last."""

    def __init__(self, stations: Array) -> None:
        """stations (n, 3) : measured depth [m], inclination and azimuth [rad].

        Raises ValueError if the hole leaves its plane, or if any two directions differ by more than 90°: the planes
        between one arc and the next would then cut a distant part of the hole.
        """
        md, inclination, azimuth = stations.T
        inclined = inclination > 0
        if inclined.any() and np.ptp(azimuth[inclined] % (2 * np.pi)) > 0:
            raise ValueError("a planar hole has one azimuth")
        if np.ptp(inclination) > np.pi / 2:
            raise ValueError("a planar hole may turn by at most 90 deg")
        self.md = md
        self.curvature = np.append(np.diff(inclination) / np.diff(md), 0.0)
        self.tangent = np.stack([np.cos(inclination), np.sin(inclination)])
        self.normal = np.stack([-np.sin(inclination), np.cos(inclination)])
        self.start = np.zeros((2, len(md)))
        self.start[0, 0] = md[0]
        steps = zip(*_arc(self.curvature[:-1], np.diff(md)), strict=True)
        for i, (along, aside) in enumerate(steps):
            self.start[:, i + 1] = self.start[:, i] + along * self.tangent[:, i] + aside * self.normal[:, i]

    def at(self, md: Array) -> tuple[Array, Array]:
        """Points of the axis (2, ...) [m] at measured depths (...) [m], and its inclination there (...) [rad]."""
        piece = np.clip(np.searchsorted(self.md, md, side="right") - 1, 0, len(self.md) - 1)
        past, curvature = md - self.md[piece], self.curvature[piece]
        along, aside = _arc(curvature, past)
        tangent, normal = self.tangent[:, piece], self.normal[:, piece]
        angle = np.arctan2(tangent[1], tangent[0]) + curvature * past
        return self.start[:, piece] + along * tangent + aside * normal, angle

    def axis(self, points: Array) -> Axis:
        """Closest point of the axis to points (2, ...) [m]."""
        later = range(1, len(self.md))
        piece = np.zeros(points.shape[1:], dtype=np.int64)
        for i in later:
            piece += self._coordinates(points, np.full_like(piece, i))[0] >= 0
        along, aside = self._coordinates(points, piece)
        curvature = self.curvature[piece]
        sine, cosine = curvature * along, 1 - curvature * aside
        ratio = np.hypot(sine, cosine)  # distance from the centre over the radius
        offset = (2 * aside - curvature * (along**2 + aside**2)) / (1 + ratio)
        sine, cosine = sine / ratio, cosine / ratio
        tangent, normal = self.tangent[:, piece], self.normal[:, piece]
        bent = np.abs(curvature) > 1e-12
        travelled = np.where(bent, np.arctan2(sine, cosine) / np.where(bent, curvature, 1.0), along)
        return Axis(
            offset=offset,
            tangent=cosine * tangent + sine * normal,
            normal=cosine * normal - sine * tangent,
            turn=curvature / ratio,
            md=self.md[piece] + travelled,
        )

    def _coordinates(self, points: Array, piece: NDArray[np.int64]) -> tuple[Array, Array]:
        """Distance of points (2, ...) along the tangent and along the normal at the start of their pieces [m]."""
        away = points - self.start[:, piece]
        return (away * self.tangent[:, piece]).sum(axis=0), (away * self.normal[:, piece]).sum(axis=0)


def _arc(curvature: Array, length: Array) -> tuple[Array, Array]:
    """End points of arcs along their first tangent and towards their centre [m]."""
    half = 0.5 * curvature * length
    chord = length * np.sinc(half / np.pi)
    return chord * np.cos(half), chord * np.sin(half)
