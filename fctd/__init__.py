"""FCTD: fast contact torque and drag of a stiff drill string in a borehole.

    case = fctd.load_case("well.toml")
    result = fctd.simulate(case)
    point = fctd.equilibrium(case, operation="trip_out", bit_depth=2450)
    chart = fctd.torque_drag(case, operation=["trip_in", "trip_out"], bit_depths=range(1750, 2451, 10))
    finer = fctd.refine(case, tolerance=0.01).case

Units are SI; x is north, y east, z down.
"""

import hashlib
import os
from pathlib import Path

from fctd.interrupts import ends_program

with ends_program():
    import numba


def _cache_folder() -> Path:
    """A compile cache for exactly these sources.

    numba does not notice an edit in a function that a cached function calls, so the folder carries a hash
    of all of them.
    """
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode() + source.read_bytes())
    base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "fctd" / digest.hexdigest()[:16]


os.environ.setdefault("NUMBA_CACHE_DIR", str(_cache_folder()))
# numba reads the environment when it is imported, which may have been before this package.
setattr(numba.config, "CACHE_DIR", os.environ["NUMBA_CACHE_DIR"])  # noqa: B010 (made at run time)

with ends_program():
    from fctd.case import Case, load_case
    from fctd.equilibrium import Equilibrium, equilibrium
    from fctd.errors import InputError
    from fctd.refine import Refinement, refine
    from fctd.results import SimulationResult
    from fctd.simulate import simulate
    from fctd.torque_drag import torque_drag
    from fctd.wellbore import Contacts, Wellbore, build_wellbore, find_contacts

__all__ = [
    "Case",
    "Contacts",
    "Equilibrium",
    "InputError",
    "Refinement",
    "SimulationResult",
    "Wellbore",
    "build_wellbore",
    "equilibrium",
    "find_contacts",
    "load_case",
    "refine",
    "simulate",
    "torque_drag",
]
