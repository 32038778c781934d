"""The unknowns of a calibration: their names, default bounds and units, and what they change in a case.

``friction``, ``friction.cased``, ``friction.open``, ``friction[k]`` (of the interval with index k), each also with
``.axial`` or ``.rotational``, along or around the hole alone;
``friction.cased.gradient``, ``friction.open.gradient`` (``gradient``);
``rig.block_weight``, ``rig.guide_friction``, ``rig.sheave_efficiency``, ``rig.torque_offset``, ``rig.torque_per_rpm``;
``mass.NAME``, the linear mass in kg/m of the components of that name in every string; ``mud.density``;
``bias.hookload.SOURCE`` and ``bias.torque.SOURCE``.
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

from fctd.calibration.gradient import gradient_of, multipliers
from fctd.calibration.setup import PriorSpec, Setup, UnknownSpec, Written
from fctd.case.errors import MISSING, InputError, join_key, nearest, show
from fctd.case.friction import KINDS, Pair, changed, pairs_of
from fctd.case.load import Case
from fctd.case.message import quantity
from fctd.case.units import DENSITY, FORCE, LINEAR_MASS, TORQUE, Dimension, Number, Quantity
from fctd.model.section import section_of


class Form(NamedTuple):
    """A kind of unknown: its dimension (None : a number), default bounds and typical size [SI]."""

    dimension: Dimension | None
    low: float
    high: float
    size: float

    def parse(self, value: Written) -> float:
        """A value with its unit, SI."""
        return (Number() if self.dimension is None else Quantity(dimension=self.dimension)).parse(value)


FRICTION: Final = Form(None, 0.0, 0.8, 0.1)
GRADIENT: Final = Form(None, -0.9, 0.9, 0.1)
RIG: Final = {
    "rig.block_weight": Form(FORCE, 0.0, 2e6, 20e3),
    "rig.guide_friction": Form(FORCE, 0.0, 100e3, 5e3),
    "rig.sheave_efficiency": Form(None, 0.7, 1.0, 0.02),
    "rig.torque_offset": Form(TORQUE, -20e3, 20e3, 500.0),
    "rig.torque_per_rpm": Form(TORQUE, 0.0, 100.0, 5.0),
}
MUD: Final = Form(DENSITY, 500.0, 2500.0, 50.0)
# Of the mass that the case has.
MASS: Final = (0.3, 3.0, 0.1)
# Bounds of a bias in standard deviations of its prior; without a prior those of the form.
BIAS: Final = {"hookload": Form(FORCE, -200e3, 200e3, 10e3), "torque": Form(TORQUE, -10e3, 10e3, 500.0)}
# Directions of a friction factor, and the keys of an interval that hold them; without one both are alike.
DIRECTIONS: Final = {"axial": "friction", "rotational": "rotational_friction"}
NAMES: Final = (
    "friction", *(f"friction.{kind}" for kind in KINDS), "friction[k]",
    *(f"friction.{kind}.{direction}" for kind in KINDS for direction in DIRECTIONS),
    *(f"friction.{kind}.gradient" for kind in KINDS), *RIG, "mass.NAME", "mud.density",
    "bias.hookload.SOURCE", "bias.torque.SOURCE",
)  # fmt: skip


class Prior(NamedTuple):
    """What is known before: mean and standard deviation [SI]."""

    mean: float
    sd: float


# Of a gradient without a prior of its own: both ends within 60 % of the middle.
NO_GRADIENT: Final = Prior(0.0, 0.3)


@dataclass(frozen=True)
class Unknown:
    """An unknown: name, bounds, first value and typical size [SI], its prior, and the unit of its values."""

    name: str
    low: float
    high: float
    start: float
    size: float
    prior: Prior | None
    unit: str

    @property
    def changes_string(self) -> bool:
        """Whether it changes the loads of the string, and not just their reading."""
        return not self.name.startswith(("rig.", "bias."))


def find_unknowns(fit: Mapping[str, UnknownSpec], setup: Setup, cases: Sequence[Case]) -> list[Unknown]:
    """The unknowns of ``fit`` and of the setup, in that order; biases of sources with a prior come last.

    Raises InputError for a name that is not an unknown, one that no case has, bounds that do not rise, a start or
    prior outside them, and two friction factors of one interval.
    """
    specs = dict(setup.unknowns)
    for name, spec in fit.items():
        given = spec.model_dump(exclude_none=True)
        specs[name] = specs.get(name, UnknownSpec()).model_copy(update={k: getattr(spec, k) for k in given})
    for source, has in setup.sources.items():
        for load in BIAS:
            bias = getattr(has, f"{load}_bias")
            name = f"bias.{load}.{source}"
            if bias is not None and name not in specs:
                specs[name] = UnknownSpec(prior=PriorSpec(mean=bias.mean, sd=bias.sd))
    if not specs:
        raise InputError("at least one unknown, such as friction.open", key="fit")
    found = []
    for name, spec in specs.items():
        try:
            found.append(_unknown(name, spec, cases))
        except InputError as error:
            unnamed = error.value is MISSING  # the name itself is wrong
            given = fit[name].model_dump(exclude_none=True) if name in fit else {}
            if name not in fit and unnamed:
                raise InputError(error.expected, key="unknowns", value=name) from None
            if not unnamed and error.key.partition(".")[0] not in given:  # a value of the setup
                raise error.at(join_key("unknowns", name)) from None
            written = name if unnamed else f"{name}, {error.key}: {show(error.value)}"
            raise InputError(error.expected, key="fit", value=written) from None
    _check_overlaps([unknown.name for unknown in found], cases)
    for name in specs:
        factor = f"friction.{gradient_of(name)}"
        apart = [direction for direction in DIRECTIONS if f"{factor}.{direction}" not in specs]
        if gradient_of(name) and factor not in specs and apart:
            lacking = factor if len(apart) == len(DIRECTIONS) else f"{factor}.{apart[0]}"
            raise InputError(f"also {lacking}, which a gradient needs", key="fit", value=name)
    return found


def _unknown(name: str, spec: UnknownSpec, cases: Sequence[Case]) -> Unknown:
    """An unknown; the InputError of a bad value has its key in the table of the unknown."""
    form, own = _form_of(name, cases)

    def parsed(value: Written, key: str) -> float:
        try:
            return form.parse(value)
        except InputError as error:
            raise error.at(key) from None

    prior = None
    if spec.prior is not None:
        prior = Prior(parsed(spec.prior.mean, "prior.mean"), parsed(spec.prior.sd, "prior.sd"))
        if not prior.sd > 0:
            raise InputError("a standard deviation above 0", key="prior.sd", value=spec.prior.sd)
    low, high = form.low, form.high
    if spec.bounds is not None:
        low, high = (parsed(end, "bounds") for end in spec.bounds)
        if not low < high or (low < form.low and not name.startswith("bias.")):
            expected = f"two bounds that rise, the lower one at least {form.low:g}"
            raise InputError(expected, key="bounds", value=list(spec.bounds))
    within = f"within the bounds, {low:g} to {high:g}"
    if prior is None and gradient_of(name):
        prior = NO_GRADIENT
    if prior is not None and not low <= prior.mean <= high:
        raise InputError(f"a mean {within}", key="prior.mean", value=prior.mean)
    start = prior.mean if prior is not None else min(max(own, low), high)
    if spec.start is not None:
        start = parsed(spec.start, "start")
        if not low <= start <= high:
            raise InputError(f"a start {within}", key="start", value=spec.start)
    unit = "" if form.dimension is None else form.dimension.unit
    return Unknown(name, low, high, start, form.size, prior, unit)


def _form_of(name: str, cases: Sequence[Case]) -> tuple[Form, float]:
    """The kind of an unknown, and the value that the first case with it has."""
    if name in RIG:
        return RIG[name], float(getattr(cases[0].rig, name.removeprefix("rig.")))
    if name == "mud.density":
        lightest = min(part.density for case in cases for part in case.string.components)
        return MUD._replace(high=min(MUD.high, 0.95 * lightest)), cases[0].mud.density
    if any(interval.kind == gradient_of(name) for case in cases for interval in case.wellbore.intervals):
        return GRADIENT, 0.0
    for load, form in BIAS.items():
        if name.startswith(f"bias.{load}.") or name == f"bias.{load}.":
            return form, 0.0
    owned = [value for case in cases for value in _own_values(name, case)]
    if name.startswith("mass.") and owned:
        low, high, share = MASS
        return Form(LINEAR_MASS, low * owned[0], high * owned[0], share * owned[0]), owned[0]
    if is_factor(name) and owned:
        _check_pair(name, cases)
        return FRICTION, sum(owned) / len(owned)
    of_kind = r"friction(\.(cased|open)(\.gradient|\.axial|\.rotational)?|\[\d+\](\.axial|\.rotational)?)"
    known = name.startswith("mass.") or re.fullmatch(of_kind, name)
    parts = sorted({part.name for case in cases for part in case.string.components})
    kinds = " and ".join(f'kind = "{kind}"' for kind in KINDS)
    expected = nearest(name, NAMES, "unknown")
    if known:
        expected = f"a component of a string ({', '.join(parts)})" if name.startswith("mass.") else (
            f"friction of intervals that the case has (those of a kind have the key {kinds})"
        )  # fmt: skip
    raise InputError(expected)


def _own_values(name: str, case: Case) -> list[float]:
    """The values of a friction factor or a mass that the case has."""
    if name.startswith("mass."):
        parts = [part for part in case.string.components if part.name == name.removeprefix("mass.")]
        return [section_of(part, 0.0).mass for part in parts]
    intervals = [case.wellbore.intervals[i] for i in intervals_of(name, case)]
    around = direction_of(name) == "rotational"
    return [interval.friction_around if around else interval.friction for interval in intervals]


def _check_pair(name: str, cases: Sequence[Case]) -> None:
    """Raise InputError where one factor would take the place of two."""
    intervals = (case.wellbore.intervals[i] for case in cases for i in intervals_of(name, case))
    if not direction_of(name) and any(one.rotational_friction is not None for one in intervals):
        raise InputError(f"{name}.axial and {name}.rotational, since the case has a rotational_friction")


def direction_of(name: str) -> str:
    """The direction of a friction factor, one of ``DIRECTIONS``, or "" for one of both."""
    last = name.rpartition(".")[2]
    return last if name.startswith("friction") and last in DIRECTIONS else ""


def is_factor(name: str) -> bool:
    """Whether an unknown is a friction factor."""
    return name.startswith("friction") and not gradient_of(name)


def intervals_of(name: str, case: Case) -> list[int]:
    """Indices of the intervals of a friction factor."""
    intervals = case.wellbore.intervals
    name = name.removesuffix(f".{direction_of(name)}")
    if name == "friction":
        return list(range(len(intervals)))
    index = re.fullmatch(r"friction\[(\d+)\]", name)
    if index:
        return [int(index[1])] if int(index[1]) < len(intervals) else []
    return [i for i, interval in enumerate(intervals) if name == f"friction.{interval.kind}"]


def keys_of(name: str, case: Case) -> list[str]:
    """The keys of the case's own file that an unknown sets; none for a bias, or for a component of another string."""
    if name.startswith(("rig.", "mud.")):
        return [name]
    if name.startswith("mass."):
        parts = enumerate(case.string.components)
        return [f"string.components[{i}].linear_mass" for i, part in parts if part.name == name.removeprefix("mass.")]
    key = DIRECTIONS.get(direction_of(name), "friction")
    return [f"wellbore.intervals[{i}].{key}" for i in intervals_of(name, case)]


