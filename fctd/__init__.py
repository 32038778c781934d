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

from fctd.case import Case, load_case  # noqa: E402
from fctd.equilibrium import Equilibrium, equilibrium  # noqa: E402
from fctd.errors import InputError  # noqa: E402
from fctd.refine import Refinement, refine  # noqa: E402
from fctd.results import SimulationResult  # noqa: E402
from fctd.simulate import simulate  # noqa: E402
from fctd.torque_drag import torque_drag  # noqa: E402
from fctd.wellbore import Contacts, Wellbore, build_wellbore, find_contacts  # noqa: E402

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
