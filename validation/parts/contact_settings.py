"""Settings of the contact methods that trade error for cost, and the names of these settings in tables."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from fctd import Case, InputError, build_wellbore
from fctd.arena.method import settings_of
from references import contact
from references.contact import ContactMethod
from validation.parts.methods import TOO_SLOW
from validation.parts.wall_points import RADIUS

# Lengths of cylinders [m], facets around and distance of rings [m], cells of the sampled distance [m], ways along [m].
LENGTHS = (10.0, 5.0, 2.0, 0.5)
MESHES = ((12, 4.0), (24, 2.0), (48, 2.0), (96, 1.0))
CELLS = (0.04, 0.028, 0.02, 0.014)
DRIFTS = (2.0, 1.0, 0.25)


def is_plugin(name: str) -> bool:
    """Whether a method is of a plugin; of one of the suite rivals are not asked, whose code its studies do not read."""
    return name not in contact.METHODS and name in contact.REGISTRY.plugins()


def settings(name: str, quick: bool) -> Iterator[dict[str, Any]]:
    """Options of a method, from coarse to fine: quick, one of them.

    Of a plugin, the settings that it states; what its options are called means nothing.
    """
    method = contact.method_class(name)
    keys = method.Options.model_fields
    if is_plugin(name):
        tried = list(settings_of(method))
        yield from (tried[len(tried) // 2 :][:1] if quick else tried)
    elif "cell" in keys:
        yield from ({"cell": cell} for cell in (CELLS[:1] if quick else CELLS))
        if not quick:
            yield from ({"cell": cell, "interpolation": "linear"} for cell in CELLS[::2])
    elif "drift" in keys:
        yield from ({"drift": drift} for drift in (DRIFTS[1:2] if quick else DRIFTS))
    elif "facets" in keys:
        meshes = MESHES[1:2] if quick else MESHES[:2] if name == TOO_SLOW else MESHES
        yield from ({"facets": facets, "ring_spacing": ring} for facets, ring in meshes)
        if name == "libigl":
            yield from ({"facets": facets, "ring_spacing": ring, "smooth_normals": True} for facets, ring in meshes)
    elif "cylinder_length" in keys:
        lengths = LENGTHS[2:3] if quick else LENGTHS
        yield from ({"cylinder_length": length, "overlap": min(0.2, 0.5 * length)} for length in lengths)
    else:
        yield {}


def label(name: str, options: Mapping[str, Any]) -> str:
    """The name of a setting in tables and figures."""
    if is_plugin(name):
        return ", ".join([name, *(f"{key} {value}" for key, value in options.items())])
    if "cell" in options:
        kind = ", linear" if options.get("interpolation") == "linear" else ""
        return f"{name}, {1e3 * options['cell']:g} mm{kind}"
    if "facets" in options:
        smooth = ", smooth" if options.get("smooth_normals") else ""
        return f"{name}, {options['facets']} facets, {options['ring_spacing']:g} m{smooth}"
    lengths = [f"{options[key]:g} m" for key in ("cylinder_length", "drift") if key in options]
    others = [f"{key} {value}" for key, value in options.items() if key not in ("cylinder_length", "overlap", "drift")]
    return ", ".join([name, *lengths, *others])


def built(case: Case, names: Iterable[str], quick: bool) -> tuple[dict[str, ContactMethod], pd.DataFrame, list[str]]:
    """Methods by the label of their setting, settings that a library rejects, names that are not installed.

    A method is asked once: one from outside the suite that raises whatever it may is among those that are rejected.
    """
    hole = build_wellbore(case)
    middle = hole.at(np.array([0.5 * hole.total_depth]))[0]
    methods: dict[str, ContactMethod] = {}
    refused: list[dict[str, str]] = []
    missing: list[str] = []
    for name in names:
        try:
            if contact.installed_version(name) is None:
                missing.append(name)
                continue
        except InputError as error:  # a plugin that cannot be imported
            refused.append({"setting": name, "why": str(error)})
            continue
        for options in settings(name, quick):
            key, foreseen = label(name, options), InputError if name in contact.METHODS else Exception
            try:
                method = contact.build(name, case, **options)
                method.query(middle, np.array([RADIUS]))
            except foreseen as error:
                refused.append({"setting": key, "why": str(error) or type(error).__name__})
            else:
                methods[key] = method
    return methods, pd.DataFrame(refused, columns=["setting", "why"]), missing
