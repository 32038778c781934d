"""Centralisers, bow springs, friction reducers and swivels: closed forms, and the stepper against the steady solver."""

from typing import Any

import numpy as np
import pytest

from fctd import Case, equilibrium, limits_of, simulate
from fctd.case.errors import InputError
from fctd.mechanics.own_contact import GAP
from fctd.model.drillstring import lay_out
from tests.cases import make_case, pipe, rotation, trip

SLANT = [[0, 50, 0], [400, 50, 0]]
DEPTH, LINER, EVERY = 300.0, 120.0, 12.0  # [m]
BORE = 0.2445
RIGID = {"every": EVERY, "diameter": 0.23}
BOWS = {"every": EVERY, "diameter": 0.27, "stiffness": 4e5, "starting_force": 800.0}


def case(
    stations: Any = SLANT,
    friction: float = 0.3,
    operations: Any = None,
    geometry: str = "arcs",
    pieces: Any = None,
    **liner: Any,
) -> Case:
    """A liner of 120 m on drill pipe; pieces : keys of the wellbore."""
    cut = {} if {"centralisers", "friction_reducers"} & liner.keys() else {"segment_length": 3.0}
    parts = [
        {"name": "liner", "length": LINER, "outer_diameter": 0.1778, "inner_diameter": 0.159} | cut | liner,
        pipe(None, None, segment_length=10.0, inner=0.1086),
    ]
    hole: dict[str, Any] = {"intervals": [{"to_md": 400, "diameter": BORE, "friction": friction}], "geometry": geometry}
    hole |= pieces or {}
    mud = {"density": 1200.0, "viscosity": 0.0, "lateral_damping": 100.0}
    return make_case(stations, parts, operations, wellbore=hole, mud=mud)


def contacts(of: Case) -> np.ndarray:
    """Which contact points are those of fittings."""
    string = lay_out(of, DEPTH)
    return np.array([part.kind.value == "fitting" for part in string.parts])[string.component]


def test_fittings_are_laid_at_equal_distances_and_add_no_mass() -> None:
    bare, fitted = (lay_out(of, DEPTH) for of in (case(), case(centralisers=RIGID)))
    assert fitted.weight @ fitted.length == pytest.approx(bare.weight @ bare.length, rel=1e-12)
    above = fitted.contacts_above[1:][contacts(case(centralisers=RIGID))]
    assert len(above) == LINER / EVERY
    np.testing.assert_allclose(np.diff(above[::-1])[1:], EVERY, rtol=1e-12)  # the lowest touches at the bit's end
    assert (fitted.contact_radius()[contacts(case(centralisers=RIGID))] == 0.115).all()


@pytest.mark.slow  # it compiles what nothing else here needs
def test_rigid_centralisers_bear_the_liner_and_turn_with_their_own_radius() -> None:
    of = case(centralisers=RIGID)
    point = equilibrium(of, "rotate_off_bottom", DEPTH)
    touching = point.profile["contact_force_N"].to_numpy()[1:]
    string, fitted = lay_out(of, DEPTH), contacts(of)
    in_liner = string.component < string.component[0]
    assert touching[in_liner & ~fitted].sum() == 0
    lateral = float((string.weight * string.length)[in_liner].sum() * np.sin(np.radians(50)))
    pressed = lateral / np.sqrt(1 + 0.3**2)  # friction around the hole bears a part of it
    assert touching[fitted].sum() == pytest.approx(pressed, rel=0.05)  # the drill pipe bears an end
    torque = 0.3 * 0.115 * pressed
    bare = equilibrium(case(friction_reducers=RIGID | {"friction": 0.0}), "rotate_off_bottom", DEPTH)
    assert point.surface_torque - bare.surface_torque == pytest.approx(torque, rel=0.05)


@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_friction_reducers_have_their_own_factor_whatever_the_hole_has(geometry: str) -> None:
    reduced = RIGID | {"friction": 0.1}
    pulls = [
        equilibrium(case(friction=mu, geometry=geometry, friction_reducers=reduced), "trip_out", DEPTH).hookload
        for mu in (0.1, 0.3)
    ]
    plain = equilibrium(case(friction=0.1, geometry=geometry, centralisers=RIGID), "trip_out", DEPTH).hookload
    assert pulls[0] == pytest.approx(plain, rel=1e-9)
    alone = equilibrium(case(friction=0.3, geometry=geometry, centralisers=RIGID), "trip_out", DEPTH).hookload
    assert plain < pulls[1] < alone