def refuse_overridden(names: Iterable[str], case: Case, overrides: Mapping[str, Any]) -> None:
    """Raise InputError for an override of what an unknown sets: its calibrated value would take the place unseen."""
    for key, value in overrides.items():
        for name in names:
            held = {*keys_of(name, case), *(["friction"] if name.startswith("friction") else [])}
            if any(one == key or one.startswith((f"{key}.", f"{key}[")) for one in held):
                expected = f"a key that the posterior does not hold: it has {name} with its band; calibrate again"
                raise InputError(expected, key=key, value=value)


def refuse_edited(values: Mapping[Unknown, float], case: Case, posterior: str) -> None:
    """Raise InputError where a calibrated case has other values than its posterior, which would be taken unseen.

    values : of the unknowns [SI]; posterior : name of its file, in messages.  The case's file has six digits.
    """
    calibrated = with_values(case, {unknown.name: value for unknown, value in values.items()})
    for unknown in values:
        keys, own, expected_values = (
            keys_of(unknown.name, case),
            held(unknown.name, case),
            held(unknown.name, calibrated),
        )
        for key, has, value in zip(keys, own, expected_values, strict=False):
            if abs(has - value) > 1e-5 * abs(value) + 1e-9 * unknown.size:
                asked, given = (
                    quantity(one, unknown.unit, ".6g") if unknown.unit else f"{one:.6g}" for one in (value, has)
                )
                expected = (
                    f"{asked}, as {posterior} beside it has with its band (--posterior names another): calibrate again"
                )
                raise InputError(expected, key=key, value=given)


