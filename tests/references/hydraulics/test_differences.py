"""The two routes of the referee agree, and the second one's error is that of its grid."""

import numpy as np
import pytest

from references.hydraulics import differences, quadrature
from references.hydraulics.random_cases import KINDS, draw

FEW = list(draw(2 * len(KINDS), seed=5))


@pytest.mark.parametrize("case", FEW, ids=[case.kind for case in FEW])
def test_routes_agree(case) -> None:
    exact = quadrature.solve(*case[1:])
    found = differences.solve(*case[1:])
    assert (found.gradient, found.lift) == pytest.approx((exact.gradient, exact.lift), rel=1e-6)
    stress = max(abs(exact.pipe_stress), abs(exact.hole_stress))
    assert found.pipe_stress == pytest.approx(exact.pipe_stress, abs=1e-6 * stress)
    assert found.hole_stress == pytest.approx(exact.hole_stress, abs=1e-6 * stress)


def test_error_is_of_second_order() -> None:
    """On the mean of cases, since where the edges of a plug lie between nodes is chance."""

    def error(cells: int) -> float:
        off = [
            differences.solve(*case[1:], cells=cells).gradient / quadrature.solve(*case[1:]).gradient - 1
            for case in FEW
        ]
        return float(np.sqrt(np.mean(np.square(off))))

    order = np.log2(error(500) / error(2000)) / 2
    assert 1.8 <= order <= 2.2