def test_bow_springs_sag_by_their_load_over_their_stiffness() -> None:
    """In the middle of a long liner each bears the weight of a stretch."""
    of = case(centralisers=BOWS, friction=0.0)
    point = equilibrium(of, "rotate_off_bottom", DEPTH)
    string, fitted = lay_out(of, DEPTH), contacts(of)
    middle = np.flatnonzero(fitted)[3:-3]
    load = string.weight[-1] * EVERY * np.sin(np.radians(50))
    force = point.profile["contact_force_N"].to_numpy()[1:][middle]
    np.testing.assert_allclose(force, load, rtol=0.02)
    # A stiffness twice as large lets it sag half as far; the force stays.
    stiff = equilibrium(case(centralisers=BOWS | {"stiffness": 8e5}, friction=0.0), "rotate_off_bottom", DEPTH)
    np.testing.assert_allclose(stiff.profile["contact_force_N"].to_numpy()[1:][middle], load, rtol=0.02)
    assert [note.code for note in point.notes] == []
    assert GAP < 1e-3 * BORE


def test_the_starting_force_acts_also_where_the_liner_hangs_on_the_axis() -> None:
    """In a vertical well: ten bows of 0.8 kN, along as they slide, about the axis as they turn."""
    upright = [[0, 0, 0], [400, 0, 0]]
    of = case(upright, centralisers=BOWS)
    weight = equilibrium(case(upright, friction=0.0), "trip_out", DEPTH).hookload
    count = int(contacts(of).sum())
    assert count == 10
    assert equilibrium(of, "trip_out", DEPTH).hookload - weight == pytest.approx(count * 800.0, rel=1e-6)
    assert equilibrium(of, "trip_in", DEPTH).hookload - weight == pytest.approx(-count * 800.0, rel=1e-6)
    turned = equilibrium(of, "rotate_off_bottom", DEPTH)
    assert turned.surface_torque == pytest.approx(count * 800.0 * 0.5 * BORE, rel=1e-6)  # they slide on the wall
    assert turned.hookload == pytest.approx(weight, rel=1e-6)


@pytest.mark.parametrize(("top", "end", "rel"), [(0, 0, 1e-9), (50, 50, 1e-9), (50, 60, 2e-3)])
@pytest.mark.parametrize("operation", ["trip_out", "rotate_off_bottom"])
def test_bows_press_between_two_cylinders_as_beside_one(top: float, end: float, rel: float, operation: str) -> None:
    """Cylinders overlap along two thirds of the hole; the last well builds by 10 degrees."""
    stations = [[0, top, 0], [150, top, 0], [400, end, 0]]
    pieces = {"cylinder_length": 6.0, "overlap": 4.0}
    arcs = equilibrium(case(stations, centralisers=BOWS), operation, DEPTH)
    chords = equilibrium(case(stations, geometry="cylinders", pieces=pieces, centralisers=BOWS), operation, DEPTH)
    assert chords.status == arcs.status == "converged"
    assert chords.hookload == pytest.approx(arcs.hookload, rel=rel)
    assert chords.surface_torque == pytest.approx(arcs.surface_torque, rel=rel, abs=1e-6)
    assert chords.total_contact_force == pytest.approx(arcs.total_contact_force, rel=2 * rel, abs=1e-3)


@pytest.mark.parametrize("diameter", [0.2, 0.4])
def test_bows_turn_the_pipe_by_the_arms_of_the_wall_whatever_they_measure_free(diameter: float) -> None:
    """The preload drags all round at R; the spring's F = k e drags where the pipe leans, R − e from its axis."""
    bows = BOWS | {"diameter": diameter, "stiffness": 2e5}
    profile = equilibrium(case(centralisers=bows), "rotate_off_bottom", DEPTH).profile
    middle = np.flatnonzero(contacts(case(centralisers=bows)))[3:-3]
    force, pulls = profile["contact_force_N"].to_numpy()[1:][middle], diameter > BORE
    sag = force / 2e5 + (GAP if pulls else 0.5 * (BORE - diameter))
    per_bow = 0.3 * force * (0.5 * BORE - sag) + 800.0 * 0.5 * BORE * pulls
    assert (sag > 0.03 * BORE).all()
    torque = profile["torque_N_m"].to_numpy()
    lost = torque[middle] - torque[middle + 2]  # from the pipe above to the pipe below, which touch nowhere
    np.testing.assert_allclose(lost, per_bow, rtol=1e-3)


