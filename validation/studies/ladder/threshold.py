"""The rung of stick-slip: the rotation below which the swing of a bit grows, by the transfer function of the string."""

import numpy as np
from scipy.optimize import brentq

from fctd import Case
from fctd.model.operations import rad_per_s
from validation.parts.swinging_bit import bit_spin, growth
from validation.studies.ladder.rung import NoAnswerError, Rung, Tables, case_of, section
from validation.studies.ladder.wells import PIPE, straight, well

DEPTH, COLLARS, INTEGRAL = 2000.0, 200.0, 100.0  # [m]; of the drive's controller [N m]
HOLD, ABOVE = 80.0, (1.04, 1.12)  # [s] for which the swing is watched; rotations over the threshold
MUD_TORQUE = 0.05  # rotational damping [N s]


def drilling(cut: float) -> Tables:
    """Collars and pipe below an impedance drive, in vertical hole without wall; the bit loses torque as it turns."""
    collar = {"name": "drill collar", "outer_diameter": 0.165, "inner_diameter": 0.0714, "length": COLLARS}
    string = [{**collar, "segment_length": cut}, {**PIPE, "segment_length": cut}]
    bit = {"weight_on_bit": 1e5, "torque": 4e3, "rock": {"law": "given", "weakening": 1.0, "weakening_rpm": 60.0}}
    drills = {"kind": "drill_rotating", "from_md": DEPTH, "to_md": DEPTH + 1, "speed": 0.01, "rpm": 60.0}
    tables = well(
        straight(DEPTH + 10.0, 0.0), string, contact={"enabled": False}, bit=bit, operations=[drills],
    )  # fmt: skip
    tables["mud"]["rotational_damping"] = MUD_TORQUE
    return {**tables, "rig": {"drive": "impedance", "control": {"integral": INTEGRAL}}}


def by_impedance(case: Case) -> float:
    """The rotation at which −dM/dΩ = Re Z, where Im Z = 0, Z the impedance of drive and pipe at the bit [rev/min].

    Of all frequencies at which Im Z = 0 the one with the least Re Z begins to swing first.
    """
    rock, (collar, pipe) = case.bit.rock, (section(case, k) for k in (0, 1))
    assert rock is not None

    def impedance(w: float) -> complex:
        found = np.sqrt(pipe.GJ * pipe.inertia) + INTEGRAL / (1j * w)  # that of the drive, whose P is the pipe's
        for part, length in ((pipe, DEPTH - COLLARS), (collar, COLLARS)):
            inert = part.inertia + MUD_TORQUE / (1j * w)
            own, wave = np.sqrt(part.GJ * inert), np.tanh(1j * w * length * np.sqrt(inert / part.GJ))
            found = own * (found + own * wave) / (own + found * wave)
        return complex(found)

    grid = np.linspace(0.01, 10.0, 4001)
    across = np.array([impedance(float(w)).imag for w in grid])
    steady = np.flatnonzero((across[:-1] < 0) & (across[1:] > 0))  # resonances; the others are poles
    least = min(impedance(brentq(lambda w: impedance(w).imag, grid[k], grid[k + 1])).real for k in steady)
    decay = rad_per_s(rock.weakening_rpm)
    return float(decay * np.log(case.bit.torque * rock.weakening / decay / least) * 30 / np.pi)


def by_swing(case: Case) -> float:
    """The same of the string: the growth of a small swing at two rotations above it, on to where there is none.

    Of a mode the growth is linear in −dM/dΩ, and so in exp(−Ω/Ω₀).
    """
    rock, near = case.bit.rock, by_impedance(case)
    assert rock is not None
    rpm = near * np.array(ABOVE)
    slope = np.exp(-rpm / rock.weakening_rpm)
    rate = []
    for at in rpm:
        slower = case_of(case.model_dump(exclude_defaults=True), {"operations[0].rpm": float(at)})
        rate.append(growth(*bit_spin(slower, HOLD), float(at)))
    if not rate[1] < rate[0] < 0:
        raise NoAnswerError(f"above the threshold the swing grows by {rate[0]:.3g} and {rate[1]:.3g} 1/s")
    still = slope[0] - rate[0] * (slope[1] - slope[0]) / (rate[1] - rate[0])
    return float(-np.log(still) * rock.weakening_rpm)


RUNGS = [
    Rung(
        "stick-slip threshold", "−dM/dΩ = Re Z(ω) where Im Z = 0, Z of pipe and P + I/s", drilling, by_impedance,
        {"stepper": by_swing}, "rev/min", (27.3, 20.0),
    ),
]  # fmt: skip
