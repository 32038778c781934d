"""Targets: the environment that makes this machine compile for another processor, and the code that it gives."""

import os
import subprocess
import sys

import llvmlite.binding as llvm
import numpy as np
import pytest

from validation.harness import targets

HERE = "x86-64-v2"
runs_it = pytest.mark.skipif(bool(targets.lacking(HERE)), reason=f"{HERE}: {targets.lacking(HERE)}")
HOST = {"avx512f": False, "fma4": True, "aes": True} | dict.fromkeys(targets.V3, True)

PROGRAM = """
import os
import numpy as np
from fctd.mechanics import jit
def product(x, y):
    return x * y + x
compiled = jit.njit(**jit.OPTIONS)(product)
compiled(1.5, 2.0)
print("fma" in "".join(compiled.inspect_asm().values()))
print(*np.show_config(mode="dicts")["SIMD Extensions"].get("found", []))
"""


def features(found: dict[str, str]) -> set[str]:
    return {feature[1:] for feature in found["NUMBA_CPU_FEATURES"].split(",") if feature[0] == "+"}


@pytest.fixture
def host(monkeypatch: pytest.MonkeyPatch) -> dict[str, bool]:
    """A processor with AVX2 and no AVX-512, whatever this one is."""
    found = dict(HOST)
    monkeypatch.setattr(targets.llvm, "get_host_cpu_features", lambda: found)
    monkeypatch.setattr(targets.llvm, "get_host_cpu_name", lambda: "znver3")
    monkeypatch.setattr(targets.llvm, "get_process_triple", lambda: "x86_64-unknown-linux-gnu")
    return found


def test_a_level_has_its_features_and_no_others(host: dict[str, bool]) -> None:
    """The name alone would leave those of this processor on."""
    for name in ("x86-64-v2", "x86-64-v3"):
        found = targets.environment(name)
        assert found["NUMBA_CPU_NAME"] == name
        assert features(found) == targets.LEVELS[name]
        assert "-aes" in found["NUMBA_CPU_FEATURES"].split(",")


def test_no_fma_is_this_processor_without_what_fuses(host: dict[str, bool]) -> None:
    host.update(avx512f=True, avx512vl=True)
    found = targets.environment("no-fma")
    assert found["NUMBA_CPU_NAME"] == "znver3"
    assert features(found) == {"aes", *targets.V3} - {"fma"}
    assert "-FMA" in found["GLIBC_TUNABLES"]
    assert "GLIBC_TUNABLES" not in targets.environment("x86-64-v3")


def test_what_this_processor_lacks_is_said(host: dict[str, bool], monkeypatch: pytest.MonkeyPatch) -> None:
    assert targets.lacking("x86-64-v3") == targets.lacking("no-fma") == ""
    assert targets.lacking("x86-64-v4") == "this processor lacks avx512bw, avx512cd, avx512dq, avx512f, avx512vl"
    monkeypatch.setattr(targets.llvm, "get_process_triple", lambda: "aarch64-apple-darwin")
    assert "targets are of x86-64" in targets.lacking("no-fma")


@pytest.mark.slow
@runs_it
def test_the_command_prints_lines_that_a_script_reads() -> None:
    def ask(name: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-m", "validation.harness.targets", name]
        return subprocess.run(command, capture_output=True, text=True, cwd=targets.__file__.rpartition("validation")[0])

    lines = ask(HERE).stdout.splitlines()
    assert {line.partition("=")[0] for line in lines} >= {"NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", "OPENBLAS_CORETYPE"}
    assert lines[0] == "NUMBA_CPU_NAME=x86-64-v2"
    wrong = ask("x86-65")
    assert wrong.returncode == 2
    assert wrong.stderr == "error: target = 'x86-65': expected one of x86-64-v2, x86-64-v3, x86-64-v4, no-fma\n"


@pytest.mark.slow
@runs_it
@pytest.mark.skipif(not llvm.get_host_cpu_features().get("fma"), reason="this processor has no fused multiply-add")
def test_code_of_a_target_has_no_fused_multiply_add(tmp_path) -> None:
    def run(environment: dict[str, str]) -> list[str]:
        plain = {key: value for key, value in os.environ.items() if key not in targets.VARIABLES}
        here = plain | environment | {"NUMBA_CACHE_DIR": str(tmp_path / "code")}
        done = subprocess.run([sys.executable, "-c", PROGRAM], env=here, capture_output=True, text=True, check=True)
        assert done.stderr == ""  # numpy and OpenBLAS know the names
        return done.stdout.splitlines()

    assert run({})[0] == "True"
    assert run(targets.environment("no-fma")) == ["False", ""]


def test_numpy_is_told_by_names_that_it_has() -> None:
    known = np.show_config(mode="dicts")["SIMD Extensions"]
    named = {name for key in ("baseline", "found", "not found") for name in known.get(key, [])}
    off = targets.environment(HERE).get("NPY_DISABLE_CPU_FEATURES", "").split()
    assert set(off) <= named - targets.NUMPY_V2
