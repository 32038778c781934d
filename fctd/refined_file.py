"""A refined case as a file: the user's own, comments and units kept, with the new string and hole."""

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import tomlkit

from fctd.case import LARGEST_FILE, apply_override, load_case
from fctd.errors import look_up, split_key
from fctd.input_file import read_text
from fctd.refine import Refinement
from fctd.specs import ComponentSpec
from fctd.whole_file import whole_file

# What a cut decides of a component, and what it moves; all else stays as the user wrote it.
CUT = ("length", "segments", "segment_length")
BEND = ("bend", "toolface")


def write_refined(refined: Refinement, source: Path, overrides: Mapping[str, Any], out: Path) -> None:
    """Write the case file ``source``, changed by ``overrides``, with the string and the hole of a refinement."""
    raw: Any = tomlkit.parse(read_text(source, LARGEST_FILE))
    for key, value in overrides.items():
        if value is None:
            *parents, last = split_key(key)
            place: Any = look_up(raw, *parents)
            with suppress(KeyError, IndexError, TypeError):  # there is nothing to delete
                del place[last]
        else:
            apply_override(raw, key, value)
    raw["string"]["components"] = _components(raw["string"]["components"], refined.case.string.components)
    hole = refined.case.wellbore
    if hole.geometry == "cylinders":
        sizes = {key: getattr(hole, key) for key in ("chord_tolerance", "cylinder_length", "overlap")}
        given = load_case(source, overrides).wellbore
        for key, size in sizes.items():
            if size is not None and size != getattr(given, key):
                raw["wellbore"][key] = _metres(size)
                said = raw["wellbore"].item(key).trivia
                said.comment = said.comment_ws = ""  # of the value before
    if hole.survey is not None:
        raw["wellbore"]["survey"] = os.path.relpath(hole.survey, out.absolute().parent)
    with whole_file(out) as scratch:
        scratch.write_text(_heading(refined) + tomlkit.dumps(raw), encoding="utf-8")


def _components(written: Sequence[Mapping[str, Any]], pieces: Sequence[ComponentSpec]) -> Any:
    """The tables of the pieces, each with the keys of the component it was cut from."""
    tables = tomlkit.aot()
    left = list(pieces)
    for component in written:
        whole = ComponentSpec.model_validate(component)
        beyond = whole.length or float("inf")
        while left and beyond > 1e-6:
            piece = left.pop(0)
            beyond -= piece.length or float("inf")
            table = tomlkit.table()
            at_end = beyond <= 1e-6
            for key, value in component.items():
                if key not in CUT and (at_end or key not in BEND):
                    table[key] = value
            for key in CUT:
                value = getattr(piece, key)
                if value is not None:
                    table[key] = value if key == "segments" else _metres(value)
            tables.append(table)
    tables[-1].add(tomlkit.nl())
    return tables


def _metres(value: float) -> str:
    return f"{value:.10g} m"


def _heading(refined: Refinement) -> str:
    """What the file is, for whoever opens it next."""
    return (
        f"# Cut by fctd refine for {', '.join(refined.operations)} with the bit at {refined.bit_depth:g} m: "
        f"{refined.segments} {refined.layout} segments,\n"
        f"# an estimated error of {100 * refined.error:.2g} % in hook load and torque "
        f"(tolerance {100 * refined.tolerance:g} %).  Lengths count from the bit upwards.\n"
    )
