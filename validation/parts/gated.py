"""The gate before any speed (``references/engines/gate.py``) in the tables of studies: numbers, column and checks."""

from collections.abc import Collection, Mapping
from typing import Any

import pandas as pd

from references import engines
from references.engines import gate
from references.engines.gate import Rule
from validation.harness.study import Check

Gates = dict[str, list[Rule]]  # by the name of an engine in tables
CAPTION = "The gate before any speed: what every engine has to do before its time means anything"
NOTE = (
    "A time is struck through where its engine failed the gate; column gate says how. It is kept, since a user who has "
    "to take that engine wants to know it."
)


def examined(configurations: Mapping[str, tuple[str, dict[str, Any]]]) -> Gates:
    """The rules of each configuration: its name in tables, and engine and options."""
    return {name: gate.examine(engines.build(key, **options)) for name, (key, options) in configurations.items()}


def held(
    tables: dict[str, pd.DataFrame],
    configurations: Mapping[str, tuple[str, dict[str, Any]]],
    free: Collection[str] = (),
) -> tuple[dict[str, pd.DataFrame], Gates]:
    """Tables of engines, those with real-time factors with the gate's verdict, and the rules as a table ``gate``.

    configurations : of ``examined``; those that no such table names are left out.  free : tables of freely hanging
    strings, to whose times the rules of the wall do not apply.  Raises ValueError where no table has such a column.
    """
    timed = {key for key, table in tables.items() if "real_time_factor" in table}
    if not timed:
        raise ValueError(f"the gate judges columns real_time_factor; none is in the tables {sorted(tables)}")
    named = {name for key in timed for name in tables[key]["engine"]}
    gates = examined({name: each for name, each in configurations.items() if name in named})
    judged = {}
    for key in timed:
        verdicts = {name: gate.verdict(rules, touching=key not in free) for name, rules in gates.items()}
        judged[key] = tables[key].assign(gate=tables[key]["engine"].map(verdicts).fillna("not tried"))
    return tables | judged | {"gate": gate.table(gates)}, gates


def checks(gates: Gates) -> list[Check]:
    """A check for each engine."""
    return [
        Check(f"{name}: rules of the gate before any speed that are broken",
              float(sum(not rule.passed for rule in rules)), 0, "at_most", "",
              "fall, stretch, hole, power, size and direction of friction: exact, within the bounds of the table")
        for name, rules in gates.items()
    ]  # fmt: skip