def held(name: str, case: Case) -> list[float]:
    """The values of a case that an unknown sets [SI], in the order of its keys (``keys_of``)."""
    if name in RIG:
        return [float(getattr(case.rig, name.removeprefix("rig.")))]
    return [case.mud.density] if name == "mud.density" else _own_values(name, case)


def check_known(unknowns: Sequence[Unknown], cases: Sequence[Case]) -> None:
    """Raise InputError for an unknown of a posterior that no case has."""
    for unknown in unknowns:
        try:
            _form_of(unknown.name, cases)
        except InputError as error:
            raise InputError(error.expected, key="unknowns", value=unknown.name) from None


def _check_overlaps(names: Iterable[str], cases: Sequence[Case]) -> None:
    """Raise InputError where two friction factors are those of one interval."""
    factors = [name for name in names if is_factor(name)]
    for case in cases:
        taken: dict[tuple[int, str], str] = {}
        for name in factors:
            for i in intervals_of(name, case):
                for direction in [direction_of(name)] if direction_of(name) else DIRECTIONS:
                    if (i, direction) in taken:
                        expected = f"one friction factor for an interval, {taken[i, direction]} or {name}"
                        raise InputError(expected, key="fit", value=name)
                    taken[i, direction] = name


def with_values(case: Case, values: Mapping[str, float]) -> Case:
    """The case with values of unknowns [SI]; biases change no case."""
    pairs = [*pairs_of(case.wellbore.intervals)]
    components = list(case.string.components)
    changes: dict[str, dict[str, Any]] = {"rig": {}, "mud": {}}
    for name, value in values.items():
        table, _, key = name.partition(".")
        if table in changes:
            changes[table][key] = value
        elif table == "mass":
            components = [
                part.model_copy(update={"linear_mass": value}) if part.name == key else part for part in components
            ]
        direction = direction_of(name)
        for i in intervals_of(name, case):
            along = pairs[i].along if direction == "rotational" else value
            pairs[i] = Pair(along, pairs[i].around if direction == "axial" else value)
    by = multipliers(case, values)
    pairs = [Pair(pair.along * more, pair.around * more) for pair, more in zip(pairs, by, strict=True)]
    intervals = changed(case.wellbore.intervals, pairs)
    return case.model_copy(
        update={
            "wellbore": case.wellbore.model_copy(update={"intervals": intervals}),
            "string": case.string.model_copy(update={"components": tuple(components)}),
            "rig": case.rig.model_copy(update=changes["rig"]),
            "mud": case.mud.model_copy(update=changes["mud"]),
        }
    )


