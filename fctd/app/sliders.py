"""The sliders of the page: what each one changes in a case, its range, and the unit in which it is shown."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import ceil, isfinite
from typing import Any, Final

import numpy as np

from fctd.case import systems
from fctd.case.errors import MISSING, InputError
from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.raw_case import scaled_static
from fctd.case.systems import Kind, System
from fctd.hydraulics.channel import has_flow_curve
from fctd.model.drillstring import lay_out
from fctd.model.layouts import is_cut
from fctd.model.operations import flow_of, steady_rates

RPM: Final = "rpm"
FLOW: Final = "flow"
# Kind, step and usual ends [shown] in the two systems.
SCALES: Final[dict[str, tuple[Kind | None, Sequence[float], Sequence[float]]]] = {
    "friction": (None, (0.01, 0.0, 0.6), (0.01, 0.0, 0.6)),
    "mud": (systems.DENSITY, (10.0, 800.0, 2200.0), (0.1, 7.0, 18.0)),
    "wob": (systems.FORCE, (5.0, 0.0, 300.0), (1.0, 0.0, 70.0)),
    "bit_torque": (systems.TORQUE, (0.5, 0.0, 30.0), (0.5, 0.0, 22.0)),
    RPM: (systems.ROTATION, (5.0, 5.0, 240.0), (5.0, 5.0, 240.0)),
    FLOW: (systems.FLOW, (50.0, 0.0, 4000.0), (10.0, 0.0, 1100.0)),
    "segment": (systems.LENGTH, (1.0, 5.0, 60.0), (2.0, 16.0, 200.0)),
}
KIND_LABELS: Final = {"cased": "friction, cased", "open": "friction, open hole", None: "friction"}


@dataclass(frozen=True)
class Slider:
    """A slider; low, high, step and value [unit]; factor : of a shown value to SI; value : that of the case."""

    name: str
    label: str
    unit: str
    low: float
    high: float
    step: float
    value: float
    factor: float = 1.0

    def check(self, value: object) -> float:
        """A value that the page has sent [unit]; raises InputError for one beyond the ends."""
        number = float(value) if isinstance(value, int | float) and not isinstance(value, bool) else float("nan")
        if not (isfinite(number) and self.low <= number <= self.high):
            raise InputError(f"a number from {self.low:g} to {self.high:g}", key=self.name, value=value)
        return number


def sliders_of(case: Case, units: System) -> list[Slider]:
    """The sliders of a case, at its own values."""
    found = []
    for kind in dict.fromkeys(interval.kind for interval in case.wellbore.intervals):
        same = [interval for interval in case.wellbore.intervals if interval.kind == kind]
        label = KIND_LABELS[kind] if kind or _lacks_kinds(case) else "friction, elsewhere"
        pairs = [interval for interval in same if interval.rotational_friction is not None]
        along = label.replace("friction", "friction along", 1) if pairs else label
        found.append(_slider(f"friction_{kind}", along, "friction", same[0].friction, units))
        if pairs:
            around = label.replace("friction", "friction around", 1)
            found.append(_slider(f"rotational_{kind}", around, "friction", pairs[0].friction_around, units))
    turning = [operation.rpm for operation in case.operations if KINDS[operation.kind].turns]
    rpm = float(turning[0] if turning else KINDS["rotate_off_bottom"].default_rpm)
    length = float(f"{_segment_length(case):.3g}")
    of_flow = [(FLOW, "flow of the pumps", flow_of(case))] if has_flow_curve(case) else []
    of_mud = [] if case.mud.inside and case.mud.outside else [("mud", "mud density", case.mud.density)]
    for name, label, value in (
        *of_mud,
        ("wob", "weight on bit", case.bit.weight_on_bit),
        ("bit_torque", "bit torque", case.bit.torque),
        (RPM, "rotation", rpm),
        *of_flow,
        ("segment", "segment length", length),
    ):
        found.append(_slider(name, label, name, value, units))
    return found


def changes(
    case: Case, raw: Mapping[str, Any], sliders: Sequence[Slider], values: Mapping[str, object]
) -> dict[str, Any]:
    """Values of dotted keys of a case for sliders that have been moved, in the units of a case file; None drops a key.

    raw : the case as it is written; values : by the names of the sliders [shown units].  Raises InputError for a value
    beyond a slider's ends.
    """
    by_name, found = {slider.name: slider for slider in sliders}, dict[str, Any]()
    for name, given in values.items():
        if name not in by_name:
            continue
        slider = by_name[name]
        value = slider.check(given) * slider.factor
        value = float(f"{value:.10g}")
        if name.startswith("friction_"):
            for i, interval in enumerate(case.wellbore.intervals):
                if f"friction_{interval.kind}" == name:
                    static = scaled_static(raw["wellbore"]["intervals"][i], value)
                    found[f"wellbore.intervals[{i}].friction"] = value
                    if static is not MISSING:
                        found[f"wellbore.intervals[{i}].static_friction"] = static
        elif name.startswith("rotational_"):
            for i, interval in enumerate(case.wellbore.intervals):
                if f"rotational_{interval.kind}" == name and interval.rotational_friction is not None:
                    found[f"wellbore.intervals[{i}].rotational_friction"] = value
        elif name == RPM:
            for i, operation in enumerate(case.operations):
                if KINDS[operation.kind].turns:
                    found[f"operations[{i}].rpm"] = value
        elif name == FLOW:
            found |= {f"operations[{i}].flow": value for i in range(len(case.operations))}
        elif name == "segment":
            for i, part in enumerate(case.string.components):
                if is_cut(part):
                    found[f"string.components[{i}].segments"] = None
                    found[f"string.components[{i}].segment_length"] = value
        else:
            found[{"mud": "mud.density", "wob": "bit.weight_on_bit", "bit_torque": "bit.torque"}[name]] = value
    return found


def rates_at(case: Case, rpm: float, flow: float | None = None) -> Case:
    """The case with operations of all kinds, those that turn at a rotation [rev/min], for steady strings alone.

    flow : of the pumps in all of them [m³/s], None for that of the case in those that pump it.
    """
    here = {operation.kind for operation in case.operations}
    more: Any = tuple(
        kind.model_construct(
            kind=name, rpm=rpm if kind.turns else kind.default_rpm, speed=kind.default_speed,
            flow=steady_rates(case, name).flow if flow is None else flow,
        )
        for name, kind in KINDS.items()
        if name not in here
    )  # fmt: skip
    return case.model_copy(update={"operations": (*case.operations, *more)})


def _slider(name: str, label: str, scale: str, value: float, units: System) -> Slider:
    kind, *of = SCALES[scale]
    step, low, high = of[systems.SYSTEMS.index(units)]
    factor, unit = (1.0, "") if kind is None else (kind.si(units), kind.label(units))
    shown = float(f"{value / factor:.6g}")
    high = max(high, ceil(1.5 * shown / step) * step)
    return Slider(name, label, unit, min(low, shown), high, step, shown, factor)


def _lacks_kinds(case: Case) -> bool:
    return all(interval.kind is None for interval in case.wellbore.intervals)


def _segment_length(case: Case) -> float:
    """Mean length [m] of the segments below a long one, with the bit where operations, hole or string end.

    Those of components that resolve their joints, which the slider leaves alone, do not count where there are others.
    """
    deepest = max((operation.end_md for operation in case.operations), default=case.deepest)
    string = lay_out(case, deepest)
    lengths = string.length[1:] if string.long_segment and string.segments > 1 else string.length
    cut = np.array([is_cut(case.string.components[k]) for k in string.origin[-len(lengths) :]])
    return float(lengths[cut].mean() if cut.any() else lengths.mean())
