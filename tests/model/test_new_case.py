"""A new case's text: it runs as it stands, in both unit systems, with little penetration and segments fine enough."""

import tomllib
from functools import cache

import numpy as np
import pytest

from fctd import Case
from fctd.case.operations import RotateOffBottom
from fctd.case.string import ComponentSpec
from fctd.case.systems import DENSITY, FORCE, LENGTH, System
from fctd.model import layouts
from fctd.model.drillstring import lay_out
from fctd.model.first_runs import entry
from fctd.model.new_case import (
    Plan,
    Quantities,
    from_survey,
    from_template,
)
from fctd.model.operations import rates_of_all
from fctd.model.section import section_of
from fctd.model.templates import TEMPLATES, TemplateName
from fctd.model.torsion import period_of
from fctd.results.status import SteadyStatus
from fctd.steady.equilibrium import Solver
from fctd.steady.levels import relative_difference

EACH = pytest.mark.parametrize("name", TEMPLATES)
BOTH = pytest.mark.parametrize("units", ["si", "field"])


@cache
def plan_of(name: TemplateName, units: System) -> Plan:
    return from_template(TEMPLATES[name], "new", units)


@cache
def case_of(name: TemplateName, units: System = "si") -> Case:
    return Case.model_validate(tomllib.loads(plan_of(name, units).text()))


def kinds_of(case: Case) -> list[str]:
    return ["trip_in", "trip_out", "rotate_off_bottom"] + ["drill_sliding"] * (case.bit.weight_on_bit > 0)


@EACH
@BOTH
def test_the_text_is_the_template(name: TemplateName, units: System) -> None:
    case, template = case_of(name, units), TEMPLATES[name]
    scale = 1.0 if units == "si" else 3 * 0.3048
    assert case.wellbore.geometry == "arcs"
    assert case.depths == (0.0, pytest.approx(scale * template.stations[-1][0], abs=0.01))
    assert np.degrees(case.wellbore.trajectory[:, 1]) == pytest.approx([inc for _, inc, _ in template.stations])
    assert [i.kind for i in case.wellbore.intervals] == ["cased", "open"]
    for component, part in zip(case.string.components, template.string, strict=True):
        named = ComponentSpec.model_validate({"name": part.name, **part.keys})
        kept = {"outer_diameter", "inner_diameter", "contact_diameter", "joint", "yield_strength"}
        assert component.model_dump(include=kept) == named.model_dump(include=kept)
        assert section_of(component, 0.0).mass == pytest.approx(section_of(named, 0.0).mass, rel=1e-3)
    assert case.mud.density == pytest.approx(template.mud, rel=5e-3)  # two or three digits are written
    assert case.rig.block_weight == pytest.approx(1e3 * template.block_weight, rel=1e-2)
    assert case.bit.weight_on_bit == pytest.approx(1e3 * template.weight_on_bit, rel=4e-2)
    case.check_depths()


@EACH
def test_every_comment_starts_in_one_column(name: TemplateName) -> None:
    lines = plan_of(name, "si").text().splitlines()
    assert {line.index(" #") + 1 for line in lines if " #" in line and not line.startswith("#")} <= {38}
    assert max(map(len, lines)) <= 110


@EACH
@pytest.mark.parametrize("share", [0.6, 1.0])
def test_no_contact_is_deeper_in_the_wall_than_a_hundredth_of_the_clearance(name: TemplateName, share: float) -> None:
    case = case_of(name)
    solver, kinds = Solver(case), kinds_of(case)
    rates = rates_of_all(case, kinds)
    for kind in kinds:
        point = solver.solve(kind, rates[kind], share * case.depths[1])
        assert point.status is SteadyStatus.CONVERGED, kind
        assert point.notes == ()
        walls, radius = point._shape.walls, point._shape.radius
        clearance = walls.radius - radius
        penetration = np.linalg.norm(walls.offset, axis=1) - clearance
        deep = penetration / clearance
        assert 0 < deep[:-1].max() < 0.01
        assert deep[-1] < 0.05  # the end of the string bears the side force of the whole assembly at one point


@EACH
def test_the_segments_are_fine_enough(name: TemplateName) -> None:
    """Hook load and torque against segments of 5 m, which are within 0.05 % of segments of 2.5 m."""
    case = case_of(name)
    fine = layouts.with_components(case, layouts.uniform(case, case.depths[1], 5.0))
    kinds = kinds_of(case)[:3]
    rates = rates_of_all(case, kinds)
    for kind in kinds:
        point, exact = (Solver(c).solve(kind, rates[kind], c.depths[1]) for c in (case, fine))
        hookload, torque = relative_difference(point, exact, rates[kind].spin)
        assert hookload < 0.002, kind
        assert torque < 0.01, kind


