"""What the mud of a case flows through: its channel by the components, the fluids by depth, tools and nozzles."""

import numpy as np
import pytest

from fctd import build_wellbore
from fctd.case.errors import InputError
from fctd.hydraulics.channel import Channel, channel_of, flow_curves, has_flow_curve
from fctd.hydraulics.pressures import check_flows
from fctd.model.drillstring import lay_out
from tests.cases import make_case, pipe

THICK, THIN = {"viscosity": 0.1}, {"viscosity": 0.01}


def channel(top_md: float = 0.0, **mud: object) -> Channel:
    tool = pipe(10, 2, outer=0.17, inner=0.06, pressure_drop=2e6, at_flow=0.03)
    case = make_case(
        [[0, 0, 0], [1000, 0, 0]], [tool, pipe(None, None, inner=0.1, segment_length=90.0)],
        mud={"density": 1200.0, "viscosity": 0.03} | mud, bit={"flow_area": 3e-4, "discharge": 0.9},
    )  # fmt: skip
    return channel_of(case, lay_out(case, 900.0), build_wellbore(case))


def test_a_channel_has_the_radii_and_the_mud_of_its_segments() -> None:
    found = channel()
    assert found.annulus[0].tolist() == [0.0635, pytest.approx(0.10795), 0.0, 0.0, 0.03, 1.0, 1200.0]
    assert found.bore[-1].tolist() == [0.03, 0.0, 0.03, 1.0, 1200.0]
    assert found.wet.sum() == pytest.approx(900.0)
    assert found.nozzles == (3e-4, pytest.approx(0.9**-2))
    assert found.end == "open"


def test_a_tool_has_its_pressure_drop_at_its_flow_spread_along_it() -> None:
    """At the flow and 1000 kg/m³ of its sheet; in denser mud more."""
    found = channel()
    assert found.tools.sum() * 0.03**2 == pytest.approx(2e6 * 1.2)
    assert (found.tools[:-2] == 0).all()
    assert found.tools[-1] == pytest.approx(found.tools[-2])
    assert (found.inside(0.03) - found.inside(0.0)).sum() > 2.4e6


def test_each_depth_has_the_flow_curve_of_its_fluid() -> None:
    """A row without a curve has that of the mud."""
    outside = [
        {"to_md": 500.0, "density": 1200.0} | THICK,
        {"to_md": 700.0, "density": 1200.0},
        {"density": 1200.0} | THIN,
    ]
    case = make_case(
        [[0, 0, 0], [1000, 0, 0]], [pipe(None, None, segment_length=100.0)],
        mud={"density": 1200.0, "viscosity": 0.03, "outside": outside},
    )  # fmt: skip
    inside, around = flow_curves(case, lay_out(case, 1000.0))
    assert np.unique(inside.consistency) == [0.03]
    assert list(around.consistency) == [0.1] * 5 + [0.03] * 2 + [0.01] * 3
    assert has_flow_curve(case)


def test_fluids_with_curves_of_their_own_need_none_of_the_mud() -> None:
    """A row without one is refused where the mud has none either."""
    thick, bare = [{"density": 1200.0} | THICK], [{"density": 1200.0}]
    check_flows(make_case(mud={"density": 1200.0, "inside": thick, "outside": thick}))
    with pytest.raises(InputError, match=r"mud\.fann"):
        check_flows(make_case(mud={"density": 1200.0, "inside": bare, "outside": thick}))


def test_a_plug_closes_the_bore() -> None:
    inside = [{"to_md": 500.0, "density": 1200.0, "plug": True}, {"density": 1200.0}]
    found = channel(inside=inside, float=True)
    assert found.end == "plugged"
    with pytest.raises(InputError, match=r"mud\.inside\.plug = true: expected false with a flow"):
        found.out_of_bit(0.02, 0.0, found.end)
    assert channel(float=True).end == "float"


def test_a_swab_opens_a_float_where_it_overcomes_what_it_holds() -> None:
    """With air in the upper string the mud outside is heavier: a slow swab lets nothing out of the bore."""
    light = channel(inside=[{"to_md": 200.0, "density": 0.0}, {"density": 1200.0}], float=True)
    assert light.heavier == pytest.approx(1200 * 9.80665 * 200, rel=1e-6)
    assert light.out_of_bit(0.0, -0.3, "float") == 0.0
    alike = channel(float=True)
    assert alike.held("float") == 0.0
    out = alike.out_of_bit(0.0, -0.3, "float")
    assert out == alike.out_of_bit(0.0, -0.3, "open") > 0
    swab = -float(alike.outside(0.0, -5.0).gradient @ alike.wet)
    assert swab > light.heavier
    assert 0 < light.out_of_bit(0.0, -5.0, "float") < alike.out_of_bit(0.0, -5.0, "float")


def test_mud_passes_between_the_blades_of_a_bit_as_wide_as_its_hole() -> None:
    """Without friction or drag; pipe that fills its hole has a large and finite one."""
    parts = [pipe(0.3, 1, outer=0.3, contact="point"), pipe(None, None, segment_length=50.0)]
    wall = {"intervals": [{"to_md": 500, "diameter": 0.3, "friction": 0.2}]}
    case = make_case([[0, 0, 0], [500, 0, 0]], parts, wellbore=wall, mud={"density": 1200.0, "viscosity": 0.03})
    of = channel_of(case, lay_out(case, 400.0), build_wellbore(case))
    assert of.wet[-1] == 0
    assert of.wet.sum() == pytest.approx(399.7)
    full = make_case([[0, 0, 0], [500, 0, 0]], [pipe(None, None, outer=0.3, segment_length=50.0)], wellbore=wall,
                     mud={"density": 1200.0, "viscosity": 0.03})  # fmt: skip
    tight = channel_of(full, lay_out(full, 400.0), build_wellbore(full))
    assert 1e6 < float(tight.outside(0.03, 0.0).gradient @ tight.wet) < 1e10
