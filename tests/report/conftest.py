"""A well with something in every section of a report, its answers and its files, made once."""

from collections.abc import Callable
from functools import cache

import pytest

from fctd.case.load import Case, load_case
from fctd.report.answers import Answers, Asked, answer
from fctd.report.content import Cover, report_of
from fctd.report.html_file import to_html
from fctd.report.parts import Report
from fctd.report.xlsx_file import to_xlsx
from fctd.results.unit_systems import System

# Names as a user may write them: markup, formula, address, a character that the PDF's font lacks, a control character.
NAME = 'A & B <b>"well"</b> 水 \x1b[31m'
FORMULA, ADDRESS = "=1+1", "http://localhost"
KINDS = ("trip_out", "trip_in", "rotate_off_bottom")
DEPTHS = (600.0, 800.0, 1000.0)
WELL = {
    "name": NAME,
    "datum": {"air_gap": "25 m", "water_depth": "120 m"},
    "wellbore": {
        "stations": [[0, 0, 0], [300, 0, 0], [700, 50, 30], [1000, 50, 30]],
        "intervals": [
            {"name": FORMULA, "kind": "cased", "to_md": 500, "diameter": "8.681 in", "friction": 0.2},
            {"name": ADDRESS, "kind": "open", "to_md": 1000, "diameter": "8.5 in", "friction": 0.3},
        ],
        "window": [{"tvd": 600, "pore": "1.05 sg", "fracture": "1.6 sg"}],
    },
    "string": {
        "components": [
            {"name": FORMULA, "pipe": "6 3/4 x 2 13/16 NC50 collar", "length": 60, "segment_length": 10},
            {"name": "<i>pipe</i>", "pipe": "5 in 19.5 S-135 NC50", "segment_length": 12},
        ]
    },
    "mud": {"density": "1.2 sg", "fann": {600: 60, 300: 40, 6: 8, 3: 6}},
    "rig": {"block_weight": "100 kN", "hoist_capacity": "2 MN", "largest_torque": "20 kN*m", "slip_length": "400 mm"},
    "limits": {"design_factor": 1.2, "overpull_margin": "2 MN"},
    "bit": {"nozzles": ["14/32 in", "14/32 in"]},
    "operations": [{"kind": "rotate_off_bottom", "at_md": 1000, "duration": 20, "rpm": 60, "flow": "1800 L/min"}],
}


@pytest.fixture(scope="session")
def well() -> Case:
    return load_case(WELL)


@pytest.fixture(scope="session")
def answers(well: Case) -> Answers:
    return answer(well, Asked(KINDS, DEPTHS))


@pytest.fixture(scope="session")
def made(answers: Answers) -> Callable[[System], Report]:
    """The report in a system of units."""

    @cache
    def report(units: System) -> Report:
        return report_of(answers, Cover("C <& D>", "E F", "2026-11-28"), units, warnings=["a warning of 300 m"])

    return report


@pytest.fixture(scope="session")
def files(made: Callable[[System], Report]) -> Callable[[System, str], bytes]:
    """The content of a file of the report, by units and suffix."""
    from fctd.report.pdf_file import to_pdf

    writers = {".html": to_html, ".pdf": to_pdf, ".xlsx": to_xlsx}

    @cache
    def content(units: System, suffix: str) -> bytes:
        return writers[suffix](made(units))

    return content


# Both systems of units, of which one is tested where time is short.
UNITS = ["si", pytest.param("field", marks=pytest.mark.slow)]
