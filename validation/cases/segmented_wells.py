"""Wells for strings of any number of segments."""

from collections.abc import Callable
from typing import Any, NamedTuple

from fctd import Case
from validation.cases import load
from validation.cases.wells import BUILD, PIPE, SHARP, Stations, catenary, well

# Stiffness per metre, so that refining the string does not stiffen the wall [N/m/m].
WALL = {"stiffness": None, "stiffness_per_length": 1e6}
BITE = {f"wellbore__{key}": value for key, value in WALL.items()}

PAPER: Stations = [[0, 0, 45], [1750, 0, 45], [2250, 58, 45], [2450, 90, 45], [4300, 90, 45]]
PAPER_B: Stations = [[0, 0, 45], [1750, 0, 45], [2112.5, 58, 45], [2250, 58, 45], [2450, 90, 45], [4300, 90, 45]]


class Well(NamedTuple):
    """A case for each number of segments and hole, its bit depth [m], and where the string lies in a bend [m]."""

    case: Callable[[int, dict[str, Any]], Case]
    bit: float
    bend: float


def _paper(name: str, stations: Stations) -> Callable[[int, dict[str, Any]], Case]:
    """Collars and pipe share the count as in §6.2, one to two; the long segment above remains."""

    def build(count: int, hole: dict[str, Any]) -> Case:
        collars = max(round(count / 3), 1)
        return load(
            name, wellbore__survey=None, wellbore__stations=stations, string__components__0__segments=collars,
            string__components__1__segments=count - collars, **BITE, **_keys(hole),
        )  # fmt: skip

    return build


def _scaled(count: int, hole: dict[str, Any]) -> Case:
    return load("scaled_section", string__components__0__segments=count, **_keys({"overlap": "20 mm"} | hole))


def _synthetic(name: str, stations: Stations) -> Callable[[int, dict[str, Any]], Case]:
    def build(count: int, hole: dict[str, Any]) -> Case:
        depth = stations[-1][0]
        return well(name, stations, [{**PIPE, "length": depth, "segments": count}], {**WALL, **hole})

    return build


def _keys(hole: dict[str, Any]) -> dict[str, Any]:
    sizes: dict[str, Any] = {"chord_tolerance": None, "cylinder_length": None}
    return {f"wellbore__{key}": value for key, value in (sizes | hole).items()}


_CATENARY = catenary()
WELLS: dict[str, Well] = {
    "paper-well": Well(_paper("paper_well", PAPER), 2450.0, 2000.0),
    "paper-well-b": Well(_paper("paper_well_b", PAPER_B), 2450.0, 1930.0),
    "scaled-section": Well(_scaled, 44.0, 38.0),
    "4.5°/30 m": Well(_synthetic("build", BUILD), 1500.0, 600.0),
    "30°/100 ft": Well(_synthetic("sharp", SHARP), SHARP[-1][0], 0.5 * (SHARP[1][0] + SHARP[2][0])),
    "catenary": Well(_synthetic("catenary", _CATENARY), _CATENARY[-1][0], 0.5 * _CATENARY[-1][0]),
}
