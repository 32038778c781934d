"""Textbook formulae give the numbers that their books print."""

import pytest

from references.hydraulics import witnesses


def test_printed_numbers() -> None:
    """Within 1 psi: Guo & Liu 2.5 and 2.8, Lapeyrouse's surge, and the bit's formula."""
    assert witnesses.turbulent_bore(10.5, 300, 3.826, 35, 9500 + 479) == pytest.approx(605, abs=1)
    assert witnesses.turbulent_bore(10.5, 300, 2.25, 35, 450) == pytest.approx(340, abs=1)
    assert witnesses.nozzles(12, 400, (12, 12, 12)) == pytest.approx(1610, abs=1)
    surge = witnesses.lapeyrouse_surge({600: 140, 300: 80}, 7.875, 4.5, 14300, 270)
    assert surge == pytest.approx(716, abs=1)


def test_the_sign_in_the_book() -> None:
    """67 psi as printed, 91.0 where the wall drags the mud down against its flow."""
    assert witnesses.burkhardt_surge(37, 6, 14.75, 10.75, 6400, 110, sign=-1) == pytest.approx(67, abs=1)
    assert witnesses.burkhardt_surge(37, 6, 14.75, 10.75, 6400, 110, sign=1) == pytest.approx(91.0, abs=0.1)
