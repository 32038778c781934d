"""Where a pipe comes off the wall: by the loads before, and judged for the waves that it has."""

import pandas as pd
import pytest

from references.buckling import mitchell
from validation.parts import wall_limits


def path_of(shape: list[str], **columns: list[float]) -> pd.DataFrame:
    return pd.DataFrame({"shape": shape} | columns)


# Forces that would vanish at 1.8 and at 1.35 times the onset.
LOADING = path_of(
    ["snaking"] * 4,
    times_onset=[1.6, 1.7, 1.8, 1.9],
    least_wall_force_over_weight=[0.4, 0.2, 0.0, 0.0],
    off_wall_percent=[0.0, 0.0, 8.0, 9.0],
    wave_m=[12.0, 12.1, 12.2, 12.3],
)
BACK = path_of(
    ["helix", "helix", "snaking"],
    times_onset=[1.5, 1.4, 1.3],
    least_wall_force_over_weight=[0.3, 0.1, 0.5],
    off_wall_percent=[0.0, 0.0, 0.0],
    wave_m=[19.0, 19.1, 12.0],
)


def test_the_force_vanishes_beyond_the_last_two_loads_on_the_wall() -> None:
    assert wall_limits.coming_off(LOADING, "snaking") == (pytest.approx(1.8), 12.1)
    assert wall_limits.coming_off(BACK, "helix") == (pytest.approx(1.35), 19.1)


def test_waves_of_least_energy_come_off_at_the_limit_of_the_equation() -> None:
    exact = mitchell.helix_contact_limit()
    turn = mitchell.helix(wall_limits.BUCKLING, exact * wall_limits.BUCKLING.onset).length
    assert wall_limits.limit_of(mitchell.helix, 1.4, turn) == pytest.approx(exact, abs=1e-3)


def test_the_waves_that_a_pipe_has_are_judged_and_no_others() -> None:
    """A helix of shorter turns comes off at a larger load, 1.42 times the onset for 19.1 m: 1.35 is 5 % off."""
    tables = {
        "paths": pd.concat([LOADING.assign(path="loading"), BACK.assign(path="unloading from a helix")]),
        "snaking": pd.DataFrame({"wall_force_off_percent": [0.2, -0.9]}),
    }
    snaking, helix, force = wall_limits.checks(tables)
    assert (snaking.verdict, helix.verdict, force.value) == ("missed", "missed", 0.9)
    assert helix.value == pytest.approx(100 * (1 - 1.35 / 1.418), abs=0.1)
    tables["paths"].loc[tables["paths"]["shape"] == "helix", "wave_m"] = 21.5  # comes off at 1.373
    assert wall_limits.checks(tables)[1].verdict == "met"
