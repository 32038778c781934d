"""Pressures of pumped mud: against closed forms part by part, a published bit, and their sum."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.rheology import Rheology
from fctd.hydraulics.closed_forms import annulus
from fctd.hydraulics.cuttings import Cuttings
from fctd.hydraulics.pressures import circulation, hydraulics_of, lay
from tests.cases import make_case, pipe

G, PSI, INCH, GPM, PPG = 9.80665, 6894.757, 0.0254, 6.30902e-5, 119.8264
FLOW = 0.02
HOLES = [
    {"to_md": 333, "diameter": 0.3, "friction": 0.2},
    {"to_md": 1000, "diameter": 0.2159, "friction": 0.2},
]


def well(stations: list[list[float]] | None = None, **sections: Any) -> Case:
    """1000 m of pipe in two holes, with a mud of 1 Pa s that has no inertia to speak of."""
    given: dict[str, Any] = {
        "components": [pipe(100, 5, outer=0.17), pipe(None, 20)],
        "wellbore": {"intervals": HOLES},
        "mud": {"density": 1200.0, "viscosity": 1.0},
        "rig": {"surface_length": 50.0, "surface_bore": 0.1},
    }
    return make_case(stations, **(given | sections))


def test_each_part_loses_what_its_closed_form_says() -> None:
    """Poiseuille in the bores, the annulus exactly cut where the hole changes, at 333 m inside a segment."""
    one = circulation(well(), FLOW, 1000.0)
    rows = {(row["part"], row["name"], row["interval"], row["from_md_m"]): row for row in one.parts()}
    poiseuille = 8 * 1.0 * FLOW / np.pi
    assert one.surface == pytest.approx(poiseuille * 50 / 0.05**4)
    assert one.bores.sum() == pytest.approx(poiseuille * 1000 / 0.035**4)
    lost = []
    for outer, top, bottom, hole, interval in (
        (0.0635, 0, 333, 0.15, 1), (0.0635, 333, 900, 0.10795, 2), (0.085, 900, 1000, 0.10795, 2)
    ):  # fmt: skip
        exact = annulus(outer, hole, Rheology.newtonian(1.0), 1200.0, FLOW).gradient * (bottom - top)
        row = rows["annulus", "pipe", interval, top]
        assert (row["pressure_drop_Pa"], row["regime"]) == (pytest.approx(float(exact)), "laminar")
        lost.append(float(exact))
        assert row["ecd_kg_m3"] == pytest.approx(1200 + sum(lost) / (G * bottom))
    summary = one.summary()
    assert summary["annulus_drop_Pa"] == pytest.approx(sum(lost))
    assert summary["standpipe_Pa"] == pytest.approx(sum(row["pressure_drop_Pa"] for row in one.parts()))
    assert summary["ecd_shoe_kg_m3"] == pytest.approx(1200 + lost[0] / (G * 333))
    assert summary["pump_power_W"] == pytest.approx(summary["standpipe_Pa"] * FLOW)
    assert np.isnan(summary["jet_speed_m_s"])


def test_tool_joints_that_are_laid_out_narrow_annulus_and_bore_as_components_of_their_size_do() -> None:
    """Forty joints of 12 m, the tool joint of each below its body; coarse pipe has none."""
    joint = {"length": 12.0, "tool_joint_diameter": 0.168, "tool_joint_inner": 0.05, "tool_joint_length": 0.6}
    laid = pipe(None, None, joint=joint, joint_segments=2)
    written = [
        pipe(length, None, outer=outer, inner=inner, segment_length=length, contact="sleeve")
        for _ in range(40)
        for length, outer, inner in ((0.6, 0.168, 0.05), (11.4, 0.127, 0.07))
    ]
    fine, coarse, same = (
        circulation(well(components=of), FLOW, 480.0)
        for of in ([laid], [pipe(None, None, joint=joint, segment_length=6.0)], written)
    )
    assert fine.summary()["annulus_drop_Pa"] == pytest.approx(same.summary()["annulus_drop_Pa"], rel=1e-9)
    assert fine.bores.sum() == pytest.approx(same.bores.sum(), rel=1e-9)
    assert fine.standpipe == pytest.approx(same.standpipe, rel=1e-9)
    assert fine.standpipe > 1.02 * coarse.standpipe


def test_a_published_bit() -> None:
    """Three nozzles of 12/32 in at 400 gpm of 12 ppg: 156.5 Q² W/(ΣN²)², 1610 psi; jets of Q/A, force ρ Q v."""
    bit = {"nozzles": [12 / 32 * INCH] * 3}
    row = circulation(well(mud={"density": 12 * PPG, "viscosity": 0.02}, bit=bit), 400 * GPM, 1000.0).summary()
    assert row["bit_drop_Pa"] / PSI == pytest.approx(1610, abs=1)
    jets = 400 * GPM / (3 * np.pi / 4 * (12 / 32 * INCH) ** 2)
    assert row["jet_speed_m_s"] == pytest.approx(jets)
    assert row["impact_force_N"] == pytest.approx(12 * PPG * 400 * GPM * jets)
    assert row["bit_power_W"] == pytest.approx(row["bit_drop_Pa"] * 400 * GPM)


def test_tools_and_unlike_muds_count_in_the_standpipe() -> None:
    """A tool's drop grows with density and the square of the flow; a denser mud inside helps the pumps."""
    tool = pipe(10, 1, outer=0.17, pressure_drop=1e6, at_flow=0.04, at_density=1000.0)
    plain = circulation(well(), FLOW, 1000.0)
    fitted = circulation(well(components=[tool, pipe(None, 20)]), FLOW, 1000.0)
    assert fitted.summary()["tool_drop_Pa"] == pytest.approx(1e6 * 1.2 / 4)
    heavier = well(mud={"density": 1200.0, "viscosity": 1.0, "inside": [{"density": 1300.0}], "float": True})
    assert circulation(heavier, FLOW, 1000.0).standpipe - plain.standpipe == pytest.approx(-100 * G * 1000, rel=1e-6)


