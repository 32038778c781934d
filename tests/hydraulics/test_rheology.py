"""The flow curves of a case's muds along its string."""

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.hydraulics.rheology import along, check_flows
from fctd.model.fluids import fluids_of
from tests.cases import make_case

SPACER = {"rheology": {"consistency": 0.4, "index": 0.6}}


def test_rows_have_their_own_curves_and_the_others_that_of_the_mud() -> None:
    rows = [{"to_md": 300, "density": 1000, **SPACER}, {"density": 1200}]
    case = make_case(mud={"density": 1200.0, "viscosity": 0.03, "inside": rows})
    fluids = fluids_of(case, 1000.0)
    assert fluids is not None
    above = np.array([900.0, 750.0, 100.0])
    inside = along(case.mud, case.mud.inside, fluids.inside, above)
    assert inside.consistency == pytest.approx([0.4, 0.4, 0.03])
    assert inside.index == pytest.approx([0.6, 0.6, 1.0])
    assert along(case.mud, (), fluids.outside, above).consistency == pytest.approx([0.03] * 3)


def test_a_mud_of_whose_flow_nothing_is_said_is_refused() -> None:
    rows = [{"density": 1000, **SPACER}]
    with pytest.raises(InputError, match="fann is missing: expected readings of a viscometer"):
        check_flows(make_case(mud={"density": 1200.0}).mud)
    with pytest.raises(InputError, match="fann is missing"):
        check_flows(make_case(mud={"density": 1200.0, "inside": rows}).mud)
    check_flows(make_case(mud={"density": 1200.0, "inside": rows, "outside": rows}).mud)
    check_flows(make_case(mud={"density": 1200.0, "inside": [{"density": 0}], "viscosity": 0.02, "float": True}).mud)
