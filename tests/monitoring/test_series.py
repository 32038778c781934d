"""The content of a file tells how to read it; every refusal names the file."""

from pathlib import Path

import pytest

from fctd.case.errors import InputError
from fctd.monitoring.series import read_series
from tests.monitoring.test_log_files import log

TEXT = "time_s,bit_depth_m,hook_load_kN,torque_kN_m,rpm,block_position_m\n0,100,500,2,60,3\n"


@pytest.mark.parametrize(("content", "rows"), [(TEXT, 1), (log(), 2)])
def test_kinds(content: str, rows: int, tmp_path: Path) -> None:
    path = tmp_path / "series"
    path.write_text(content)
    assert len(read_series(path)) == rows


@pytest.mark.parametrize("content", [b"", b"\x00\x01\x02", b"PAR1", b"<a>", b"~V\n", b"1,2\n3,4\n"])
def test_other_files_are_refused_by_name(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "series.dat"
    path.write_bytes(content)
    with pytest.raises(InputError, match=r"series\.dat"):
        read_series(path)


def test_a_missing_file_and_a_folder(tmp_path: Path) -> None:
    for path in (tmp_path / "no.csv", tmp_path):
        with pytest.raises(InputError, match="that can be read"):
            read_series(path)
