"""What a string does in the rows of a table: its rates and loads at the bit, as columns and as sentences above it."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from fctd.case.load import Case
from fctd.case.operations import KINDS
from fctd.case.systems import DENSITY, FLOW, FORCE, ROP, SPEED, TORQUE, Kind, System
from fctd.model.operations import PUMPING, SteadyRates, bit_loads, flow_of, rad_per_s
from fctd.results.differences import in_a_row


def does(case: Case, kind: str, rates: SteadyRates) -> dict[str, float]:
    """The columns ``DOES`` of a row, SI; of a kind, or of a measured row without a string."""
    return {
        "speed_m_s": abs(rates.speed), "rpm": _rpm(rates), "flow_m3_s": rates.flow,
        "weight_on_bit_N": bit_loads(case, kind).weight if kind in KINDS else 0.0,
    }  # fmt: skip


def facts_of(case: Case, rates: Mapping[str, SteadyRates], units: System) -> list[str]:
    """Facts of a case, a clause each: mud, loads at the bit, block, and the rates of each operation."""
    mud = _in(case.mud.density, DENSITY, units, 4) if case.mud.density else "none (air)"
    facts = ["fluids by depth"] if case.mud.given else [f"mud {mud}"]
    if any(KINDS[kind].on_bottom for kind in rates):
        facts += [f"weight on bit {_in(case.bit.weight_on_bit, FORCE, units)}"]
        if case.bit.torque:
            facts += [f"bit torque {_in(case.bit.torque, TORQUE, units)}"]
    if case.bit.overpull and any(KINDS[kind].direction < 0 for kind in rates):
        facts += [f"overpull of a stuck bit {_in(case.bit.overpull, FORCE, units)}"]
    if case.rig.block_weight:
        facts += [f"block {_in(case.rig.block_weight, FORCE, units)}"]
    return [*facts, *clauses(({"operation": kind, **does(case, kind, of)} for kind, of in rates.items()), units)]


def told_of(case: Case, rates: Mapping[str, SteadyRates], units: System) -> list[str]:
    """The lines above a table: facts of a case, and what its rows differ in."""
    return ["; ".join(facts_of(case, rates, units)), *unlike(case, rates, units)]


def clauses(rows: Iterable[Mapping[str, Any]], units: System) -> list[str]:
    """What the rows of each operation do, a clause each, with ranges where they differ.

    rows : with the columns operation and ``DOES``; those without a string do not count.
    """
    found: dict[str, list[Mapping[str, Any]]] = {}
    for row in rows:
        if row["operation"] in KINDS:
            found.setdefault(row["operation"], []).append(row)
    told = []
    for kind, of in found.items():
        along = ROP if KINDS[kind].on_bottom else SPEED
        parts = [
            _between([row[column] for row in of], *look, digits)
            for column, look, digits in (
                ("speed_m_s", along.shown(units), 3), ("rpm", (1.0, "rev/min"), 3), ("flow_m3_s", FLOW.shown(units), 4)
            )
        ]  # fmt: skip
        told.append(f"{KINDS[kind].label} {in_a_row([part for part in parts if part])}")
    return told


def _between(values: Sequence[float], factor: float, label: str, digits: int) -> str:
    """Values with their unit, nothing where all are 0."""
    low, high = (f"{end * factor:.{digits}g}" for end in (min(values), max(values)))
    return "" if high == "0" else f"{high} {label}" if low == high else f"{low} to {high} {label}"


def unlike(case: Case, rates: Mapping[str, SteadyRates], units: System) -> list[str]:
    """What the rows of one table differ in though no operation needs it, a sentence each: flow, and trips that turn.

    Also which of several flows serves operations that the case does not have.
    """
    found = []
    if len({of.flow for of in rates.values()}) > 1 and case.mud.densest > 0:
        by_flow = _grouped(rates, lambda of: of.flow)
        told = [
            f"{_in(flow, FLOW, units, 4) if flow else 'pumps stand'} in {in_a_row(kinds)}"
            for flow, kinds in by_flow.items()
        ]
        found.append(f"note: rows differ in flow, which lifts the string: {'; '.join(told)}")
    turned = {kind: of for kind, of in rates.items() if of.spin and not KINDS[kind].turns}
    for rpm, kinds in _grouped(turned, _rpm).items():
        turns = "turns" if len(kinds) == 1 else "turn"
        found.append(f"note: {in_a_row(kinds)} {turns} at {rpm:.3g} rev/min, as in the case's operations")
    named = {operation.flow for operation in case.operations if operation.flow}
    own, most = {operation.kind for operation in case.operations}, flow_of(case)
    lent = [KINDS[kind].label for kind, of in rates.items() if kind in PUMPING - own and of.flow == most]
    if len(named) > 1 and lent:
        found.append(
            f"note: the case's operations have {len(named)} flows; the largest, {_in(most, FLOW, units, 4)}, is that "
            f"of {in_a_row(lent)}"
        )
    return found


def _grouped(rates: Mapping[str, SteadyRates], by: Callable[[SteadyRates], Any]) -> dict[Any, list[str]]:
    """The words of operations by what they have in common."""
    found: dict[Any, list[str]] = {}
    for kind, of in rates.items():
        found.setdefault(by(of), []).append(KINDS[kind].label)
    return found


def _rpm(rates: SteadyRates) -> float:
    return float(f"{rates.spin / rad_per_s(1.0):.12g}")


def _in(value: float, kind: Kind, units: System, digits: int = 3) -> str:
    """An SI value with its unit."""
    factor, label = kind.shown(units)
    number = value * factor
    return f"{number:.0f} {label}" if abs(number) >= 1000 else f"{number:.{digits}g} {label}"
