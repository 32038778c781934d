"""The case of each sample: a case file is read once, and samples change a copy of it."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from fctd.case.errors import InputError, set_key
from fctd.case.load import Case, apply_override, make_case, read_raw
from fctd.sweep.design import Value
from fctd.sweep.spec import SweepSpec
from fctd.sweep.survey_errors import erred


@dataclass(frozen=True)
class Template:
    """What cases of samples are made of, for a worker that has not the case file.

    raw : the tables of the case file with the sweep's fixed keys; base : the case of it, with its survey; units : of
    the parameters' numbers, by key.
    """

    spec: SweepSpec
    raw: dict[str, Any]
    base: Case
    units: dict[str, str]

    def case(self, sample: int, values: Mapping[str, Value]) -> Case:
        """The case of a sample; raises InputError for values that no case can have.

        Drawn survey errors and seeds depend on the sweep's seed and the sample's number alone.
        """
        raw = copy.deepcopy(self.raw)
        for key, value in values.items():
            set_value(raw, key, value, self.units.get(key, ""))
        draw = np.random.default_rng([self.spec.seed, sample])
        seed = int(draw.integers(2**32))
        if self.spec.tortuosity_seeds:
            set_key(raw, "wellbore.tortuosity.seed", seed)
        case = make_case(raw, None, self.base)
        if self.spec.survey is not None:
            stations = erred(case.wellbore.trajectory, self.spec.survey, draw)
            stations[:, 1:] = np.degrees(stations[:, 1:])
            for key in ("survey", "columns", "sheet", "survey_smoothing"):
                raw["wellbore"].pop(key, None)
            raw["wellbore"]["stations"] = stations.tolist()
            case = make_case(raw, None)
        return case


def set_value(raw: dict[str, Any], key: str, value: Any, unit: str) -> None:
    """Set a key of an unvalidated case; ``friction.cased`` and ``friction.open`` are factors of kinds of interval."""
    written = f"{float(value)!r} {unit}" if unit else value
    name, _, kind = key.partition(".")
    if name == "friction" and kind:
        apply_override(raw, name, {kind: written})
    else:
        apply_override(raw, key, written)


def template_of(spec: SweepSpec) -> Template:
    """The template of a sweep; raises InputError for a case file or fixed keys that cannot be used."""
    try:
        raw = read_raw(spec.case)
        for key, value in spec.set.items():
            set_value(raw, key, value, "")
        base = make_case(raw, spec.case.parent.absolute()).model_copy(update={"file": spec.case})
    except InputError as error:
        raise error.in_file(spec.case) from error.__cause__
    if base.wellbore.survey is not None:
        raw["wellbore"]["survey"] = base.wellbore.survey
    return Template(spec, raw, base, {parameter.key: parameter.unit for parameter in spec.parameters})
