"""Single bodies in a state buffer, placed and read as vectors."""

from scipy.spatial.transform import Rotation

from fctd.arrays import Array
from fctd.mechanics import state

PLACE, VELOCITY, AXIS = (state.X, state.Y, state.Z), (state.VX, state.VY, state.VZ), (state.AX, state.AY, state.AZ)
QUATERNION = (state.QW, state.QX, state.QY, state.QZ)
SPIN, GLOBAL_SPIN = (state.WX, state.WY, state.WZ), (state.GX, state.GY, state.GZ)
FORCE = (state.FX, state.FY, state.FZ)
ON_UPPER, ON_LOWER = (state.UX, state.UY, state.UZ), (state.LX, state.LY, state.LZ)
TO_WALL = (state.PX, state.PY, state.PZ)


def at(S: Array, j: int, rows: tuple[int, ...]) -> Array:
    """The rows of column j, copied."""
    return S[[r + j for r in rows]]


def put(S: Array, j: int, rows: tuple[int, ...], values: Array | list[float]) -> None:
    """Write the rows of column j."""
    S[[r + j for r in rows]] = values


def place(S: Array, j: int, rotation: Rotation, position: Array | list[float]) -> None:
    """Set orientation, axis and centre of mass [m] of body j."""
    put(S, j, QUATERNION, rotation.as_quat(scalar_first=True))
    put(S, j, AXIS, rotation.apply([0, 0, 1]))
    put(S, j, PLACE, position)


def set_body(S: Array, j: int, mass: float, transverse: float, axial: float) -> None:
    """Set mass [kg] and moments of inertia [kg m²] of body j, and their inverses."""
    for row, inverse, value in (
        (state.MASS, state.INVERSE_MASS, mass),
        (state.J_TRANSVERSE, state.INVERSE_JT, transverse),
        (state.J_AXIAL, state.INVERSE_JA, axial),
    ):
        S[row + j], S[inverse + j] = value, 1 / value
