"""Errors of a survey: inclinations and azimuths as a tool might have measured them of another hole.

A systematic error is the same at all stations of a sample, a random one is drawn anew at each.  All are normal
deviates.  The first station is where the hole begins: it is known.  Errors of measured depth are left out.
"""

from __future__ import annotations

from typing import Annotated, Final, Literal, NamedTuple

import numpy as np
from pydantic import model_validator

from fctd.arrays import Array
from fctd.case import units
from fctd.case.errors import InputError, Table

Error = Annotated[float, units.Quantity(dimension=units.ANGLE, at_least=0.0, at_most=0.2)]


class Tool(NamedTuple):
    """Standard deviations [deg]: random and systematic inclination, random and systematic azimuth."""

    random_inclination: float
    systematic_inclination: float
    random_azimuth: float
    systematic_azimuth: float


# Assumed, in round numbers of the size of published models: sag and declination of ISCWSA's model of measurement while
# drilling (Williamson 2000), true inclination and compass of Wolff & de Wardt (1981).  They stand for no one tool; the
# four keys take the numbers of a contract.
TOOLS: Final = {
    "mwd": Tool(0.1, 0.2, 0.15, 0.4),
    "mwd_corrected": Tool(0.1, 0.1, 0.1, 0.25),
    "gyro": Tool(0.05, 0.1, 0.1, 0.2),
    "magnetic_multishot": Tool(0.15, 0.3, 0.3, 1.0),
    "inclination_only": Tool(0.2, 0.5, 5.0, 10.0),
}
ToolCode = Literal["mwd", "mwd_corrected", "gyro", "magnetic_multishot", "inclination_only"]


class SurveyErrors(Table):
    """Standard deviations [rad] of the errors of a survey: those of a ``tool``, or of the keys that are given."""

    tool: ToolCode | None = None
    random_inclination: Error | None = None
    systematic_inclination: Error | None = None
    random_azimuth: Error | None = None
    systematic_azimuth: Error | None = None

    @model_validator(mode="after")
    def _check(self) -> SurveyErrors:
        if not any(self.deviations):
            raise InputError(f"a tool, one of {', '.join(TOOLS)}, or an error above 0", key="tool")
        return self

    @property
    def deviations(self) -> Tool:
        """The standard deviations [rad]; those of the keys go before those of the tool."""
        base = Tool(0.0, 0.0, 0.0, 0.0) if self.tool is None else TOOLS[self.tool]
        own = {name: getattr(self, name) for name in Tool._fields}
        return Tool(*(float(np.radians(of)) if own[name] is None else own[name] for name, of in base._asdict().items()))


def erred(stations: Array, errors: SurveyErrors, draw: np.random.Generator) -> Array:
    """Stations (n, 3) [m, rad, rad] with drawn errors.

    An inclination that would be negative, or above 180°, is one on the other side: its azimuth turns by 180°.
    """
    of, count = errors.deviations, len(stations) - 1
    normal = draw.standard_normal((2, count + 1))
    inclination = of.systematic_inclination * normal[0, 0] + of.random_inclination * normal[0, 1:]
    azimuth = of.systematic_azimuth * normal[1, 0] + of.random_azimuth * normal[1, 1:]
    found = stations.copy()
    found[1:, 1] += inclination
    found[1:, 2] += azimuth
    for beyond in (found[:, 1] < 0, found[:, 1] > np.pi):
        found[beyond, 1] = np.where(found[beyond, 1] < 0, -found[beyond, 1], 2 * np.pi - found[beyond, 1])
        found[beyond, 2] += np.pi
    return found
