"""Sections on what a case says: datum, string with capacities, origin of the friction, assumptions."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from fctd.calibration.predict import Posterior, posterior_file
from fctd.calibration.setup import Setup
from fctd.calibration.unknowns import Unknown
from fctd.case.errors import InputError
from fctd.case.friction import FrictionSet
from fctd.case.load import Case, load_case
from fctd.case.pipes.catalogue import pipe_named
from fctd.model.capacity import body_of
from fctd.model.connection import make_up_torque
from fctd.model.operations import rates_of_all
from fctd.model.summary import summarise
from fctd.report.parts import Report, Text
from fctd.report.well import _datum, assumptions, fluids, friction, hole, string
from fctd.results.shown_tables import Cell, Table
from fctd.results.unit_systems import System
from tests.report.conftest import WELL


def texts(table: object) -> list[list[str]]:
    assert isinstance(table, Table)
    return [[cell.text for cell in row] for row in table.rows]


def test_the_datum_at_sea_on_land_and_unknown(made: Callable[[System], Report]) -> None:
    assert texts(made("field").sections[0].parts[1])[2] == ["sea bed", "475.7", "ft below the rotary table"]
    land = load_case(WELL, {"datum": {"elevation": "1200 ft"}})
    assert texts(_datum(land, "field")) == [["rotary table", "1200.0", "ft above mean sea level"]]
    unknown = _datum(load_case(WELL, {"datum": None}), "si")
    assert isinstance(unknown, Text)
    assert "does not give its elevation" in unknown.text


def test_casing_of_the_catalogue_is_named() -> None:
    case = load_case(WELL, {"wellbore.intervals[0].casing": "9 5/8 in 47 L-80", "wellbore.intervals[0].diameter": None})
    told = [row[-3:] for row in texts(hole(case, "field").parts[0])]
    assert told == [["8.681", "0.2", "9 5/8 in 47 L-80"], ["8.5", "0.3", "–"]]


def test_capacities_are_those_of_the_catalogue(made: Callable[[System], Report]) -> None:
    """The topmost component is pipe of the catalogue; in kN, kN·m and bar."""
    _, capacities, *_ = made("si").sections[2].parts
    assert isinstance(capacities, Table)
    pipe = pipe_named("5 in 19.5 S-135 NC50")
    body, make_up = body_of(pipe), make_up_torque(pipe)
    assert body is not None
    assert make_up is not None
    tension, torsion, *others = (cell.number for cell in capacities.rows[0][3:])
    assert [tension, torsion] == pytest.approx([body.tension / 1e3, body.torsion / 1e3])
    assert others == pytest.approx([make_up / 1e3, body.burst / 1e5, body.collapse / 1e5])


def test_a_component_without_known_connection_has_no_make_up_torque(well_of_plain_pipe: Case) -> None:
    _, capacities, *_ = string(summarise(well_of_plain_pipe), "si").parts
    assert texts(capacities)[0][5] == "–"


@pytest.fixture
def well_of_plain_pipe() -> Case:
    plain = {"name": "plain", "outer_diameter": "5 in", "inner_diameter": "4.276 in"}
    return load_case(WELL, {"string.components": [plain]})


def test_factors_of_the_file_and_of_the_option(well: Case) -> None:
    assert "assumed" in str(friction(well, ()).parts[1])
    told = str(friction(well, [FrictionSet(every=0.2), FrictionSet(cased=0.2, open=0.3)]).parts[1])
    assert "option --friction, in place of those of the case: 0.2; cased 0.20, open 0.30, of which the first" in told


def test_calibrated_factors_come_with_their_uncertainty(tmp_path: Path) -> None:
    """And beside them what the case has now, where someone has changed it."""
    path = tmp_path / "w.toml"
    path.write_text(
        'name = "w"\n[wellbore]\nstations = [[0, 0, 0], [900, 0, 0]]\n[[wellbore.intervals]]\nto_md = 900\n'
        'kind = "open"\ndiameter = 0.2\nfriction = 0.25\n[[string.components]]\nname = "p"\nouter_diameter = 0.127\n'
        "inner_diameter = 0.1\n"
    )
    unknown = Unknown("friction.open", 0.0, 0.8, 0.3, 0.1, None, "")
    Posterior((unknown,), np.array([0.3]), np.array([[0.02**2]]), Setup(), {}).write(posterior_file(path))
    _, origin, table = friction(load_case(path), ()).parts
    assert origin == Text("Calibrated by fctd calibrate: w.fit.json.")
    assert texts(table) == [["friction.open", "0.3", "0.02", "0.25", ""]]
    posterior_file(path).write_text("{")
    with pytest.raises(InputError, match=r"w\.fit\.json"):
        friction(load_case(path), ())


def test_assumptions_say_where_they_are_from(well: Case) -> None:
    rates = rates_of_all(well, ["trip_out", "rotate_off_bottom"])
    _, model, table, warnings = assumptions(well, rates, {"speed": None}, "9 segments", ["at 984 ft"], "field").parts
    assert ["friction law", "coulomb", "default"] in texts(model)
    assert ["segments", "9 segments", "case"] in texts(model)
    stiffness = well.wellbore.stiffness or 0.0
    # A newton a metre is 0.3048/4.4482216152605 pounds-force a foot (NIST SP 811).
    pounds = f"{stiffness * 0.3048 / 4.4482216152605:.0f} lbf/ft at a contact"
    assert ["stiffness of the wall", pounds, "default"] in texts(model)
    assert texts(table) == [
        ["picking up", "59.1", "0.0", "0", "0.0", "default"],
        ["rotating off bottom", "0.0", "60.0", "476", "0.0", "case"],
    ]
    assert isinstance(table, Table)
    (note,) = table.notes
    assert note.endswith("pumps stand in picking up; 475.5 gpm in rotating off bottom")
    assert texts(warnings) == [["at 984 ft"]]
    (*_, none) = assumptions(well, rates, {"speed": 0.1}, "", (), "si").parts
    assert none == Text("No warnings.")


def test_fluids_by_depth_and_temperature() -> None:
    changes = {
        "mud.inside": [{"to_md": 400, "density": "1.2 sg", "plug": True}, {"density": 0}], "mud.fann": None,
        "mud.float": True, "operations": None, "temperature": [{"tvd": 0, "change": 0}, {"tvd": 800, "change": "18 K"}],
    }  # fmt: skip
    _, rows, warmer = fluids(load_case(WELL, changes), "field").parts
    assert texts(rows) == [["inside", "1312.3", "10.01", "yes"], ["inside", "–", "0.00", "–"]]
    assert texts(warmer)[1] == ["2624.7", "32.4"]
    assert isinstance(rows, Table)
    assert rows.rows[0][1] == Cell("1312.3", pytest.approx(1312.335958))
