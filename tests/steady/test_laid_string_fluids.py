"""Unlike fluids in and around a string: pumped, their pressures meet at the bit; else the heavier one falls."""

from typing import Any

import numpy as np
import pytest

from fctd import equilibrium, hydraulics_of
from fctd.case.load import Case
from tests.cases import make_case, pipe

FLOW, NOZZLES = 0.03, [0.011, 0.011, 0.011]


def unlike(inside: float, **more: Any) -> Case:
    mud = {"density": 1200.0, "viscosity": 0.03, "float": True, "inside": [{"density": inside}]}
    bit = {"nozzles": NOZZLES}
    return make_case(components=[pipe(None, 20)], **({"mud": mud, "bit": bit} | more))


@pytest.mark.parametrize("inside", [1000.0, 1230.0])
def test_pressures_on_both_sides_of_the_bit_differ_by_its_drop(inside: float) -> None:
    """½ρ(Q/C A)² at the bit, within the weight of its 0.15 m of stretch, and what the pumps need at the top."""
    case = unlike(inside)
    point = equilibrium(case, "rotate_off_bottom", 1000.0, flow=FLOW)
    pressed = point.profile["inside_pressure_Pa"] - point.profile["outside_pressure_Pa"]
    area = sum(np.pi / 4 * d**2 for d in NOZZLES)
    assert pressed.iloc[-1] == pytest.approx(0.5 * inside * (FLOW / (0.95 * area)) ** 2, abs=200 * 9.81 * 0.2)
    row = hydraulics_of(case, FLOW).iloc[0]
    assert pressed.iloc[0] == pytest.approx(row["standpipe_Pa"] - row["surface_drop_Pa"], rel=1e-6)
    assert [note.code for note in point.notes] == []


@pytest.mark.parametrize("flow", [0.0, 0.005])
def test_a_heavier_column_in_a_string_with_a_float_falls_at_the_rate_that_the_note_tells(flow: float) -> None:
    """The rate of the note is that above which the pumps have work."""
    case = unlike(1900.0)
    (note,) = equilibrium(case, "rotate_off_bottom", 1000.0, flow=flow).notes
    assert note.code == "falling"
    rate = float(str(note).split("falls freely at ")[1].split()[0]) / 6e4
    table = hydraulics_of(case, [rate - 1e-4, rate + 1e-4])
    assert (table["reason"] == "none").tolist() == [False, True]
    assert table["standpipe_Pa"][1] - table["surface_drop_Pa"][1] < 1e5


def test_a_column_without_friction_has_no_rate_and_a_pressed_string_no_fall() -> None:
    mud = {"density": 1200.0, "float": True, "inside": [{"density": 1900.0}]}
    (note,) = equilibrium(unlike(0.0, mud=mud, bit={}), "rotate_off_bottom", 1000.0).notes
    assert "falls freely as nothing that the case gives holds it" in str(note)
    pressed = {"density": 1200.0, "float": True, "inside_pressure": 50e5}
    assert not equilibrium(unlike(0.0, mud=pressed), "rotate_off_bottom", 1000.0).notes