def test_cuttings_weigh_in_the_annulus_where_the_hole_is_not_steep() -> None:
    """Their share of the annulus times the difference of densities, all of it down to 333 m."""
    plain, drilling = (circulation(well(), FLOW, 1000.0, cuttings=of) for of in (None, Cuttings(0.01, density=2600.0)))
    rise = drilling.summary()["ecd_shoe_kg_m3"] - plain.summary()["ecd_shoe_kg_m3"]
    cut = np.pi / 4 * 0.2159**2 * 0.01
    assert rise == pytest.approx(1400 * cut / (cut + FLOW) / drilling.ratios[0])
    steep = [[0, 60, 0], [1000, 60, 0]]
    laid, with_cuttings = (circulation(well(steep), FLOW, 1000.0, cuttings=of) for of in (None, Cuttings(0.01)))
    assert with_cuttings.summary()["ecd_bit_kg_m3"] == laid.summary()["ecd_bit_kg_m3"]


def test_depths_and_flows_make_rows_and_what_does_not_fit_says_why() -> None:
    table = hydraulics_of(well(), ["1200 L/min", 0.03], [500.0, "1000 m", 1200.0])
    assert table["flow_m3_s"].tolist() == pytest.approx([0.02] * 3 + [0.03] * 3)
    assert table["reason"].str.startswith("not_possible").tolist() == [False, False, True] * 2
    assert table["standpipe_Pa"].notna().tolist() == [True, True, False] * 2
    beside = hydraulics_of(well(), FLOW, eccentricity=0.8)
    assert beside["annulus_drop_Pa"][0] < 0.6 * table["annulus_drop_Pa"][1]


