"""Checks of snaking at the half wave taken, on tables with known verdicts."""

import pandas as pd
import pytest

from validation.parts import half_waves


def waves(**changed: list[object]) -> pd.DataFrame:
    """Four laid shapes: two kept within the band, one left within it and one beyond."""
    return pd.DataFrame(
        {
            "times_onset": 1.25, "laid_over_least": [0.96, 1.04, 1.16, 1.4],
            "taken_over_least": [0.97, 1.05, 1.05, 1.0],
            "band_from": 0.82, "band_to": 1.25, "on_wall": True, "kept": [True, True, False, False],
            "clamped_keeps": [False, True, False, False], "amplitude_deg": [34.5, 37.8, 37.8, 36.0],
            "mitchell_deg": [34.2, 37.5, 37.5, 20.0],
        }
        | changed
    )  # fmt: skip


ROWS = pd.DataFrame({"own_segment_m": [9.0, 2.0, 0.35], "off_percent": [3.0, -2.0, 0.5]})


def verdicts(laid: pd.DataFrame) -> dict[str, tuple[float, str]]:
    checks = half_waves.checks({"half_waves": laid, "half_waves_of_rows": ROWS})
    return {check.name.split(",")[0]: (check.value, check.verdict) for check in checks}


def test_amplitudes_of_shapes_that_are_kept_are_compared() -> None:
    found = verdicts(waves())
    value, verdict = found["amplitude over the band"]
    assert value == pytest.approx(100 * (34.5 / 34.2 - 1))
    assert verdict == "met"
    assert found["amplitude of rows cut by the engine"] == (3.0, "missed")
    assert found["amplitude of rows with segments of 0.35 m"] == (0.5, "met")


def test_shapes_are_kept_as_the_equation_keeps_them() -> None:
    beyond, left = "half waves beyond the band that the pipe keeps", "half waves that stand between clamped ends"
    found = verdicts(waves())
    assert found[beyond] == (0.0, "met")
    found = verdicts(waves(kept=[True, False, False, True]))
    assert found[beyond] == (1.0, "missed")
    assert found[f"{left} and that the pipe leaves"] == (1.0, "missed")
    # A shape that only a wall that pulls could hold says nothing.
    assert verdicts(waves(kept=[True, True, False, True], on_wall=[True, True, True, False]))[beyond] == (0.0, "met")


def test_note_names_both_bands() -> None:
    assert "0.97 to 1.05 (0.82 to 1.25) at 1.25 times the onset" in half_waves.note(waves())
