"""Both laws of friction with two factors on the row of well F-4 that turns on its way: which one its spread is nearer.

Row F4-13r was measured as F4-13 is, with 20 rev/min; its speed is not recorded.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from fctd.calibration.predict import read_posterior
from fctd.calibration.rows import Row
from fctd.calibration.unknowns import with_values
from fctd.case.load import Case
from fctd.model.operations import rad_per_s
from references.soft_string.directions import LAWS, Direction
from references.soft_string.integration import soft_string
from validation.harness.study import Rows, table_of_rows
from validation.parts.judged_well import SOFT
from validation.parts.volve_f4_days import frozen_file
from validation.parts.volve_f4_rows import report_rows

ROW: Final = "F4-13r"
SPEEDS: Final = (0.04, 0.06, 0.08, 0.1)  # [m/s]


@table_of_rows
def spreads(data: Path, strings: Mapping[str, Case]) -> Rows:
    """Pick-up minus slack-off [kN] of the row by each law and speed, beside the recorded one; soft string, split B."""
    posterior = read_posterior(frozen_file("B", SOFT))
    values = {one.name: float(v) for one, v in zip(posterior.unknowns, posterior.best, strict=True)}
    friction = {name: value for name, value in values.items() if name.startswith("friction.")}
    up, down = report_rows(data, strings, (ROW,))
    assert up.hookload is not None
    assert down.hookload is not None
    recorded = up.hookload.middle - down.hookload.middle
    case = with_values(strings[up.string], friction)

    def load(row: Row, speed: float, law: Direction) -> float:
        rpm = row.rates.spin / rad_per_s(1.0)
        return soft_string(case, row.operation, row.bit_depth, speed=speed, rpm=rpm, direction=law).hookload

    for speed in SPEEDS:
        for name, law in LAWS.items():
            spread = load(up, speed, law) - load(down, speed, law)
            yield {
                "row": ROW, "law": name, "speed_m_s": speed, "spread_kN": spread / 1e3,
                "recorded_kN": recorded / 1e3,
            }  # fmt: skip
