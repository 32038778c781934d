"""The exact hole against the engine's search, in random wells, past 90°, at shoes and beyond both ends."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.arena.exact_hole import ExactHole
from fctd.case.errors import InputError
from fctd.model.wellbore import build_wellbore, find_contacts
from tests.cases import make_case, pipe


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(2, 7), st.booleans())
def test_it_has_the_contacts_of_the_engine(seed: int, count: int, in_plane: bool) -> None:
    rng = np.random.default_rng(seed)
    steps, turns = rng.uniform(20, 200, count), rng.uniform(-25, 40, count)
    inclination = np.abs(np.cumsum(np.append(0.0, turns))) % 170
    azimuth = np.cumsum(np.append(0.0, np.zeros(count) if in_plane else rng.uniform(-60, 60, count)))
    stations = np.column_stack([np.append(0.0, np.cumsum(steps)), inclination, azimuth]).tolist()
    end = stations[-1][0]
    sizes = [
        {"to_md": 0.4 * end, "diameter": 0.3, "friction": 0.2},
        {"to_md": end, "diameter": 0.2159, "friction": 0.2},
    ]
    case = make_case(stations, [pipe(10, 1)], wellbore={"geometry": "arcs", "intervals": sizes})
    exact, engine = ExactHole(case.wellbore), build_wellbore(case)
    md = rng.uniform(-5.0, end + 5.0, 200)
    places = exact.off_axis(md, rng.uniform(0, 2 * np.pi, 200), rng.uniform(0.01, 0.2, 200))
    found, expected = exact.contacts(places, np.full(200, 0.05)), find_contacts(engine, places, 0.05)
    np.testing.assert_allclose(found.penetration, expected.penetration, atol=1e-9)
    np.testing.assert_allclose(found.normal, expected.normal, atol=1e-7)
    np.testing.assert_allclose(found.md, expected.md, atol=1e-5)


def test_a_sampled_wall_has_no_exact_contacts() -> None:
    rows = [[float(md), *[0.11] * 8] for md in range(0, 101, 10)]
    case = make_case(
        [[0, 0, 0], [100, 0, 0]], wellbore={"geometry": "sampled", "caliper": {"rows": rows, "values": "radius"}}
    )
    with pytest.raises(InputError, match="a sampled wall has no exact contacts"):
        ExactHole(case.wellbore)


def test_the_arena_needs_numpy_and_pydantic_alone() -> None:
    """Who judges a method elsewhere need not install the engine's packages."""
    heavy = "numba", "scipy", "pandas", "pint", "pyarrow", "typer", "rich"
    needed = "import sys, fctd.arena.contract, fctd.arena.result"
    asked = f"{needed}; print([name for name in {heavy} if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
