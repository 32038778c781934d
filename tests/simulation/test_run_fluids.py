"""Runs of strings with fluids by depth: against steady strings, with equal fluids, stopped, and refused."""

from typing import Any

import pytest

from fctd import Case, InputError, equilibrium, simulate
from fctd.simulation.preparation import prepare
from fctd.simulation.simulate import Simulation
from tests.cases import make_case, pipe, rotation, trip
from tests.simulation.kept import gone_on, same, stopped
from tests.simulation.test_run_saver_resume import finished

BUILD = [[0, 0, 0], [300, 0, 0], [900, 70, 0], [1500, 90, 0]]
# A flotation collar in the bend, and air below it.
FLOATED: dict[str, Any] = {
    "density": 1200.0, "float": True,
    "inside": [{"to_md": 700.0, "density": 1200.0, "plug": True}, {"density": 0.0, "pressure": 1e5}],
}  # fmt: skip


def casing(operation: dict[str, Any], mud: dict[str, Any], feed: str = "stands") -> Case:
    hole = {"intervals": [{"to_md": 1500.0, "diameter": 0.3111, "friction": 0.3}], "geometry": "arcs"}
    part = pipe(None, None, outer=0.244475, inner=0.2204974, contact_diameter=0.27, linear_mass=70.0)
    rig = {"feed": feed, "block_weight": 1e6, "connection_time": 1.0}
    return make_case(BUILD, [{**part, "segment_length": 20.0}], [operation], wellbore=hole, mud=mud, rig=rig)


def test_a_turning_string_hangs_as_a_steady_one() -> None:
    case = casing(rotation(1430.0, 60.0, ramp=10.0), FLOATED, "auto")
    run, point = simulate(case), equilibrium(case, "rotate_off_bottom", 1430.0)
    assert run.status == "completed"
    assert run.history["hookload_N"].iloc[-8:].mean() == pytest.approx(point.hookload, rel=1e-6)
    found, expected = run.profile, point.profile
    for name in ("inside_pressure_Pa", "outside_pressure_Pa", "true_tension_N"):
        assert found[name].to_numpy() == pytest.approx(expected[name].to_numpy(), rel=1e-3, abs=3e3)


@pytest.mark.parametrize("operation", [trip(1420.0, 1424.0, 0.5, 1.0), trip(1424.0, 1420.0, 0.5, 1.0)])
def test_equal_fluids_are_one_mud_to_the_last_bit(operation: dict[str, Any]) -> None:
    rows = [{"to_md": 444.0, "density": 1200.0}, {"density": 1200.0}]
    one, two = (simulate(casing(operation, mud)) for mud in ({"density": 1200.0}, {"inside": rows, "outside": rows}))
    assert one.history.equals(two.history)
    assert one.profile.equals(two.profile[one.profile.columns])


def test_fluids_keep_their_places_along_a_string_that_moves() -> None:
    """The collar goes down with the string: its weight stays, where a steady string at the lower depth has more mud."""
    case = casing(trip(1400.0, 1420.0, 0.5, 1.0), FLOATED)
    run, _ = prepare(case)
    assert run.string.fluids is not None
    assert run.string.fluids.inside.end == (pytest.approx(700.0), 0.0)
    assert run.laid_out.fluids is run.string.fluids


def test_a_run_goes_on_bitwise_the_same() -> None:
    case = casing(trip(1420.0, 1424.0, 0.5, 1.0), FLOATED)
    checkpoint, chunks = stopped(Simulation(case), 3)
    same(finished(gone_on(case, checkpoint, chunks)), finished(Simulation(case)))


@pytest.mark.parametrize("feed", ["stands", "auto"])
def test_what_a_run_cannot_have_is_refused_in_a_sentence(feed: str) -> None:
    with pytest.raises(
        InputError, match=r"^mud.float = false: expected true, .* with 1.0 bar inside .* fluid would flow in$"
    ):
        prepare(casing(rotation(1430.0, 1.0), {**FLOATED, "float": False}, feed))
    with pytest.raises(InputError, match=r"^mud.packer_bore = .*expected none, since a simulation leaves out"):
        prepare(casing(rotation(1430.0, 1.0), {"density": 1200.0, "packer_bore": 0.2}, feed))
