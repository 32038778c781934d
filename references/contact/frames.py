"""Frozen points with their exact contacts in four holes, for any contact method, here or elsewhere.

A hole is stored as its case, so that a method can build it; a point with the depth, normal and measured depth of its
contact.  In round holes these are exact.  In the sampled hole they are the contact of a disc with the radius of the
point that rolls around its section, as in FCTD's engine; the distance from a mesh of that wall differs by its slope.
"""

import json
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow as pa
from pyarrow import parquet

from fctd.arena.frames import SEED, case_of, frame
from fctd.case.load import Case
from fctd.store.origin import versions
from fctd.store.parquet import read_table
from fctd.store.whole_file import whole_file
from references.contact.reference_hole import hole_of

Stations = list[list[float]]  # measured depth [m], inclination [deg], azimuth [deg]
TURN: Stations = [[0, 0, 0], [200, 0, 0], [500, 60, 0], [740, 60, 55], [900, 60, 55]]
S_WELL: Stations = [[0, 0, 0], [150, 0, 0], [450, 70, 30], [650, 70, 30], [950, 5, 30], [1000, 5, 30]]
PAST_HORIZONTAL: Stations = [[0, 0, 0], [100, 0, 0], [500, 95, 350], [800, 100, 10], [1000, 88, 20]]


def holes() -> dict[str, Case]:
    """The four holes by name: a build and turn, an S, one past 90° that crosses north, and a washed-out one."""
    return {
        "build and turn": _case("build and turn", TURN, 0.3112),
        "s": _case("s", S_WELL, 0.2159),
        "past horizontal": _case("past horizontal", PAST_HORIZONTAL, 0.2159),
        "washed out": _case("washed out", S_WELL, 0.2159, washed_out=True),
    }


def frames(count: int, names: Collection[str] | None = None) -> pd.DataFrame:
    """Points of the holes named, by default all, ``count`` in each, in random order, with their exact contacts.

    Columns: hole, x_m, y_m, z_m (north, east, down), radius_m, penetration_m (negative is clearance), normal_x,
    normal_y, normal_z (from the axis to the wall), md_m.
    """
    parts = []
    for name, case in holes().items():
        if names is not None and name not in names:
            continue
        near = frame(hole_of(case)[0], count)
        hits = near.exact
        columns = np.column_stack([near.places, near.radii, hits.penetration, hits.normal, hits.md])
        parts.append(pd.DataFrame(columns, columns=NUMBERS).assign(hole=name))
    return pd.concat(parts, ignore_index=True)[["hole", *NUMBERS]]


NUMBERS = ["x_m", "y_m", "z_m", "radius_m", "penetration_m", "normal_x", "normal_y", "normal_z", "md_m"]


def write(path: Path, count: int) -> None:
    """Write ``frames`` to a Parquet file; its metadata hold the cases as JSON, by hole, and versions.

    Raises InputError where the file cannot be written.
    """
    cases = {name: case.model_dump(mode="json", exclude_none=True, exclude={"file"}) for name, case in holes().items()}
    about = {"cases": json.dumps(cases), "versions": json.dumps(versions()), "seed": str(SEED)}
    table = pa.Table.from_pandas(frames(count), preserve_index=False).replace_schema_metadata(about)
    with whole_file(path) as scratch:
        parquet.write_table(table, scratch)


def read(path: Path) -> tuple[pd.DataFrame, dict[str, Case]]:
    """The points of a file of ``write``, and the case of each hole."""
    table = read_table(path)
    cases = json.loads(table.schema.metadata[b"cases"])
    return table.to_pandas(use_threads=False), {name: Case.model_validate(raw) for name, raw in cases.items()}


def _case(name: str, stations: Stations, diameter: float, washed_out: bool = False) -> Case:
    bottom = stations[-1][0]
    hole: dict[str, Any] = {}
    if washed_out:
        md = np.arange(20.0, bottom - 20.0, 0.5)
        # An oval that turns along the hole, wider by up to 12 % every 60 m.
        wide = 1 + 0.12 * np.maximum(np.sin(2 * np.pi * md / 60), 0.0)
        turned = 2 * np.pi * md[:, None] / 300 + np.pi / 4 * np.arange(8)
        radii = 0.5 * diameter * wide[:, None] * (1 + 0.03 * np.cos(2 * turned))
        rows = np.column_stack([md, radii]).tolist()
        hole = {"geometry": "sampled", "caliper": {"rows": rows, "values": "radius"}}
    return case_of(name, stations, [(bottom, diameter)], **hole)
