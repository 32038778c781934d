"""What a table knows of itself: units, case, warnings and version, as JSON in the ``attrs`` of its DataFrame."""

from collections.abc import Hashable, Mapping, Sequence
from typing import Any

from fctd.case.doubts import warnings_of
from fctd.case.friction import FrictionSet
from fctd.case.load import Case
from fctd.case.units import FLOW, ROTATION, SPEED, argument
from fctd.results.unit_systems import System
from fctd.store.origin import __version__

_DIMENSIONS = {"speed": SPEED, "rpm": ROTATION, "flow": FLOW}


def attrs_of(
    case: Case,
    kinds: Sequence[str],
    drive: Mapping[str, float | str | None],
    frictions: Sequence[FrictionSet] = (),
    units: System = "si",
) -> dict[Hashable | None, Any]:
    """The ``attrs`` of a table of steady strings, which Parquet files keep: JSON alone.

    units : of its columns; case : name and ``Case.digest``; warnings : probable mistakes of the case and of what was
    asked for, see ``InputWarning``; version : of this program.  kinds, drive, frictions : operations, their speed, rpm
    and flow where they are given, and the sets of friction factors.
    """
    rates: dict[str, Any] = {
        name: None if of is None else argument(of, _DIMENSIONS[name], name) for name, of in drive.items()
    }
    warnings = warnings_of(case, kinds, **rates, frictions=frictions)
    return {
        "units": units,
        "case": {"name": case.name, "digest": case.digest},
        "warnings": [warning.as_metadata() for warning in warnings],
        "version": __version__,
    }
