"""The operations that a new case proposes run as they stand, and a case without any is given some that do."""

import re
import tomllib

import pytest

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.systems import System
from fctd.model.first_runs import to_paste
from fctd.model.new_case import from_template
from fctd.model.templates import TEMPLATES, TemplateName
from fctd.simulation.simulate import simulate
from tests.cases import make_case, pipe

DRILLING = [name for name, template in TEMPLATES.items() if template.weight_on_bit]


def proposed(name: TemplateName, units: System) -> dict[str, Case]:
    """The cases that follow from putting each block of comments in place of the operation above."""
    text = from_template(TEMPLATES[name], name, units).text()
    head, _, *blocks = re.split(r"(?m)^(?=\[\[operations\]\]|# A first )", text)
    cases = {}
    for block in blocks:
        heading, *lines = block.strip().splitlines()
        lines = [line.removeprefix("# ") for line in lines]
        cases[heading] = Case.model_validate(tomllib.loads("\n".join([head, *lines])))
    return cases


@pytest.mark.parametrize("units", ["si", "field"])
@pytest.mark.parametrize("name", DRILLING)
def test_a_first_trip_and_a_first_drilling_run_are_cases(name: TemplateName, units: System) -> None:
    trip, drill = proposed(name, units).values()
    assert [operation.kind for operation in (*trip.operations, *drill.operations)] == [
        "trip_out", "trip_in", "drill_rotating",
    ]  # fmt: skip
    for case in (trip, drill):
        case.check_depths()
        assert case.warnings == ()


@pytest.mark.slow
def test_they_run_without_a_note() -> None:
    for case in proposed("build-hold", "field").values():
        result = simulate(case)
        assert (result.status, result.notes) == ("completed", ())


def test_a_case_without_operations_is_given_one_that_runs() -> None:
    """The message has the lines to paste, with the depth as the case has it."""
    case = make_case(wellbore={"intervals": [{"to_md": "1000 m", "diameter": 0.2159, "friction": 0.2}]})
    with pytest.raises(InputError) as refused:
        simulate(case)
    message, *lines = str(refused.value).splitlines()
    assert "operations = []: expected at least one operation to simulate" in message
    assert tuple(lines) == to_paste("1000 m")
    operations = tomllib.loads("\n".join(lines))["operations"]
    assert make_case(operations=operations).operations[0].at_md == 1000.0


def test_the_depth_to_paste_has_its_unit_where_the_string_ends_above_the_hole() -> None:
    assert make_case().end_as_written == "1000 m"
    assert make_case(components=[pipe(400.0, 10)]).end_as_written == "400 m"