@pytest.mark.slow  # it compiles what nothing else here needs
def test_bows_that_the_hole_does_not_compress_have_no_starting_force() -> None:
    """In a vertical hole whose upper part is wider: those below 250 m alone drag, in both solvers."""
    upright = [[0, 0, 0], [400, 0, 0]]
    sizes = [{"to_md": 250, "diameter": 0.3, "friction": 0.0}, {"to_md": 400, "diameter": BORE, "friction": 0.0}]
    of = case(upright, friction=0.0, centralisers=BOWS)
    wide = of.model_copy(update={"wellbore": type(of.wellbore).model_validate(
        of.wellbore.model_dump(exclude_defaults=True) | {"intervals": sizes})})  # fmt: skip
    below = int((contacts(of) & (DEPTH - lay_out(of, DEPTH).contacts_above[1:] > 250.5)).sum())
    assert 0 < below < 10
    weight = equilibrium(case(upright, friction=0.0), "trip_out", DEPTH).hookload
    assert equilibrium(wide, "trip_out", DEPTH).hookload - weight == pytest.approx(below * 800.0, rel=1e-6)
    turning = Case.model_validate(
        wide.model_dump(exclude_defaults=True) | {"operations": [rotation(DEPTH, 6, rpm=60, ramp=2)]}
    )
    history = simulate(turning).history
    torque = history["surface_torque_N_m"][history["time_s"] > 4].mean()
    assert torque == pytest.approx(below * 800.0 * 0.5 * BORE, rel=0.05)


def test_bows_that_the_hole_does_not_compress_press_where_they_touch() -> None:
    wide = equilibrium(case(centralisers=BOWS | {"diameter": 0.2}), "rotate_off_bottom", DEPTH)
    assert wide.answered
    forces = wide.profile["contact_force_N"].to_numpy()[1:][contacts(case(centralisers=BOWS))]
    assert (forces > 0).all()


def test_no_torque_passes_a_swivel_and_what_hangs_below_does_not_turn() -> None:
    point = equilibrium(case(swivel=True), "rotate_off_bottom", DEPTH)
    whole = equilibrium(case(), "rotate_off_bottom", DEPTH)
    below = point.profile["md_m"].to_numpy() > DEPTH - LINER + 5
    assert np.abs(point.profile["torque_N_m"].to_numpy()[below]).max() < 1e-4 * point.surface_torque
    md = whole.profile["md_m"].to_numpy()
    dropped = whole.surface_torque - float(np.interp(DEPTH - LINER, md, whole.profile["torque_N_m"]))
    assert point.surface_torque == pytest.approx(dropped, rel=0.05)
    # Sliding, the whole string drags.
    assert equilibrium(case(swivel=True), "trip_out", DEPTH).hookload == pytest.approx(
        equilibrium(case(), "trip_out", DEPTH).hookload, rel=1e-6
    )


def test_what_hangs_below_a_swivel_has_no_friction_by_a_pair_of_factors_either() -> None:
    """It stands still, so the factor along the hole changes nothing; its points are pressed with up to 70 kN."""
    heavy = {"swivel": True, "inner_diameter": 0.05, "segment_length": 60.0}
    single = case(friction=0.2, **heavy)
    sizes = [{"to_md": 400, "diameter": BORE, "friction": 0.3, "rotational_friction": 0.2}]
    pair = Case.model_validate(single.model_dump(exclude_defaults=True) | {
        "wellbore": single.wellbore.model_dump(exclude_defaults=True) | {"intervals": sizes}})  # fmt: skip
    one, two = (equilibrium(of, "rotate_off_bottom", DEPTH) for of in (single, pair))
    assert one.profile["contact_force_N"].max() > 6e4
    assert two.answered
    assert two.surface_torque == pytest.approx(one.surface_torque, rel=1e-6)
    assert two.hookload == pytest.approx(one.hookload, rel=1e-9)


FITTED: dict[str, dict[str, Any]] = {
    "centralisers": {"centralisers": RIGID},
    "reducers": {"friction_reducers": RIGID | {"friction": 0.1}},
    "bows": {"centralisers": BOWS},
    "swivel": {"swivel": True},
}