def parse_fits(fits: Iterable[str], priors: Iterable[str] = ()) -> dict[str, UnknownSpec]:
    """Unknowns of texts such as "friction.open" or "friction.open=0.1:0.5", with priors "friction.open=0.25+-0.05".

    A prior alone makes an unknown, too.  Raises InputError for texts of another form.
    """
    specs: dict[str, UnknownSpec] = {}
    for text in fits:
        name, sign, bounds = (part.strip() for part in text.partition("="))
        ends = tuple(_number(end) for end in bounds.split(":")) if sign else ()
        if not name or (sign and len(ends) != 2):
            raise InputError("NAME or NAME=LOW:HIGH, such as friction.open=0.1:0.5", key="fit", value=text)
        specs[name] = UnknownSpec(bounds=(ends[0], ends[1]) if sign else None)
    for text in priors:
        name, sign, prior = (part.strip() for part in text.partition("="))
        parts = re.split(r"\s*(?:\+-|±)\s*", prior)
        if not sign or len(parts) != 2:
            raise InputError("NAME=MEAN+-SD, such as friction.open=0.25+-0.05", key="prior", value=text)
        spec = PriorSpec(mean=_number(parts[0]), sd=_number(parts[1]))
        specs[name] = specs.get(name, UnknownSpec()).model_copy(update={"prior": spec})
    return specs


def _number(text: str) -> Written:
    """A bare number, or a quantity with its unit as it is written."""
    try:
        return float(text)
    except ValueError:
        return text.strip()
