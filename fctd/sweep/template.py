"""The case of each sample: a case file is read once, and samples change a copy of it."""

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from fctd.case.errors import InputError
from fctd.case.load import Case, make_case, read_raw
from fctd.case.named_items import by_index
from fctd.case.raw_case import FRICTION, apply_override, interval_kinds, set_key, split_key
from fctd.sweep.design import Sample, Value
from fctd.sweep.spec import SweepSpec
from fctd.sweep.survey_errors import erred

ROTATIONAL: Final = FRICTION[1]


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

        Drawn survey errors and seeds depend on the sweep's seed and the sample's number alone, see ``draw_of``.
        """
        raw = copy.deepcopy(self.raw)
        fixed = {key: value for key, value in self.spec.set.items() if ROTATIONAL in key}
        for key, value in in_order(fixed | dict(values)):
            set_value(raw, key, value, self.units.get(key, ""))
        draw = np.random.default_rng([self.spec.seed, draw_of(self.spec, sample)])
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


def in_order(values: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Keys and values as they are set: a factor sets both directions, and that around the hole comes after it."""
    return sorted(values.items(), key=lambda item: ROTATIONAL in item[0])


def draw_of(spec: SweepSpec, sample: int) -> int:
    """Number of the draw of survey errors and waves that a sample has: its own, or one that others of its design share.

    Sobol's and Morris's indices compare samples that differ in one parameter; survey and waves must be the same in
    them, or their spread would count as influence of that parameter.  A block of Saltelli's design has two draws, as
    it has two of the parameters: the last sample's, and that of all others.
    """
    count = len(spec.parameters)
    if spec.method == "saltelli":
        block, place = divmod(sample, count + 2)
        return 2 * block + (place == count + 1)
    return sample // (count + 1) if spec.method == "morris" else sample


def _base(spec: SweepSpec, raw: dict[str, Any], first: Sample) -> Case:
    """The sweep's case: as it stands, or with the values of its first sample, where a parameter has a key it needs."""
    folder = (spec.case.parent if isinstance(spec.case, Path) else Path()).absolute()
    try:
        return make_case(raw, folder)
    except InputError:
        filled = copy.deepcopy(raw)
        units = {parameter.key: parameter.unit for parameter in spec.parameters}
        for key, value in in_order(first.by_key):
            set_value(filled, key, value, units[key])
        try:
            return make_case(filled, folder)
        except InputError:
            pass  # the fault is the case's own
        raise


def _check_apart(spec: SweepSpec, raw: Mapping[str, Any]) -> None:
    """Raise InputError for a parameter that sets a number of the case which another one sets too."""
    taken: dict[tuple[str | int, ...], str] = {}
    kinds = interval_kinds(raw)
    for i, parameter in enumerate(spec.parameters):
        name, _, kind = parameter.key.partition(".")
        places = [tuple(split_key(by_index(raw, parameter.key)))]
        if name in FRICTION:
            places = [("wellbore", "intervals", k, name) for k, other in enumerate(kinds) if kind in ("", other)]
        for place in places:
            if (other := taken.setdefault(place, parameter.key)) != parameter.key:
                expected = f"a key of other numbers than those of the parameter {other}, which has some of them too"
                raise InputError(expected, key=f"parameters[{i}].key", value=parameter.key)


def set_value(raw: dict[str, Any], key: str, value: Any, unit: str) -> None:
    """Set a key of an unvalidated case."""
    # A text has its unit: that of a dataset which an earlier version began.
    apply_override(raw, key, f"{float(value)!r} {unit}" if unit and not isinstance(value, str) else value)


def template_of(spec: SweepSpec, first: Sample) -> Template:
    """The template of a sweep and its first sample.

    Raises InputError for a case file or fixed keys that cannot be used; it names the case's file where the fault is
    there.
    """
    file = None if isinstance(spec.case, dict) else spec.case
    try:
        raw = copy.deepcopy(spec.case) if isinstance(spec.case, dict) else read_raw(spec.case)
        for key, value in in_order(spec.set):
            set_value(raw, key, value, "")
        base = _base(spec, raw, first).model_copy(update={"file": file})
    except InputError as error:
        for fault in (error, *error.more):
            if fault.key in spec.set:
                raise InputError(fault.expected, key=f"set.{fault.key}", value=fault.value) from error.__cause__
        if isinstance(error.__cause__, OSError):
            raise InputError(error.expected, key="case", value=spec.case) from error.__cause__
        raise (error.at("case") if file is None else error.in_file(file)) from error.__cause__
    _check_apart(spec, raw)
    if base.wellbore.survey is not None:
        raw["wellbore"]["survey"] = base.wellbore.survey
    return Template(spec, raw, base, {parameter.key: parameter.unit for parameter in spec.parameters})
