"""FCTD: fast contact torque and drag of a stiff drill string in a borehole.

    case = fctd.load_case("well.toml")
    result = fctd.simulate(case)
    point = fctd.equilibrium(case, operation="trip_out", bit_depth=2450)
    chart = fctd.torque_drag(case, operation=["trip_in", "trip_out"], bit_depths=range(1750, 2451, 10))
    finer = fctd.refine(case, tolerance=0.01).case

Units are SI; x is north, y east, z down.
"""

import atexit
import hashlib
import os
import tempfile
import warnings
from pathlib import Path

from fctd.interrupts import ends_program

with ends_program():
    import numba


def _cache_folder() -> str:
    """A compile cache for exactly these sources, or the one that NUMBA_CACHE_DIR names.

    numba does not notice an edit in a function that a cached function calls, so the folder carries a hash
    of all of them.  Where neither can be written, as in a container without a home, code is kept for this run.
    """
    digest = hashlib.sha256()
    for source in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(source.name.encode() + source.read_bytes())
    try:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
        folder = Path(os.environ.get("NUMBA_CACHE_DIR") or base / "fctd" / digest.hexdigest()[:16])
        folder.mkdir(parents=True, exist_ok=True)
        if os.access(folder, os.W_OK):
            return str(folder)
    except (OSError, RuntimeError):  # RuntimeError: there is no home
        pass
    scratch = tempfile.TemporaryDirectory(prefix="fctd-")
    atexit.register(scratch.cleanup)
    text = "no cache folder can be written, so that all is compiled anew each time: let XDG_CACHE_HOME name one"
    warnings.warn(text, RuntimeWarning, stacklevel=2)
    return scratch.name


os.environ["NUMBA_CACHE_DIR"] = _cache_folder()
# numba reads the environment when it is imported, which may have been before this package.
setattr(numba.config, "CACHE_DIR", os.environ["NUMBA_CACHE_DIR"])  # noqa: B010 (made at run time)

with ends_program():
    from fctd.case import Case, load_case
    from fctd.equilibrium import Equilibrium, equilibrium
    from fctd.errors import InputError
    from fctd.refine import Refinement, refine
    from fctd.results import SimulationResult, open_result
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
    "open_result",
    "refine",
    "simulate",
    "torque_drag",
]
