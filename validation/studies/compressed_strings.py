"""Straight strings that are pressed: no balance that a string would leave is converged, on any mesh alike."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from validation.harness.study import Check, Context, Outcome, Study
from validation.parts.compressed import Drawn, Found, drawn, on_mesh, solved

SEED = 17
STRINGS, QUICK = 500, 4
MESHES = ("own", "halved", "split")
MODES = ("detect", "resolve")
SAME = 0.01  # of the weight: hook loads that are one
NEAR = 0.03  # of the load: an onset so near may lie between two meshes
BEYOND = 1.05  # loads over the sinusoidal limit from which on a string counts as above it


def row_of(index: int, string: Drawn, mesh: str, buckling: str, found: Found) -> dict[str, Any]:
    """A row of the table."""
    point, hole = found.point, string.case["wellbore"]
    return {
        "string": index, "inclination_deg": hole["stations"][0][1], "friction": hole["intervals"][0]["friction"],
        "load_over_limit": string.over_limit, "weight_kN": string.weight / 1e3, "mesh": mesh, "buckling": buckling,
        "segments": len(point._shape.joints), "status": str(point.status), "shape": point.shape,
        "contact_force_kN": point.total_contact_force / 1e3, "hookload_kN": point.hookload / 1e3,
        "unstable_modes": found.modes, "iterations": point.iterations, "reason": point.message,
    }  # fmt: skip


def rows_of(index: int) -> Iterator[dict[str, Any]]:
    """The rows of the string of an index."""
    string = drawn(SEED, index)
    for buckling in MODES:
        for mesh in MESHES:
            yield row_of(index, string, mesh, buckling, solved(on_mesh(string, mesh, buckling)))


def near_onset(index: int) -> bool:
    """Whether a little less or more load gives the string of an index another status or shape."""
    string = drawn(SEED, index)
    points = [solved(on_mesh(string, "own", "resolve", share)).point for share in (1 - NEAR, 1.0, 1 + NEAR)]
    return len({(point.status, point.shape) for point in points}) > 1


def compared(rows: pd.DataFrame) -> pd.DataFrame:
    """The resolved rows of each string on its own mesh and on another: whether they are alike."""
    resolved = rows[rows["buckling"] == "resolve"]
    own = resolved[resolved["mesh"] == "own"].set_index("string")
    tables = []
    for mesh in MESHES[1:]:
        other = resolved[resolved["mesh"] == mesh].set_index("string")
        off = (other["hookload_kN"] - own["hookload_kN"]).abs() / own["weight_kN"]
        tables.append(
            pd.DataFrame(
                {
                    "string": own.index, "mesh": mesh, "status": own["status"], "other_status": other["status"],
                    "shape": own["shape"], "other_shape": other["shape"], "off_percent_of_weight": 100 * off,
                    "alike": (own["status"] == other["status"]) & ~(off > SAME),
                }
            )
        )  # fmt: skip
    return pd.concat(tables, ignore_index=True)


def run(context: Context) -> Outcome:
    """Every string on its meshes, with its own segments and resolved."""
    indices = range(QUICK if context.quick else STRINGS)
    rows = pd.DataFrame([row for index in context.progress(indices, "strings") for row in rows_of(index)])
    pairs = compared(rows)
    unlike = sorted(set(pairs.loc[~pairs["alike"], "string"]))
    near = [index for index in context.progress(unlike, "onsets") if near_onset(index)]
    pairs["near_onset"] = pairs["string"].isin(near)
    counts = pd.crosstab([rows["buckling"], rows["mesh"]], rows["status"]).reset_index()
    resolved = rows[rows["buckling"] == "resolve"]
    above = resolved[resolved["load_over_limit"] > BEYOND]
    buckled = (above["shape"] != "none") & np.isfinite(above["hookload_kN"])
    left = (rows["status"] == "converged") & (rows["unstable_modes"] != 0)
    return Outcome(
        tables={"rows": rows, "counts": counts, "pairs": pairs},
        checks=[
            Check("converged rows with a negative pivot", float(left.sum()), 0, "at_most", "",
                  "a balance that the string would leave"),
            Check("resolved rows alike on two meshes", 100 * float(pairs["alike"].mean()), 99.0, "at_least", "%",
                  f"status, and hook load within {100 * SAME:g} % of the weight"),
            Check("rows that differ farther from an onset", float((~pairs["alike"] & ~pairs["near_onset"]).sum()), 0,
                  "at_most", "", f"no other status or shape within {100 * NEAR:g} % of the load"),
            Check("strings beyond the limit in a buckled shape with loads", 100 * float(buckled.mean()), 95.0,
                  "at_least", "%", f"resolved, from {BEYOND:g} times the sinusoidal limit on"),
        ],
        notes=[
            "Pipe of eight sizes slides down straight holes, a quarter of them vertical, pressed with 0.4 to 2.6 times "
            "its sinusoidal limit, a fifth without friction. Each string is solved on its own segments, on their "
            "halves, and as two like components, with these segments and resolved.",
            "A turning string is not among them: in vertical hole friction rolls it round the hole once it is buckled.",
        ],
        display={"counts": "Rows by mesh and status"},
    )  # fmt: skip


STUDY = Study(
    "compressed_strings", "Is a string that is pressed beyond its onset buckled, on whichever mesh it is solved?", run
)