@pytest.mark.parametrize(
    ("case", "flow", "eccentricity", "told"),
    [
        ({}, 2000, 0.0, r"flow = 2000: expected .* at most 1 m\^3/s \(2000 looks like '2000 gpm' or '2000 L/min'\)"),
        ({}, "12 m", 0.0, "flow = \"12 m\": expected a flow rate"),
        ({}, FLOW, 2.0, "eccentricity = 2.0: expected a share at least 0 and at most 1"),
        ({"mud": {"density": 1200.0}}, FLOW, 0.0, "mud.fann is missing: expected readings of a viscometer"),
        ({"mud": {"density": 1200.0, "viscosity": 0}}, FLOW, 0.0, "mud.viscosity = 0.0: expected above 0, or mud.fann"),
        ({"bit": {"end": "closed"}}, FLOW, 0.0, "bit.end = \"closed\": expected \"open\" or \"float\" with a flow"),
        ({"mud": {"density": 1200.0, "viscosity": 0.03, "packer_bore": 0.1}}, FLOW, 0.0, "past the packer"),
        ({"components": [pipe(None, 20, inner=0.0)]}, FLOW, 0.0, "inner_diameter = 0.0: expected a bore above 0"),
    ],
)  # fmt: skip
def test_what_cannot_be_pumped_is_told_in_a_sentence(
    case: dict[str, Any], flow: float | str, eccentricity: float, told: str
) -> None:
    with pytest.raises(InputError, match=told) as caught:
        hydraulics_of(well(**case), flow, eccentricity=eccentricity)
    assert "\n" not in str(caught.value)


@given(st.floats(50.0, 1000.0))
def test_a_laid_string_keeps_its_length_and_finds_the_shoe(bit_depth: float) -> None:
    laid = lay(well(), bit_depth)
    assert laid.string.length.sum() == pytest.approx(bit_depth)
    assert (laid.shoe is None) == (bit_depth < 333.0 - 1e-6)
    if laid.shoe is not None:
        assert laid.ends[laid.shoe] == pytest.approx(333.0, abs=1e-6)


HEAVIER = {"density": 1200.0, "viscosity": 1.0, "inside": [{"density": 1500.0}], "float": True}


def free_fall() -> float:
    """Flow at which 300 kg/m³ × g × 1000 m drive Newtonian mud down the bore and up both annuli (exact) [m³/s]."""
    lost = 8 / np.pi * 1000 / 0.035**4
    for outer, hole, length in ((0.0635, 0.15, 333.0), (0.0635, 0.10795, 567.0), (0.085, 0.10795, 100.0)):
        ring = hole**4 - outer**4 - (hole**2 - outer**2) ** 2 / np.log(hole / outer)
        lost += 8 / np.pi * length / ring
    return float(300 * G * 1000 / lost)


def test_a_column_that_falls_freely_is_refused_with_its_rate() -> None:
    """Pumps below the rate of free fall would need a pressure below 0; above it they have one above 0."""
    rate, case = free_fall(), well(mud=HEAVIER)
    with pytest.raises(InputError, match=r"flow = 60 L/min: expected more than (\d+) L/min, at which the") as caught:
        hydraulics_of(case, 1e-3)
    assert float(str(caught.value).split("more than ")[1].split()[0]) == pytest.approx(6e4 * rate, rel=0.01)
    table = hydraulics_of(case, [0.98 * rate, 1.02 * rate])
    assert table["reason"].str.startswith("not_possible: ").tolist() == [True, False]
    of = circulation(case, 1.02 * rate, 1000.0)
    assert 0 < of.standpipe - of.surface < 0.05 * 300 * G * 1000
    # A plug holds the column, and so does a lighter fluid above it.
    plugged = HEAVIER | {"inside": [{"to_md": 1000.0, "density": 1500.0, "plug": True}]}
    with pytest.raises(InputError, match=r"mud\.inside\.plug"):
        hydraulics_of(well(mud=plugged), 1e-3)
    mixed = HEAVIER | {"inside": [{"to_md": 600.0, "density": 900.0}, {"density": 1500.0}]}
    assert hydraulics_of(well(mud=mixed), 1e-3)["standpipe_Pa"][0] > 0
