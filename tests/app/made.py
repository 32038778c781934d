"""What the tests of the page have in common: a small well, and a pool that answers in this process."""

import base64
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fctd.app.pool import RefusedError
from fctd.app.sessions import Source
from fctd.app.worker import Wells, answer

SURVEY = b"md_m,inc_deg,azi_deg\n0,0,30\n100,0,30\n550,60,60\n900,60,60\n"
NAME = "<a href='https://example.org'>well</a>"
TEXT = f"""# a comment that stays
name = "{NAME}"
contact.friction_law = "karnopp"
wellbore.survey = "survey.csv"
[[wellbore.intervals]]
to_md = "300 m"
diameter = "0.2445 m"
friction = 0.2
kind = "cased"
[[wellbore.intervals]]
to_md = "900 m"
diameter = "0.2159 m"
friction = 0.25          # of the open hole
static_friction = 0.3
kind = "open"
[[string.components]]
name = "collars"
length = "100 m"
outer_diameter = "0.16 m"
inner_diameter = "0.07 m"
segments = 10
[[string.components]]
name = "pipe"
outer_diameter = "0.127 m"
inner_diameter = "0.1086 m"
segment_length = "25 m"
[mud]
density = "1200 kg/m^3"
[bit]
weight_on_bit = "30 kN"
[[operations]]
kind = "rotate_off_bottom"
at_md = "880 m"
duration = "2 s"
rpm = 90
ramp_time = "1 s"
"""
ROWS = "bit_depth_m,operation,hookload_kN,torque_kN_m\n500,trip_out,150,\n800,rotate_off_bottom,,4\n"


def source(text: str = TEXT, name: str = "survey.csv", survey: bytes = SURVEY) -> Source:
    """The well, or another one."""
    return Source(text, name, survey)


class InProcess:
    """A pool without processes: the same answers, without their limits."""

    note = ""

    def __init__(self) -> None:
        self._scratch = tempfile.TemporaryDirectory()
        self.wells, self.asked = Wells(Path(self._scratch.name)), list[str]()

    def ask(self, do: str, source: Source | None = None, units: Any = "si", **given: Any) -> Any:
        self.asked.append(do)
        request: dict[str, Any] = {"do": do, "digest": source.digest if source else "", "units": units, "given": given}
        found = answer(self.wells, request)
        if "unknown" in found and source is not None:
            survey = base64.b64encode(source.survey).decode()
            content = {"text": source.text, "name": source.survey_name, "survey": survey}
            found = answer(self.wells, request | {"source": content})
        if "refused" in found:
            raise RefusedError(found["refused"])
        return found["found"]

    def close(self) -> None:
        self._scratch.cleanup()


def unpacked(value: dict[str, str]) -> NDArray[np.float32]:
    """Numbers of a figure that ``charts.packed`` has packed."""
    return np.frombuffer(base64.b64decode(value["bdata"]), "<f4")


def of(changes: list[tuple[list[Any], Any]], *way: object) -> Any:
    """The value of a change by its way."""
    (found,) = [value for path, value in changes if path == list(way)]
    return found
