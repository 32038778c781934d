"""A well under the sliders: what the page opens with, and what it draws after each move.

This runs in the process of its own that worker.py is.
"""

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from fctd.app import charts, scenes
from fctd.app.case_text import SourceCase
from fctd.app.rows import Rows
from fctd.app.sessions import Source
from fctd.app.sliders import FLOW, RPM, changes, rates_at, sliders_of
from fctd.calibration.measured import read_measured
from fctd.case.errors import InputError
from fctd.case.friction import Pair, changed, pairs_of, table_of
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.text import counted
from fctd.model.depths import usual_depths
from fctd.model.operations import rates_of_all
from fctd.model.wellbore import Wellbore, build_wellbore
from fctd.plots.loads import ChartLook, Load
from fctd.plots.palette import BUCKLED
from fctd.results.series import FRICTION_LABEL
from fctd.results.unit_systems import System, shown
from fctd.steady.equilibrium import Solver
from fctd.steady.margin_table import COLUMNS, margin_rows
from fctd.steady.torque_drag import chart_rows
from fctd.view.hole import drawn_hole
from fctd.view.quantities import QUANTITIES, quantity_of
from fctd.view.strings import Strings, of_points

if TYPE_CHECKING:
    import pandas as pd

USUAL: Final = ("trip_out", "rotate_off_bottom", "trip_in")
DEPTHS: Final = 70
EVERY: Final = 3  # of the depths while a slider moves
MOST_MEASURED: Final = 5_000  # rows
# What else is asked of a chart among its operations: a fan of friction factors, limits, and loads without the block.
FAN, LIMITS, STRING = "fan", "limits", "string"
AS_SET: Final = "as set"
STEPS: Final = {"−0.05": -0.05, AS_SET: 0.0, "+0.05": 0.05}  # of a fan, added to all friction factors
EXTRAS: Final = {
    FAN: "friction 0.05 less and more", LIMITS: "limits of string and rig", STRING: "hook load without the block",
}  # fmt: skip
LIMIT_DEPTHS: Final = 5


def load_of(operations: Sequence[str]) -> Load | None:
    """The load of a chart; None where the case says which it is."""
    return "string" if STRING in operations else None


def _fan(case: Case, wanted: bool) -> dict[str, Case]:
    """The case by ``STEPS`` of its friction factors, none below 0; as it is alone where no fan is wanted."""
    pairs, found = pairs_of(case.wellbore.intervals), {}
    for label, by in STEPS.items() if wanted else ():
        more = [Pair(max(pair.along + by, 0.0), max(pair.around + by, 0.0)) for pair in pairs]
        wellbore = case.wellbore.model_copy(update={"intervals": changed(case.wellbore.intervals, more)})
        found[label] = case.model_copy(update={"wellbore": wellbore})
    return found or {AS_SET: case}


