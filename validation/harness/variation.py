"""The same studies with other rounding: with noise of its size on stations and segments, and as other compiled code.

A number that moves by more than rounding can explain hangs on a choice that rounding makes.
"""

import os
import subprocess
import sys
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from fctd.case.solver import PERTURBED
from validation.harness import targets

FOLDER = ".perturbed"  # in the folder of results, and read by nobody who reads plain ones


@dataclass(frozen=True)
class Variation:
    """The seed of the noise and the target of compiled code; None where a run is without."""

    seed: int | None = None
    target: str | None = None

    @property
    def label(self) -> str:
        """Its name, as ``no-fma-noise-3``; empty for a plain run."""
        noise = None if self.seed is None else f"noise-{self.seed}"
        return "-".join(part for part in (self.target, noise) if part)

    @property
    def environment(self) -> dict[str, str]:
        """The variables with which a process begins for it."""
        noise = {PERTURBED: str(self.seed)} if self.seed is not None else {}
        return noise | (targets.environment(self.target) if self.target else {})

    @property
    def is_here(self) -> bool:
        """Whether this process began with them."""
        asked = (PERTURBED, *targets.CODE)
        return all(os.environ.get(key) == value for key, value in self.environment.items() if key in asked)

    def folder(self, results: Path) -> Path:
        """Where its results are, in the folder of the plain ones."""
        return results / FOLDER / self.label if self.label else results


def in_processes(variations: Sequence[Variation], arguments: Sequence[str]) -> int:
    """Run ``python -m validation`` with these arguments for each variation, one after the other; the worst exit code.

    A process for each: cases that a module made when it was imported keep the noise of that time.
    """
    worst = 0
    for each in variations:
        own = _options(each)
        code = _wait([sys.executable, "-m", "validation", *arguments, *own], os.environ | each.environment)
        if code not in (0, 1):
            return code
        worst = max(worst, code)
    return worst


def _options(each: Variation) -> list[str]:
    seed = [] if each.seed is None else ["--perturbed", str(each.seed)]
    return seed + ([] if each.target is None else ["--target", each.target])


def _wait(command: list[str], environment: Mapping[str, str]) -> int:
    """The exit code of a command, which ends where this process is asked to."""
    process = subprocess.Popen(command, env=environment)
    try:
        return process.wait()
    except KeyboardInterrupt:
        # A terminal has told it too; it keeps what has finished.
        with suppress(ProcessLookupError):
            process.terminate()
        process.wait()
        raise
