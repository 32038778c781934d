"""A small inclined well, and series of it."""

from functools import cache

import numpy as np
import pandas as pd

from fctd.case.load import Case
from fctd.monitoring.chart import Chart, Fit
from fctd.monitoring.synthetic import over_time, raised, steady_readings, with_noise
from tests.cases import make_case, pipe

BLOCK = 200e3
STEP_AT = 800.0


@cache
def well() -> Case:
    """60° from 500 m; cased to 600 m; the rig has a torque offset."""
    intervals = [
        {"to_md": 600.0, "diameter": 0.22, "friction": 0.2, "kind": "cased"},
        {"to_md": 1000.0, "diameter": 0.2159, "friction": 0.3, "kind": "open"},
    ]
    return make_case(
        [[0, 0, 0], [200, 0, 0], [500, 60, 0], [1000, 60, 0]],
        [pipe(None, None, inner_diameter=0.1086, segment_length=25.0)],
        wellbore={"geometry": "arcs", "stiffness": 5e7, "intervals": intervals},
        rig={"block_weight": BLOCK, "torque_offset": 500.0},
    )


@cache
def chart() -> Chart:
    return Chart(well())


def shared_chart(case: Case, fit: Fit | None) -> Chart:
    """In place of a chart of a case with the hole of ``well``, so that it is solved once for all tests."""
    return chart() if fit is None else Chart(case, fit)


@cache
def readings() -> pd.DataFrame:
    """By depth, without noise; the open hole has a half more friction from ``STEP_AT`` on."""
    depths = np.arange(640.0, 990.0, 25.0)
    before, behind = list(depths[depths < STEP_AT]), list(depths[depths >= STEP_AT])
    parts = [steady_readings(well(), before), steady_readings(raised(well(), 0.5), behind)]
    return pd.concat(parts, ignore_index=True)


@cache
def series() -> pd.DataFrame:
    """The same over time, with small noise from a seed."""
    generator = np.random.default_rng(3)
    return over_time(with_noise(readings(), generator, 1e3, 0.01), generator, BLOCK)
