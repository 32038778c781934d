"""A Cosserat rod pushed at its lower end."""

import numpy as np
import pytest

from fctd.model.wellbore import build_wellbore
from validation.parts.buckled_pipe import BELOW_SURFACE, HOLE, SECTION, Rig


@pytest.mark.slow(seconds=16)  # it compiles what other tests use, too
def test_pushed_rod_shortens_by_its_axial_stiffness() -> None:
    """Far below the onset of buckling: F L/EA; the bit sags by the reaction of a propped cantilever, 3/8 wL."""
    from references.beams.cosserat import Bit, rest

    length, force, wall = 6.0, 20e3, 1e7
    hole = build_wellbore(Rig(length, 1.0).case)
    bottom = BELOW_SURFACE + length
    rod = rest(hole, SECTION, BELOW_SURFACE, bottom, 6, wall, 20.0, 1e-5, 20.0, Bit(force, 0.5 * HOLE))
    ends = rod.nodes[[0, -1]]
    assert np.diff(ends[:, 0])[0] == pytest.approx(length - force * length / SECTION.EA, abs=2e-6)
    sag = 0.375 * SECTION.weight * length / (wall * 0.5)  # on half an element of wall
    assert ends[1, 1:] - ends[0, 1:] == pytest.approx([0.0, sag], rel=0.02, abs=1e-9)