class Well:
    """A case with its sliders; raises InputError for one that cannot be used.

    depths (k,) [m] : of the chart.
    """

    def __init__(self, source: Source, folder: Path, units: System) -> None:
        self.units, self.read = units, SourceCase(source, folder)
        self.case = self.read.case
        self.depths = usual_depths(self.case, DEPTHS)
        self.sliders = sliders_of(self.case, units)
        self.hole, self._rows = build_wellbore(self.case), Rows()
        self._drawn = drawn_hole(self.case, self.hole, self.case.string.top_md)
        self._last: tuple[str, Case, Wellbore] = ("", self.case, self.hole)
        self._exaggeration = 1.0
        self._opened: dict[str, Any] | None = None

    def moved(self, values: Mapping[str, object]) -> Case:
        """The case with the sliders at values [shown units]; those that are not named stand at the case's own."""
        key = json.dumps(values, sort_keys=True)
        if key != self._last[0]:
            case = self.read.changed(self.overrides(values))
            rates = {slider.name: slider for slider in self.sliders if slider.name in (RPM, FLOW)}
            if rates.keys() & values.keys():
                # A slider that stands at its value leaves the flows as the case has them.
                shown_at = {name: of.check(values.get(name, of.value)) * of.factor for name, of in rates.items()}
                case = rates_at(case, shown_at[RPM], shown_at.get(FLOW) if FLOW in values else None)
            # No slider moves the hole: its wall alone changes.
            self._last = key, case, self.hole.with_friction(table_of(case.wellbore.intervals))
        return self._last[1]

    def overrides(self, values: Mapping[str, object]) -> dict[str, Any]:
        """Values of dotted keys for the sliders; see ``sliders.changes``."""
        return changes(self.case, self.read.raw, self.sliders, values)

    def opened(self) -> dict[str, Any]:
        """What the page begins with."""
        if self._opened is None:
            factor, unit = shown("bit_depth_m", self.units)
            case, quantity = self.case, QUANTITIES["side_force"]
            strings = self._strings(case, "trip_out", self.depths[-1])
            scene, panels, self._exaggeration = scenes.skeletons(strings, quantity, self.units)
            usual = [*USUAL, *(["drill_rotating"] if case.bit.weight_on_bit else [])]
            self._opened = {
                "name": case.name, "sliders": [asdict(slider) for slider in self.sliders], "operations": usual,
                "depth": {"low": self.depths[0] * factor, "high": self.depths[-1] * factor, "unit": unit},
                "loads": charts.EMPTY, "scene": scene, "panels": panels,
                "warnings": [warning.told(self.units) for warning in self.read.warnings],
                "facts": self._facts(), "runs": bool(case.operations), "exaggeration": self._exaggeration,
            }  # fmt: skip
        return self._opened

    def solved(
        self, values: Mapping[str, object], operations: Sequence[str], operation: str, depth: float, colour: str,
        measured: str = "", *, coarse: bool = False, hole: bool = True,
    ) -> dict[str, Any]:  # fmt: skip
        """Changes of the three figures for sliders at values.

        operations : of the chart, with what else is asked of it (``EXTRAS``); operation, depth [shown unit] : of the
        string in its hole; coarse : whether every third depth is enough; hole : whether the hole is drawn anew;
        measured : text of measured rows.
        """
        kinds = [kind for kind in KINDS if kind in operations]
        if operation not in KINDS:
            raise InputError("a kind of operation", key="operation", value=operation)
        case = self.moved(values)
        self.opened()
        depths = self.depths[::-1][::EVERY][::-1] if coarse else self.depths
        rows: list[dict[str, Any]] = []
        for label, one in _fan(case, FAN in operations and not coarse).items():
            hole_of = self._last[2].with_friction(table_of(one.wellbore.intervals))
            found = self._rows.solve(one, hole_of, kinds, depths) if kinds else []
            rows += [row | {FRICTION_LABEL: label} for row in found]
        points = self.measured(measured)
        margins = self.margins_of(case, kinds) if LIMITS in operations and kinds and not coarse else None
        look = ChartLook(load_of(operations), measured=points, margins=margins)
        loads = charts.changes_of(rows, case, self.units, look) if rows else []
        factor, unit = shown("bit_depth_m", self.units)
        at = self.within(depth / factor)
        strings = self._strings(case, operation, at, self._last[2])
        scene, panels, words = scenes.changes_of(
            strings, quantity_of(colour), self.units, self._exaggeration, hole=hole
        )
        where = f"{KINDS[operation].label}, bit at {at * factor:.0f} {unit}"
        return {
            "loads": loads, "scene": scene, "panels": panels, "where": where, "words": words, "note": self._note(rows),
        }  # fmt: skip

    def margins_of(self, case: Case, kinds: Sequence[str]) -> "pd.DataFrame":
        """The margins of the operations at some depths of the chart, up to buckling; of none where nothing fits."""
        import pandas as pd

        solver, rates = self._rows.solver(case, self._last[2]), rates_of_all(case, kinds)
        rows = []
        for depth in np.linspace(self.depths[0], self.depths[-1], LIMIT_DEPTHS):
            with suppress(InputError):  # string and hole do not fit, as the chart says
                rows += margin_rows(solver, kinds, rates, float(depth), beyond_buckling=False)
        return pd.DataFrame(rows, columns=["operation", "bit_depth_m", *COLUMNS.values()])

    def chart(self, values: Mapping[str, object], operations: Sequence[str]) -> list[dict[str, Any]]:
        """All rows of the chart for the sliders at values, of a fan too where it is among the operations."""
        kinds, fan = [kind for kind in KINDS if kind in operations] or [*USUAL], FAN in operations
        return [
            row | ({FRICTION_LABEL: label} if fan else {})
            for label, one in _fan(self.moved(values), fan).items()
            for row in chart_rows(one, kinds, self.depths)
        ]

    def check_measured(self, text: str) -> dict[str, Any]:
        """The number of measured rows of a text, and what is to be said of their units.

        Raises InputError for a text that cannot be read.
        """
        told: list[str] = []
        found = self.measured(text, told.append)
        return {"rows": 0 if found is None else len(found), "told": told}

    def measured(self, text: str, tell: Callable[[str], None] | None = None) -> "pd.DataFrame | None":
        """Measured rows of a text in columns, as in a file of them; None without any.  tell : see ``read_measured``."""
        if not text.strip():
            return None
        path = self.read.folder / "measured.csv"
        path.write_bytes(text.encode("utf-8", "replace"))
        try:
            found = read_measured(path, self.case, self.units, tell)
        except InputError as error:
            raise InputError(error.expected, key=error.key, value=error.value, file="measured rows") from None
        if len(found) > MOST_MEASURED:
            raise InputError(f"at most {MOST_MEASURED} rows", value=len(found), file="measured rows")
        return found

    def profile_at(self, values: Mapping[str, object], operation: str, depth: float) -> "pd.DataFrame":
        """The steady string of an operation with the bit at a depth [m], a row per contact point."""
        case = self.moved(values)
        return Solver(case).solve(operation, rates_of_all(case, [operation])[operation], self.within(depth)).profile

    def within(self, depth: float) -> float:
        """A bit depth [m], or the nearest one of the chart's."""
        return float(np.clip(depth, self.depths[0], self.depths[-1]))

    def strings_at(self, values: Mapping[str, object], operation: str, depths: Sequence[float]) -> Strings:
        """Steady strings of an operation at depths [m]."""
        case = self.moved(values)
        solver, rate = Solver(case), rates_of_all(case, [operation])[operation]
        return of_points([solver.solve(operation, rate, depth) for depth in depths], solver.hole)

    def _strings(self, case: Case, operation: str, depth: float, hole: Wellbore | None = None) -> Strings:
        solver = self._rows.solver(case, self.hole if hole is None else hole)
        point = solver.solve(operation, rates_of_all(case, [operation])[operation], depth)
        return of_points([point], solver.hole, self._drawn)

    def _facts(self) -> str:
        """The hole and the string in a line."""
        case, (factor, unit) = self.case, shown("bit_depth_m", self.units)
        stations = case.wellbore.trajectory
        steepest = float(np.degrees(stations[:, 1].max()))
        segments = len(self._strings(case, "trip_out", self.depths[-1]).snapshots[0].offset)
        parts = [f"{case.depths[1] * factor:.0f} {unit} deep", f"up to {steepest:.0f}°"]
        parts += [counted(len(stations), "station"), counted(segments, "contact point")]
        return ", ".join(parts)

    def _note(self, rows: Sequence[Mapping[str, Any]]) -> str:
        """How many rows are no plain answers, and what rings and crosses in the chart are."""
        found: dict[str, int] = {}
        for row in rows:
            if row["status"] != "converged":
                word = str(row["status"]).replace("_", " ")
                found[word] = found.get(word, 0) + 1
        told = ", ".join(f"{count} of {len(rows)} {word}" for word, count in found.items())
        signs = {
            "rings: buckled": any(row["buckling"] in BUCKLED for row in rows),
            "crosses: no loads": any(np.isnan(row["hookload_N"]) for row in rows),
        }
        return "; ".join(filter(None, [told, *(sign for sign, drawn in signs.items() if drawn)]))
