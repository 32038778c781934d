"""Stretch of strings by pull, pressures and temperature, against numbers that the literature prints."""

from typing import Any

import numpy as np
import pytest

from fctd import equilibrium
from fctd.case.load import Case
from fctd.model.drillstring import String, lay_out
from fctd.model.string_in_hole import squeeze_of
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.steady.steady_string import Equilibrium
from tests.cases import make_case, pipe

INCH, FOOT, PSI, POUND = 0.0254, 0.3048, 6894.757293168, 4.4482216152605


def stretch(string: String, case: Case, hole: Wellbore) -> float:
    """By how much the unloaded string is longer than its tally [m]."""
    return -float(squeeze_of(case, string, hole) @ string.length)


def test_stretch_by_temperature_is_that_of_the_literature() -> None:
    """10,000 ft, 80 to 375 °F linear: 122.1 in with 6.9e-6/°F."""
    feet = 0.3048
    hole = [[0, 0, 0], [10_000 * feet, 0, 0]]
    rows = [{"tvd": 0, "change": 0}, {"tvd": "10000 ft", "change": "295 degF"}]
    case = make_case(hole, [pipe(None, 100)], temperature=rows)
    found = stretch(lay_out(case, 10_000 * feet), case, build_wellbore(case))
    assert found / 0.0254 == pytest.approx(122.1, abs=0.1)
    cold, warm = (equilibrium(one, "trip_out", 10_000 * feet) for one in (make_case(hole, [pipe(None, 100)]), case))
    longer = warm.profile["md_m"].iloc[-1] - cold.profile["md_m"].iloc[-1]
    assert longer / 0.0254 == pytest.approx(122.1, abs=0.1)


def test_stretch_of_pipe_under_pressure_inside() -> None:
    """(1 − 2ν) p A_i/EA: 3000 m of 5 in 19.5 lb/ft are 0.316 m longer at 200 bar inside."""
    inch = 0.0254
    parts = [pipe(None, 100, outer=5 * inch, inner=4.276 * inch)]
    case = make_case([[0, 0, 0], [3000, 0, 0]], parts, mud={"inside_pressure": 200e5, "float": True})
    assert stretch(lay_out(case, 3000.0), case, build_wellbore(case)) == pytest.approx(0.316, abs=5e-4)


# Lubinski, Althouse & Logan (1962): 10,000 ft of 2 7/8 in tubing of 6.5 lb/ft whose end moves in a seal bore.
LENGTH, SEGMENTS = 10_000 * FOOT, 400
STEEL = 0.25 * np.pi * (2.875**2 - 2.441**2) * INCH**2  # 1.812 in²
MASS = 6.5 * 0.45359237 / FOOT
TUBING = pipe(
    None,
    SEGMENTS,
    outer=2.875 * INCH,
    inner=2.441 * INCH,
    linear_mass=MASS,
    density=MASS / STEEL,
    youngs_modulus=30e6 * PSI,
)  # fmt: skip
OIL = 0.0317 * 0.45359237 / INCH**3
OPEN: dict[str, Any] = {"density": OIL, "packer_bore": float(np.sqrt(8.30 * 4 / np.pi)) * INCH}
CEMENTED = {
    **OPEN, "inside": [{"density": "15 ppg"}], "inside_pressure": "5000 psi", "outside_pressure": "1000 psi"
}  # fmt: skip


def tubing(mud: dict[str, Any], **more: Any) -> Equilibrium:
    """The tubing in a vertical casing that leaves it 1.61 in, straight: a balance that it would leave for its helix."""
    hole = {"intervals": [{"to_md": LENGTH + 10, "diameter": (2.875 + 2 * 1.61) * INCH, "friction": 0.0}]}
    case = make_case([[0, 0, 0], [LENGTH + 10, 0, 0]], [TUBING], wellbore=hole, mud=mud, **more)
    return equilibrium(case, "trip_out", LENGTH)


@pytest.mark.slow
def test_the_tubing_of_lubinski_althouse_and_logan() -> None:
    """Piston −67.92, ballooning −34.74, temperature −16.56 in by the engine; the helix −46.24 in by its closed form.

    The paper prints −165.2 in for all.  Straight tubing is shorter by the first three; what it is shorter by in its
    helix follows from the engine's end force and weight.
    """
    before, after = tubing(OPEN), tubing(CEMENTED)
    cold = tubing(CEMENTED, temperature=[{"tvd": 0, "change": "-20 degF"}])
    ends = [point.profile["md_m"].iloc[-1] for point in (before, after, cold)]
    straight, cooled = np.diff(ends) / INCH
    assert cooled == pytest.approx(-16.56, rel=0.005)
    profiles, length = (before.profile, after.profile), after.case.string.components[0]
    bore, outside = (0.25 * np.pi * d**2 for d in (length.inner_diameter, length.outer_diameter))
    EA = length.youngs_modulus * STEEL
    inside = [OIL * 9.80665 * profiles[0]["md_m"], profiles[1]["inside_pressure_Pa"]]
    around = [OIL * 9.80665 * profiles[0]["md_m"], profiles[1]["outside_pressure_Pa"]]
    along = np.linspace(0.0, LENGTH, len(profiles[0]))
    pulled = profiles[1]["true_tension_N"] - profiles[0]["true_tension_N"]
    pushed = (inside[1] - inside[0]) * bore - (around[1] - around[0]) * outside
    piston = float(np.trapezoid(pulled, along)) / EA / INCH
    ballooning = -2 * length.poisson_ratio * float(np.trapezoid(pushed, along)) / EA / INCH
    assert piston == pytest.approx(-67.92, rel=0.005)
    assert ballooning == pytest.approx(-34.74, rel=0.005)
    # Half of the lowest segment has no spring to stretch.
    assert straight == pytest.approx(piston * (1 - 0.5 / SEGMENTS) + ballooning, rel=1e-3)
    force = -after.profile["effective_tension_N"].iloc[-1]
    EI, weight = 30e6 * PSI * np.pi / 64 * (2.875**4 - 2.441**4) * INCH**4, lay_out(after.case, LENGTH).weight[0]
    helix = -((1.61 * INCH) ** 2) * force**2 / (8 * EI * weight) / INCH
    assert helix == pytest.approx(-46.24, rel=0.005)
    assert straight + cooled + helix == pytest.approx(-165.2, rel=0.005)


def test_the_free_point_of_stuck_pipe() -> None:
    """30,000 lbf that stretch 5 in drill pipe of 17.93 lb/ft by 24 in say that it is free down to 10,547 ft.

    Half of the lowest segment does not stretch, so that they are short.
    """
    depth = 10_547 * FOOT
    parts = [pipe(None, 1000, outer=5 * INCH, inner=4.276 * INCH, youngs_modulus=30e6 * PSI)]
    hole = {"intervals": [{"to_md": depth + 10, "diameter": 0.2159, "friction": 0.0}]}

    def end(overpull: float) -> float:
        bit = {"overpull": overpull}
        case = make_case([[0, 0, 0], [depth + 10, 0, 0]], parts, wellbore=hole, mud={"density": 1200.0}, bit=bit)
        return float(equilibrium(case, "trip_out", depth).profile["md_m"].iloc[-1])

    assert (end(30e3 * POUND) - end(0.0)) / INCH == pytest.approx(24.0, rel=1e-3)
