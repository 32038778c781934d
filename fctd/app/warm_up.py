"""What a process of the page does before the first request: it loads, and compiles where needed, all it may use."""

from typing import Any, Final

from fctd.app import charts, scenes
from fctd.case.load import Case
from fctd.case.message import frame_of
from fctd.case.solver import RESOLVING
from fctd.plots.loads import PLAIN
from fctd.results.unit_systems import in_field_units
from fctd.steady.equilibrium import equilibrium
from fctd.steady.torque_drag import chart_rows
from fctd.view.quantities import QUANTITIES
from fctd.view.strings import of_points

# Straight pipe whose load buckles it; its steady strings go through every method.
SMALL: Final[dict[str, Any]] = {
    "name": "warm-up",
    "wellbore": {
        "stations": [[0, 0, 0], [100, 0, 0]],
        "intervals": [{"to_md": 100.0, "diameter": 0.2, "friction": 0.2}],
    },
    "string": {"components": [{"name": "pipe", "outer_diameter": 0.1, "inner_diameter": 0.05, "segment_length": 25.0}]},
}
OVAL: Final[dict[str, Any]] = {
    "geometry": "sampled", "caliper": {"rows": [[40.0, 0.25, 0.2], [60.0, 0.25, 0.2]]}, "cell": 10.0,
}  # fmt: skip
DEPTHS: Final = (60.0, 70.0, 80.0, 90.0)


def warm_up() -> None:
    """Solve and draw a small case in every way."""
    case = Case.model_validate(SMALL)
    rows = chart_rows(case, ["trip_out", "rotate_off_bottom"], DEPTHS)
    point = equilibrium(case, "trip_out", 90.0)
    tables = *({"solver": {"buckling": way}} for way in RESOLVING), {"contact": {"helical_force": "analytic"}}
    for table in (*tables, tables[0] | {"wellbore": SMALL["wellbore"] | OVAL}):
        buckled = Case.model_validate(SMALL | {"bit": {"weight_on_bit": 1e5}} | table)
        equilibrium(buckled, "drill_sliding", 90.0)
    strings = of_points([point])
    charts.changes_of(rows, case, "si", PLAIN)
    _, _, times = scenes.skeletons(strings, QUANTITIES["side_force"], "si")
    scenes.changes_of(strings, QUANTITIES["side_force"], "si", times, hole=True)
    in_field_units(frame_of(rows))