def test_a_softer_wall_would_be_penetrated_further() -> None:
    case = case_of("build-hold")
    soft = case.model_copy(update={"wellbore": case.wellbore.model_copy(update={"stiffness_per_length": 2e6})})
    point = Solver(soft).solve("trip_out", rates_of_all(soft, ["trip_out"])["trip_out"], soft.depths[1])
    clearance = point._shape.walls.radius - point._shape.radius
    assert ((np.linalg.norm(point._shape.walls.offset, axis=1) - clearance) / clearance).max() > 0.01


@BOTH
def test_a_depth_is_never_below_the_end_of_the_survey(units: System) -> None:
    end = 1234.5678
    stations = np.array([[0.0, 0.0, 0.0], [600.0, 0.5, 0.0], [end, 0.5, 0.0]])
    plan = from_survey("build-hold", "of a survey", units, "s.csv", (), stations)
    case = tomllib.loads(plan.text())
    assert case["wellbore"]["survey"] == "s.csv"
    to_md = Quantities(units)(LENGTH, end)
    assert case["wellbore"]["intervals"][1]["to_md"] == to_md
    number, unit = to_md.split()
    assert end - 0.01 < float(number) * (1.0 if unit == "m" else 0.3048) <= end


@BOTH
def test_lengths_of_a_template_are_round_in_the_hole_of_a_survey(units: System) -> None:
    """A metre of the template is written as 3 ft."""
    stations = np.array([[0.0, 0.0, 0.0], [1500.0, 0.0, 0.0], [3000.0, 0.7, 0.0]])
    plan = from_survey("build-hold", "of a survey", units, "s.csv", (), stations)
    lengths = [part.get("length") for part in tomllib.loads(plan.text())["string"]["components"]]
    assert lengths == (["120 m", "150 m", None] if units == "si" else ["360 ft", "450 ft", None])


@pytest.mark.parametrize("depth", [5.0, 36.6])
def test_the_case_of_a_hole_of_few_metres_records_its_short_period(depth: float) -> None:
    stations = np.array([[0.0, 0.0, 0.0], [depth, 0.35, 0.0]])
    raw = tomllib.loads(from_survey("build-hold", "short", "si", "s.csv", (), stations).text())
    raw["wellbore"] |= {"survey": None, "stations": [[0.0, 0.0, 0.0], [depth, 20.0, 0.0]]}
    case = Case.model_validate(raw)
    period = period_of(lay_out(case, case.depths[1], case.depths[1]))
    digit = 10.0 ** np.floor(np.log10(period))
    assert case.record.interval == pytest.approx(period, abs=0.5 * digit + 0.02 * period)  # a chain of few segments


@pytest.mark.parametrize(
    ("length", "metric", "field"),
    [(100.0, "100", "500"), (101.0, "200", "500"), (30.48, "50", "100"), (0.3, "0.5", "1")],
)
def test_a_round_length_is_at_least_the_given_one(length: float, metric: str, field: str) -> None:
    assert Quantities("si").round_length(length) == metric
    assert Quantities("field").round_length(length) == field


def test_quantities_are_rounded_as_a_person_would() -> None:
    assert Quantities("field")(FORCE, 250e3) == "56 klbf"
    assert Quantities("field")(DENSITY, 1250.0) == "10.4 ppg"
    assert Quantities("si")(LENGTH, 1500.0) == "1500 m"


def test_casing_floats_with_the_lines_that_its_case_has_for_it() -> None:
    """Air below the collar: the hook bears less, and so does the wall."""
    text = plan_of("casing-run", "si").text()
    head, rest = text.split("[mud]\n", 1)
    block = rest[rest.index("# [mud]") : rest.index("[rig]")]
    floated = head + "\n".join(line.removeprefix("# ") for line in block.splitlines()) + "\n" + rest.split("\n\n", 2)[2]
    points = []
    for case in (case_of("casing-run"), Case.model_validate(tomllib.loads(floated))):
        rates = rates_of_all(case, ["trip_in"])["trip_in"]
        points.append(Solver(case).solve("trip_in", rates, case.depths[1]))
    full, empty = points
    assert empty.status is SteadyStatus.CONVERGED
    assert empty.notes == ()
    # The casing weighs 69.9 kg/m, the mud in its bore 47.7 below the collar, where the hole leans by up to 45°.
    assert empty.total_contact_force < 0.5 * full.total_contact_force
    assert empty.hookload < 0.8 * full.hookload


def test_texts_are_quoted() -> None:
    assert tomllib.loads(entry("name", 'a "b" \\ ü', "c")) == {"name": 'a "b" \\ ü'}


@pytest.mark.parametrize("name", [name for name in TEMPLATES if TEMPLATES[name].weight_on_bit])
def test_a_rotation_is_recorded_over_its_torsional_period(name: TemplateName) -> None:
    """Each record is a mean over the swing of the torque: the period of the laid-out string, rounded to 0.1 s."""
    case = case_of(name)
    (operation,) = case.operations
    assert isinstance(operation, RotateOffBottom)
    assert case.record.interval == pytest.approx(period_of(lay_out(case, case.depths[1])), abs=0.06)
    assert operation.duration == pytest.approx(6 * case.record.interval)
