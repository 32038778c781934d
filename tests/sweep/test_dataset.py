"""The folder of a sweep: parts with the values of their samples, what is missing, and folders that are refused."""

import os
from pathlib import Path

import pandas as pd
import pytest

from fctd.case.errors import InputError
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.sweep.chunk import as_table
from fctd.sweep.dataset import Dataset, alone, begin_dataset, identity_of, open_dataset
from fctd.sweep.design import sample_of, samples_of
from fctd.sweep.spec import read_sweep
from fctd.sweep.template import template_of
from validation.parts.small_sweep import PARAMETERS, WORK, sweep_file


def dataset(folder: Path, **given: str) -> Dataset:
    spec = read_sweep(sweep_file(folder, **given))
    samples = samples_of(spec)
    return begin_dataset(folder / "out", template_of(spec, sample_of(samples, 0)), samples)


def rows(*samples: int) -> list[dict[str, object]]:
    return [{"sample": k, "hookload_N": 10.0 * k, "status": "converged"} for k in samples]


def test_parts_hold_their_samples_with_the_values_beside_them(tmp_path: Path) -> None:
    found = dataset(tmp_path)
    found.write([as_table(rows(5, 4)), as_table([{"sample": 1, "status": "failed", "reason": "why"}])])
    found.write([as_table(rows(0))])
    again = open_dataset(tmp_path / "out")
    assert again.done == {0, 1, 4, 5}
    assert again.missing == [2, 3, 6, 7, 8, 9, 10, 11]
    table = again.rows()
    assert table["sample"].tolist() == [0, 1, 4, 5]
    assert table["mud.density"].tolist() == found.samples["mud.density"].iloc[[0, 1, 4, 5]].tolist()
    assert table["hookload_N"].isna().tolist() == [False, True, False, False]
    assert table["reason"].iloc[1] == "why"
    assert again.statuses() == {"converged": 3, "failed": 1}


@pytest.mark.parametrize(
    "other", [{"body": PARAMETERS.replace("0.3\n", "0.31\n") + WORK}, {"case": "[bit]\nweight_on_bit = 1000\n"}]
)
def test_a_folder_of_another_sweep_is_refused(other: dict[str, str], tmp_path: Path) -> None:
    dataset(tmp_path)
    with pytest.raises(InputError, match="another sweep file, case or survey"):
        dataset(tmp_path, **other)


def test_another_survey_in_the_same_file_is_another_sweep(tmp_path: Path) -> None:
    path, survey = sweep_file(tmp_path), tmp_path / "hole.csv"
    well = tmp_path / "well.toml"
    stations = "stations = [[0, 0, 0], [200, 0, 0], [500, 45, 30], [900, 45, 30]]"
    assert stations in well.read_text()
    well.write_text(well.read_text().replace(stations, 'survey = "hole.csv"'))
    found = []
    for last in (45, 45, 46):
        survey.write_text(f"md_m,inc_deg,azi_deg\n0,0,0\n200,0,0\n500,45,30\n900,{last},30\n")
        spec = read_sweep(path)
        found.append(identity_of(template_of(spec, sample_of(samples_of(spec), 0))))
    assert found[0] == found[1] != found[2]


def test_what_uncertainty_asks_for_does_not_change_a_sweep(tmp_path: Path) -> None:
    dataset(tmp_path)
    dataset(tmp_path, body=PARAMETERS + WORK + "[uncertainty]\npercentiles = [10, 90]\n")


def test_a_folder_with_other_files_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "notes.txt").write_text("mine", encoding="utf-8")
    expected = pytest.raises(InputError, match="a folder for a sweep alone")
    with expected, alone(tmp_path / "out"):
        pass
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["notes.txt"]


def test_rows_of_other_sources_are_not_mixed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Or of other versions; the sources say whether the numbers are those of this program."""
    found = dataset(tmp_path)
    assert found.about["sources"] == hash_of_sources()
    monkeypatch.setattr("fctd.sweep.dataset.hash_of_sources", lambda: "other")
    monkeypatch.setattr("fctd.sweep.dataset.versions", lambda: found.about["versions"] | {"numba": "0.1"})
    with pytest.raises(InputError, match=r"computed, numba was .* and is 0\.1; the sources of fctd have changed"):
        dataset(tmp_path)


def test_only_one_sweep_works_on_a_folder(tmp_path: Path) -> None:
    expected = pytest.raises(InputError, match=rf"no other sweep works on \(process {os.getpid()} does\)")
    with alone(tmp_path / "out"), expected, alone(tmp_path / "out"):
        pass
    with alone(tmp_path / "out"):
        pass
    assert list((tmp_path / "out").iterdir()) == []


def test_a_folder_without_a_dataset_and_a_broken_part_are_answered(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="a folder that fctd sweep has written"):
        open_dataset(tmp_path)
    found = dataset(tmp_path)
    with pytest.raises(InputError, match="at least one sample"):
        found.rows()
    (found.folder / "rows" / "part-00000.parquet").write_bytes(b"nonsense")
    with pytest.raises(InputError, match="a part that fctd sweep wrote"):
        open_dataset(found.folder)


def test_a_key_of_the_name_of_a_result_is_one_column(tmp_path: Path) -> None:
    body = '[[parameters]]\nkey = "friction"\ndistribution = "uniform"\nlow = 0.1\nhigh = 0.3\n' + WORK
    found = dataset(tmp_path, body=body)
    found.write([as_table([{"sample": 0, "friction": 0.5}])])
    assert found.rows()["friction"].tolist() == [found.samples["friction"].iloc[0]]


def test_samples_are_kept_as_they_were_drawn(tmp_path: Path) -> None:
    found = dataset(tmp_path)
    pd.testing.assert_frame_equal(open_dataset(found.folder).samples, found.samples)
