"""Each example runs, and asserts one number."""

import runpy
import sys
from pathlib import Path

import pandas as pd
import pytest

ROOT = Path(__file__).parents[2]
SCRIPTS = sorted((ROOT / "examples").glob("*.py"))


def test_there_are_eleven() -> None:
    assert len(SCRIPTS) == 11


@pytest.mark.slow
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda path: path.stem)
def test_an_example_runs(script: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    monkeypatch.setattr(sys, "argv", [str(script)])
    runpy.run_path(str(script), run_name="__main__")
    assert capsys.readouterr().out
    asserted = [line for line in script.read_text(encoding="utf-8").splitlines() if line.startswith("assert ")]
    assert len(asserted) == 1


@pytest.mark.slow
def test_a_guarded_case_is_compared_and_raced(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the same program: no change, and nearly the same time on the processor."""
    script, kept = ROOT / "examples" / "guard_a_case.py", tmp_path / "loads.parquet"
    monkeypatch.chdir(ROOT)
    for given in ([str(kept), sys.executable], [str(kept)]):
        monkeypatch.setattr(sys, "argv", [str(script), *given])
        runpy.run_path(str(script), run_name="__main__")
    first, race, second = capsys.readouterr().out.splitlines()
    assert first == second
    assert "0.00e+00" in second
    assert race.startswith(f"time over that of {sys.executable}: ")
    other = pd.read_parquet(kept)
    other["hookload_N"] *= 1.01
    other.to_parquet(kept)
    with pytest.raises(AssertionError):
        runpy.run_path(str(script), run_name="__main__")
