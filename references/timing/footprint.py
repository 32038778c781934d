"""Memory and time for building a contact method, measured in a separate process."""

import json
import subprocess
import sys
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.store.limits import resident_memory
from references.contact import build


def footprint(name: str, case: Case, **options: Any) -> tuple[float, float]:
    """Growth of resident memory [MB] and time [s] of building a method for a case, without imports.

    Raises InputError as ``build`` does.
    """
    build(name, case, **options)  # raises errors here, not in the other process
    return measured_apart(name, case, options)


def measured_apart(name: str, case: Case, options: Mapping[str, Any]) -> tuple[float, float]:
    """The same of a method that is known to be built; CalledProcessError where the other process cannot build it."""
    request = json.dumps({"name": name, "case": case.model_dump(mode="json"), "options": dict(options)})
    done = subprocess.run(
        [sys.executable, "-m", "references.timing.footprint"],
        input=request, capture_output=True, text=True, check=True, cwd=Path(__file__).parents[2],
    )  # fmt: skip
    memory, seconds = json.loads(done.stdout.splitlines()[-1])
    return float(memory), float(seconds)


def resident() -> float:
    """Resident memory of this process [MB]."""
    return resident_memory() / 2**20


def peak() -> float:
    """The largest resident memory of this process since its program began [MB]; nan on systems without /proc.

    ``ru_maxrss`` would count that of the process which started it.
    """
    status = Path("/proc/self/status")
    if not status.exists():
        return float("nan")
    (line,) = (line for line in status.read_text().splitlines() if line.startswith("VmHWM"))
    return int(line.split()[1]) / 1024


def _measure() -> None:
    """Build once for a short straight hole, which imports and compiles everything, then measure."""
    request = json.load(sys.stdin)
    case = Case.model_validate(request["case"])
    short = case.model_copy(
        update={
            "wellbore": case.wellbore.model_copy(
                update={"survey": None, "stations": ((0.0, 0.0, 0.0), (30.0, 0.0, 0.0))}
            )
        }
    )
    small = build(request["name"], short)
    before, began = resident(), time.perf_counter()
    method = build(request["name"], case, **request["options"])
    seconds = time.perf_counter() - began
    print(json.dumps([resident() - before, seconds]))
    del small, method


if __name__ == "__main__":
    try:
        _measure()
    except InputError as error:
        sys.exit(str(error))