@pytest.mark.slow
@pytest.mark.parametrize("name", FITTED)
@pytest.mark.parametrize("geometry", ["arcs", "cylinders"])
def test_the_stepper_agrees_with_the_steady_string(name: str, geometry: str) -> None:
    turning = rotation(DEPTH, 6, rpm=60, ramp=2)
    result = simulate(case(operations=[turning], geometry=geometry, **FITTED[name]))
    assert result.run["energy_error"] < 1e-3
    last = result.history[result.history["time_s"] > 4]
    point = equilibrium(case(geometry=geometry, **FITTED[name]), "rotate_off_bottom", DEPTH)
    assert last["hookload_N"].mean() == pytest.approx(point.hookload, rel=2e-3)
    assert last["surface_torque_N_m"].mean() == pytest.approx(point.surface_torque, rel=0.03)


def test_the_stepper_slides_against_bows_as_the_steady_string_does() -> None:
    """Down a vertical well, on pipe that is fed from a long segment."""
    upright = [[0, 0, 0], [400, 0, 0]]
    fed = case(upright, friction=0.0, operations=[trip(DEPTH, DEPTH + 2, 0.5, 1.0)], centralisers=BOWS)
    parts = (
        fed.string.components[0],
        fed.string.components[1].model_copy(update={"segments": 1, "segment_length": None}),
    )
    fed = fed.model_copy(update={"string": fed.string.model_copy(update={"components": parts})})
    result = simulate(fed)
    last = result.history[result.history["time_s"] > 2.5]
    point = equilibrium(fed, "trip_in", DEPTH + 1)
    assert last["hookload_N"].mean() == pytest.approx(point.hookload, rel=5e-3)
    weight = equilibrium(case(upright, friction=0.0), "trip_in", DEPTH + 1).hookload
    assert point.hookload - weight == pytest.approx(-8000.0, rel=0.01)


@pytest.mark.parametrize(
    ("liner", "words"),
    [
        ({"centralisers": RIGID, "friction_reducers": RIGID | {"friction": 0.1}}, "friction_reducers"),
        ({"centralisers": {"every": 12.0, "diameter": 0.17}}, "more than contact_diameter"),
        ({"friction_reducers": RIGID}, "their friction factor"),
        ({"centralisers": RIGID | {"length": 5.0}}, "at most a quarter of every"),
        ({"centralisers": RIGID | {"starting_force": 100.0}}, "a stiffness of bow springs"),
        ({"centralisers": RIGID, "segment_length": 3.0}, "segment_length"),
        ({"centralisers": RIGID, "length": 1.0}, '"sleeve" beside centralisers'),
    ],
)
def test_wrong_fittings_are_refused_in_one_sentence(liner: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        case(**liner)


def test_a_centraliser_wider_than_the_hole_is_refused_by_its_key() -> None:
    wide = case(centralisers=RIGID | {"diameter": 0.25})
    with pytest.raises(InputError, match=r"string\.components\[0\]\.centralisers\.diameter"):
        equilibrium(wide, "trip_in", DEPTH)


def test_bit_torque_below_a_swivel_and_bows_in_other_walls_are_refused() -> None:
    for sections, words in (
        ({"bit": {"torque": 1000.0}}, "which no torque passes"),
        ({"contact": {"law": "power", "exponent": 2.0, "reference_penetration": 1e-3}}, '"linear" beside bow springs'),
    ):
        given = case(swivel=True, centralisers=BOWS).model_dump(exclude_defaults=True)
        with pytest.raises(ValueError, match=words):
            Case.model_validate(given | sections)
    with pytest.raises(ValueError, match="against which it turns"):
        make_case(components=[pipe(None, 10, swivel=True)])


def test_the_waves_of_a_pushed_string_have_the_friction_of_its_fittings() -> None:
    """With the closed forms of a helix: a factor that is the hole's changes nothing, a smaller one does."""
    level = [[0, 88, 0], [400, 88, 0]]

    def push(**fittings: Any) -> float:
        of = case(level, centralisers={"every": EVERY, "diameter": 0.19, **fittings})
        bit, contact = {"weight_on_bit": 450e3}, {"helical_force": "analytic"}
        loaded = Case.model_validate(of.model_dump(exclude_defaults=True) | {"bit": bit, "contact": contact})
        point = equilibrium(loaded, "drill_sliding", DEPTH)
        assert point.buckling.mode != "none"
        return point.hookload

    same = push()
    assert push(friction=0.3) == pytest.approx(same, rel=1e-6)
    assert push(friction=0.05) > same + 1000


def test_no_torque_at_the_bit_is_looked_for_below_a_swivel() -> None:
    rows = limits_of(case(swivel=True), ["rotate_off_bottom"], [DEPTH])
    assert rows.loc[rows["margin"] == "torque", "reason"].tolist() == ["no torque passes the swivel above liner"]
