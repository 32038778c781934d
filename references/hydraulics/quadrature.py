"""Exact laminar flow in a concentric annulus, first route: velocity and flow as integrals of the shear rate.

With τ = C/r − g r/2 (`references.hydraulics.flow`), the walls and the flow q upwards at the pipe's speed v ask for

    ∫ γ(τ) dr = v,    −∫ r² γ(τ) dr = q/π − r_o² v.

Both are derivatives of one convex function of C and g, so that Newton's method with damped steps finds the one
answer, also where the plug lies at a wall.  Each integral is split at the edges of the plug and summed by the
tanh-sinh rule (Takahasi & Mori 1974), which the roots of the flow curve at these edges do not slow down.
"""

import numpy as np

from fctd.arrays import Array
from references.hydraulics.flow import REST, Annulus, Answer, Mud, check, read, start, step_share

# Nodes and weights of the tanh-sinh rule on −1…1.
_STEP = 0.07
_t = _STEP * np.arange(-45, 46)
NODES = np.tanh(0.5 * np.pi * np.sinh(_t))
WEIGHTS = _STEP * 0.5 * np.pi * np.cosh(_t) / np.cosh(0.5 * np.pi * np.sinh(_t)) ** 2
ITERATIONS = 200
TOLERANCE = 1e-12  # of the unknowns, relative
PLUGGED = 1e-10  # fluidity that Newton's matrix keeps where nothing is sheared


def solve(annulus: Annulus, mud: Mud, flow: float, speed: float = 0.0) -> Answer:
    """Flow [m³/s] upwards past a pipe that moves down at a speed [m/s].

    Raises InputError as `check`, and RuntimeError where Newton's method does not end.
    """
    check(annulus, mud)
    if flow == 0 and speed == 0:
        return REST
    # Radii in units of the hole's, stresses of ``unit``: τ = x₀/ρ − x₁ρ.
    rate, unit = start(annulus, mud, flow, speed)
    scaled = Mud(mud.yield_stress / unit, mud.consistency * rate**mud.index / unit, mud.index)
    inner = annulus.pipe / annulus.hole
    wanted = np.array([speed, (flow / np.pi - annulus.pipe**2 * speed) / annulus.hole**2]) / (rate * annulus.hole)
    newtonian = _newtonian(inner)
    x = np.asarray(np.linalg.solve(newtonian, wanted), float)  # of a mud with the stress ``unit`` at the rate ``rate``
    for _ in range(ITERATIONS):
        got, derivatives = _integrals(inner, scaled, x)
        step = np.asarray(np.linalg.solve(derivatives + PLUGGED * newtonian, wanted - got), float)
        if np.abs(step).max() <= TOLERANCE * np.abs(x).max():
            x = x + step
            return read(annulus, mud, 2 * x[1] * unit / annulus.hole, x[0] * unit * annulus.hole)

        def slope(share: float, x: Array = x, step: Array = step) -> float:
            """Of the convex function along the step."""
            return float((_integrals(inner, scaled, x + share * step)[0] - wanted) @ step)

        x = x + step_share(slope) * step
    raise RuntimeError(f"no flow found for {annulus}, {mud}, flow {flow:g}, speed {speed:g}")


def _newtonian(inner: float) -> Array:
    """Derivatives (2, 2) of the two integrals with γ = τ."""
    cross = -0.5 * (1 - inner**2)
    return np.array([[-np.log(inner), cross], [cross, 0.25 * (1 - inner**4)]])


def _integrals(inner: float, mud: Mud, x: Array) -> tuple[Array, Array]:
    """∫γ dρ and −∫ρ²γ dρ (2,) from ``inner`` to 1, and their derivatives (2, 2) by x."""
    ends = np.array([inner, *sorted(rho for rho in _edges(mud.yield_stress, x) if inner < rho < 1), 1.0])
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * np.diff(ends)
    rho = (middle[:, None] + half[:, None] * NODES).ravel()
    weight = (half[:, None] * WEIGHTS).ravel()
    stress = x[0] / rho - x[1] * rho
    shapes = np.array([np.ones_like(rho), -(rho**2)])
    weighted = shapes * weight
    return weighted @ mud.shear_rate(stress), (weighted * mud.fluidity(stress) / rho) @ shapes.T


def _edges(yield_stress: float, x: Array) -> list[float]:
    """Radii at which |x₀/ρ − x₁ρ| is the yield stress, outside the annulus too."""
    found = []
    for limit in {yield_stress, -yield_stress}:
        square = limit**2 + 4 * x[0] * x[1]  # x₁ρ² + limit ρ − x₀ = 0
        if square < 0:
            continue
        partner = -0.5 * (limit + np.copysign(np.sqrt(square), limit))
        found += [partner / x[1]] if x[1] else []
        found += [-x[0] / partner] if partner else []
    return [float(rho) for rho in found]
