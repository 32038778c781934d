"""Drawn cases: each key of a case is drawn here, or stands with its reason in ``keys.ABSENT``."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

from fctd.case.load import Case, load_case
from tests.equivalence import holes, rigs, strings
from tests.equivalence.dice import Dice
from tests.equivalence.holes import Raw


@dataclass(frozen=True)
class Drawn:
    """A drawn case: its tables with bare SI numbers, as they are written; equal seeds and indices draw equal ones."""

    seed: int
    index: int
    raw: Raw

    @cached_property
    def case(self) -> Case:
        """The case of the tables."""
        return load_case(self.raw)

    @cached_property
    def depth(self) -> float:
        """The bit depth [m] that the statements look at: total depth, or one above it."""
        top, deepest = self.case.string.top_md, self.case.deepest
        share = self.dice(1).pick([1.0, 1.0, 0.8])
        return round(top + share * (deepest - top), 3) if share < 1 else deepest

    def dice(self, salt: int) -> Dice:
        """Dice of a statement's own."""
        return Dice(self.seed, self.index, salt)

    def has(self, *keys: str) -> bool:
        """Whether any of these keys, or tables, is written anywhere."""
        return bool(self._names & set(keys))

    @cached_property
    def _names(self) -> set[str]:
        return {name for key in written(self.raw) for name in key.split(".")}


def draw(seed: int, index: int) -> Drawn:
    """The case of a seed and an index."""
    dice = Dice(seed, index)
    size = dice.pick(holes.SIZES)
    stations = holes.path(dice)
    total = stations[-1][0]
    raw: Raw = {"name": f"drawn {seed}:{index}"}
    raw["wellbore"] = holes.wellbore(dice, size, stations)
    raw["string"] = strings.string(dice, size, total)
    parts = raw["string"]["components"]
    swivel = any("swivel" in part for part in parts)
    bows = any("stiffness" in part.get("centralisers", {}) for part in parts)
    raw["mud"], raw["rig"], raw["bit"] = rigs.mud(dice, total), rigs.rig(dice), rigs.bit(dice, swivel)
    raw["contact"], raw["solver"], raw["limits"] = rigs.contact(dice, bows), rigs.solver(dice), rigs.limits(dice)
    if bows and raw["wellbore"]["geometry"] == "sampled":
        for key in ("caliper", "cell"):
            raw["wellbore"].pop(key, None)
        raw["wellbore"]["geometry"] = "arcs"
    if raw["contact"].get("helical_force"):
        raw["solver"].pop("buckling", None)
    if dice.chance(0.2):
        raw["bit"]["end"] = (
            "float"
            if raw["mud"].get("float")
            else "open"
            if "packer_bore" in raw["mud"]
            else dice.pick(["open", "closed"])
        )
    rigs.sticking(dice, raw)
    raw["datum"], raw["temperature"], raw["record"] = rigs.datum(dice), rigs.temperature(dice), rigs.record(dice, total)
    shut = raw["bit"].get("end") == "closed" or any("plug" in row for row in raw["mud"].get("inside", []))
    pumped = 0.0 if shut or "packer_bore" in raw["mud"] else dice.number(0.01, 0.035)
    raw["operations"] = rigs.operations(dice, total, pumped)
    if dice.chance(0.2):
        raw["units"] = dice.pick(["si", "field"])
    return Drawn(seed, index, {key: value for key, value in raw.items() if value or value == 0})


def written(table: Any, prefix: str = "") -> set[str]:
    """The dotted keys of nested tables; those of a list of tables have no index."""
    if isinstance(table, list):
        return {key for item in table if isinstance(item, dict) for key in written(item, prefix)}
    keys = set()
    for name, value in table.items():
        key = f"{prefix}.{name}" if prefix else name
        tables = isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], dict))
        keys |= written(value, key) if tables else {key}
    return keys
