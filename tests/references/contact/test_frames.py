"""Frozen points: what a file holds is enough to build each hole and to find the stored contacts again."""

from pathlib import Path

import numpy as np
import pytest

from fctd.model.wellbore import Wellbore, build_wellbore, find_contacts
from references import contact
from references.contact import frames


@pytest.fixture(scope="module")
def stored(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("frames") / "frames.parquet"
    frames.write(path, 300)
    return path


@pytest.fixture(scope="module")
def built(stored: Path) -> dict[str, Wellbore]:
    return {name: build_wellbore(case) for name, case in frames.read(stored)[1].items()}


@pytest.mark.slow
def test_the_file_alone_gives_the_contacts_again(stored: Path, built: dict[str, Wellbore]) -> None:
    points, _ = frames.read(stored)
    assert len(built) == 4
    for name, hole in built.items():
        rows = points[points["hole"] == name]
        hits = find_contacts(hole, rows[["x_m", "y_m", "z_m"]].to_numpy(), rows["radius_m"].to_numpy())
        np.testing.assert_allclose(hits.penetration, rows["penetration_m"], atol=1e-12)
        np.testing.assert_allclose(hits.normal, rows[["normal_x", "normal_y", "normal_z"]], atol=1e-9)
        np.testing.assert_allclose(hits.md, rows["md_m"], atol=1e-9)
        assert 0.2 < (rows["penetration_m"] > 0).mean() < 0.8
        assert np.abs(rows["penetration_m"]).max() < 0.04


def test_one_hole_is_no_circle_and_one_passes_horizontal(built: dict[str, Wellbore]) -> None:
    assert [name for name, hole in built.items() if not hole.is_round] == ["washed out"]
    assert [name for name, hole in built.items() if (hole.directions[:, 2] < 0).any()] == ["past horizontal"]


def test_points_are_in_random_order(stored: Path) -> None:
    """Points in the order of their depth flatter a tree."""
    points, _ = frames.read(stored)
    for _, rows in points.groupby("hole"):
        assert abs(np.corrcoef(np.arange(len(rows)), rows["md_m"])[0, 1]) < 0.2


@pytest.mark.slow
@pytest.mark.parametrize("name", ["arcs", "sdf"])
def test_a_method_answers_the_frames(name: str, stored: Path) -> None:
    points, cases = frames.read(stored)
    rows = points[points["hole"] == "past horizontal"]
    method = contact.build(name, cases["past horizontal"])
    hits = method.query(rows[["x_m", "y_m", "z_m"]].to_numpy(), rows["radius_m"].to_numpy())
    assert np.abs(hits.penetration - rows["penetration_m"]).max() < 1e-3
