"""Settings of the contact methods that trade error for cost, and the names of these settings in tables."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import pandas as pd

from fctd import Case, InputError
from references import contact
from references.contact import ContactMethod
from validation.parts.methods import TOO_SLOW

# Facets around and distance of rings [m]; cells of the sampled distance [m].
MESHES = ((12, 4.0), (24, 2.0), (48, 2.0), (96, 1.0))
CELLS = (0.04, 0.028, 0.02, 0.014)


def settings(quick: bool) -> Iterator[tuple[str, dict[str, Any]]]:
    """Every method of the suite over the settings that trade error for cost, from coarse to fine."""
    for name in contact.METHODS:
        keys = contact.method_class(name).Options.model_fields
        if "cell" in keys:
            yield from ((name, {"cell": cell}) for cell in (CELLS[:1] if quick else CELLS))
            if not quick:
                yield from ((name, {"cell": cell, "interpolation": "linear"}) for cell in CELLS[::2])
        elif "drift" in keys:
            yield from ((name, {"drift": drift}) for drift in ((1.0,) if quick else (2.0, 1.0, 0.25)))
        elif "facets" in keys:
            meshes = MESHES[1:2] if quick else MESHES[:2] if name == TOO_SLOW else MESHES
            yield from ((name, {"facets": facets, "ring_spacing": ring}) for facets, ring in meshes)
            if name == "libigl":
                smooth = {"smooth_normals": True}
                yield from ((name, {"facets": facets, "ring_spacing": ring} | smooth) for facets, ring in meshes)
        elif "cylinder_length" in keys:
            lengths = (2.0,) if quick else (10.0, 5.0, 2.0, 0.5)
            yield from ((name, {"cylinder_length": length, "overlap": min(0.2, 0.5 * length)}) for length in lengths)
        else:
            yield name, {}


def label(name: str, options: Mapping[str, Any]) -> str:
    """The name of a setting in tables and figures."""
    if "cell" in options:
        kind = ", linear" if options.get("interpolation") == "linear" else ""
        return f"{name}, {1e3 * options['cell']:g} mm{kind}"
    if "facets" in options:
        smooth = ", smooth" if options.get("smooth_normals") else ""
        return f"{name}, {options['facets']} facets, {options['ring_spacing']:g} m{smooth}"
    length = options.get("cylinder_length", options.get("drift"))
    return name if length is None else f"{name}, {length:g} m"


def built(
    asked: Iterable[tuple[str, dict[str, Any]]], case: Case
) -> tuple[dict[str, ContactMethod], pd.DataFrame, list[str]]:
    """Methods by label, settings that a library refuses with the reason, names that are not installed."""
    methods: dict[str, ContactMethod] = {}
    refused, missing = [], dict.fromkeys(name for name in contact.METHODS if contact.installed_version(name) is None)
    for name, options in asked:
        if name in missing:
            continue
        try:
            methods[label(name, options)] = contact.build(name, case, **options)
        except InputError as error:
            refused.append({"setting": label(name, options), "why": str(error)})
    return methods, pd.DataFrame(refused, columns=["setting", "why"]), list(missing)
