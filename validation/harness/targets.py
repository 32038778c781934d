"""Other compiled code on this processor: the environment that makes a process compile and compute for another one.

The environment is read when a process begins, so that a target needs a process of its own.  ``python -m
validation.harness.targets NAME`` prints it as lines KEY=VALUE.
"""

import os
from collections.abc import Mapping

import llvmlite.binding as llvm
import numpy as np
import typer

# Features as LLVM calls them, of the levels of the System V ABI.
V2 = frozenset(
    "64bit cmov cx8 fxsr mmx sse sse2 crc32 cx16 popcnt sahf sse3 sse4.1 sse4.2 ssse3".split()  # noqa: SIM905
)
V3 = V2 | {"avx", "avx2", "bmi", "bmi2", "f16c", "fma", "lzcnt", "movbe", "xsave"}
V4 = V3 | {"avx512bw", "avx512cd", "avx512dq", "avx512f", "avx512vl"}
LEVELS = {"x86-64-v2": V2, "x86-64-v3": V3, "x86-64-v4": V4}
NO_FMA = "no-fma"  # this processor without fused multiply-add, and without AVX-512, which brings it
NAMES = (*LEVELS, NO_FMA)

CORES = {"x86-64-v2": "Nehalem", "x86-64-v3": "Haswell", "x86-64-v4": "SkylakeX", NO_FMA: "Sandybridge"}
# What numpy chooses at run time, as numpy 2.4 and as earlier ones call it; the rest is switched off.
NUMPY_V2 = frozenset({"X86_V2", "SSE", "SSE2", "SSE3", "SSSE3", "SSE41", "POPCNT", "SSE42"})
NUMPY_V3 = NUMPY_V2 | {"X86_V3", "AVX", "F16C", "FMA3", "AVX2"}
NUMPY_V4 = NUMPY_V3 | {"X86_V4", "AVX512F", "AVX512CD", "AVX512_SKX"}
NUMPY = {"x86-64-v2": NUMPY_V2, "x86-64-v3": NUMPY_V3, "x86-64-v4": NUMPY_V4, NO_FMA: NUMPY_V2 | {"AVX", "F16C"}}

CODE = "NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES"
VARIABLES = (*CODE, "OPENBLAS_CORETYPE", "NPY_DISABLE_CPU_FEATURES", "GLIBC_TUNABLES")
# The sines and exponentials of the C library have forms of their own for fused multiply-add.
WITHOUT_FMA = "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"


def lacking(name: str) -> str:
    """Why this machine cannot run code of a target; empty where it can."""
    if not llvm.get_process_triple().startswith(("x86_64", "amd64")):
        return f"targets are of x86-64, and this is {llvm.get_process_triple()}"
    host = _host()
    absent = sorted(feature for feature in LEVELS.get(name, ()) if not host.get(feature))
    return f"this processor lacks {', '.join(absent)}" if absent else ""


def environment(name: str) -> dict[str, str]:
    """The variables of a target that this machine can run."""
    host = _host()
    level = LEVELS.get(name) or {feature for feature, there in host.items() if there and not _fuses(feature)}
    # The name alone would leave the features of this processor on.
    features = ",".join(f"{'+' if feature in level else '-'}{feature}" for feature in sorted(host))
    found = {
        "NUMBA_CPU_NAME": name if name in LEVELS else llvm.get_host_cpu_name(),
        "NUMBA_CPU_FEATURES": features,
        "OPENBLAS_CORETYPE": CORES[name],
    }
    chosen = np.show_config(mode="dicts")["SIMD Extensions"].get("found", [])
    chosen += os.environ.get("NPY_DISABLE_CPU_FEATURES", "").split()  # what is off in this process need not be there
    if off := [feature for feature in chosen if feature not in NUMPY[name]]:
        found["NPY_DISABLE_CPU_FEATURES"] = " ".join(off)
    if "fma" not in level:
        found["GLIBC_TUNABLES"] = WITHOUT_FMA
    return found


def _host() -> Mapping[str, bool]:
    found: Mapping[str, bool] = llvm.get_host_cpu_features()
    return found


def _fuses(feature: str) -> bool:
    return feature in ("fma", "fma4") or feature.startswith(("avx512", "avx10"))


def main(name: str) -> None:
    """Print the environment of a target; exit code 1 where this machine cannot run it, 2 for an unknown name."""
    if name not in NAMES:
        typer.echo(f"error: target = {name!r}: expected one of {', '.join(NAMES)}", err=True)
        raise typer.Exit(2)
    if why := lacking(name):
        typer.echo(f"{name}: {why}", err=True)
        raise typer.Exit(1)
    for key, value in environment(name).items():
        typer.echo(f"{key}={value}")


if __name__ == "__main__":
    typer.run(main)
