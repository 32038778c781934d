"""A refined case as a file: the user's file with its comments and units, and the new string and hole."""

import os
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import tomlkit

from fctd.case.errors import InputError
from fctd.case.input_file import LARGEST_FILE, read_text
from fctd.case.load import Case, load_case
from fctd.case.named_items import by_index
from fctd.case.raw_case import apply_override, look_up, split_key
from fctd.case.string import ComponentSpec
from fctd.case.text import is_utf8
from fctd.steady.refine import Refinement
from fctd.store.whole_file import whole_file

# Keys that a cut replaces, and keys that only a component's uppermost piece keeps; all others stay as written.
CUT = ("length", "segments", "segment_length")
BEND = ("bend", "toolface")


def survey_from(out: Path, case: Case) -> str | None:
    """Path of the case's survey relative to the folder of the file ``out``, None without a survey.

    Raises InputError for a path that is not UTF-8, which TOML requires.
    """
    if case.wellbore.survey is None:
        return None
    path = os.path.relpath(case.wellbore.survey, out.absolute().parent)
    if not is_utf8(path):
        expected = "a file in the folder of the survey, since the survey's path from elsewhere is not UTF-8"
        raise InputError(expected, key="--out", value=out)
    return path


def changed_document(source: Path, overrides: Mapping[str, Any]) -> Any:
    """The case file ``source`` with its comments and units, changed by ``overrides``, as a document of tomlkit."""
    raw: Any = tomlkit.parse(read_text(source, LARGEST_FILE, "a case file"))
    for key, value in overrides.items():
        if value is None:
            *parents, last = split_key(by_index(raw, key))
            place: Any = look_up(raw, *parents)
            with suppress(KeyError, IndexError, TypeError):  # the file lacks the key
                del place[last]
        else:
            apply_override(raw, key, value)
    return raw


def write_refined(refined: Refinement, source: Path, overrides: Mapping[str, Any], out: Path) -> list[Path]:
    """Write the case file ``source``, changed by ``overrides``, with the string and the hole of a refinement.

    Returns the file.
    """
    raw = changed_document(source, overrides)
    raw["string"]["components"] = _components(raw["string"]["components"], refined.case.string.components)
    hole = refined.case.wellbore
    if hole.geometry == "cylinders":
        sizes = {key: getattr(hole, key) for key in ("chord_tolerance", "cylinder_length", "overlap")}
        given = load_case(source, overrides).wellbore
        for key, size in sizes.items():
            if size is not None and size != getattr(given, key):
                raw["wellbore"][key] = _metres(size)
                note = raw["wellbore"].item(key).trivia
                note.comment = note.comment_ws = ""  # it described the value before
    if refined.resolved:
        apply_override(raw, "solver.buckling", "resolve")
    survey = survey_from(out, refined.case)
    if survey is not None:
        raw["wellbore"]["survey"] = survey
    with whole_file(out) as scratch:
        scratch.write_text(_heading(refined) + tomlkit.dumps(raw), encoding="utf-8")
    return [out]


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
            if ComponentSpec.model_validate(table).contact != piece.contact:
                table["contact"] = piece.contact  # a piece of a sleeve may be as short as a point
            tables.append(table)
    tables[-1].add(tomlkit.nl())
    return tables


def _metres(value: float) -> str:
    return f"{value:.10g} m"


def _heading(refined: Refinement) -> str:
    """The comment at the head of the file: how it was made."""
    return (
        f"# Cut by fctd refine for {', '.join(refined.operations)} with the bit at {refined.bit_depth:g} m: "
        f"{refined.segments} {refined.layout} segments,\n"
        f"# an estimated error of {100 * refined.error:.2g} % in hook load and torque "
        f"(tolerance {100 * refined.tolerance:g} %).  Lengths count from the bit upwards.\n"
    )
