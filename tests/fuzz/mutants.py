"""Valid case files with changes of their data, their lines or their bytes."""

import copy
import json
import re
import tomllib
from contextlib import suppress
from pathlib import Path
from random import Random
from typing import Any

from fctd.case.errors import InputError
from fctd.case.raw_case import set_key
from tests.fuzz.items import Item
from tests.rules import CASE, COMBINED, RULES
from tests.strategies import WRONG_VALUES, places, toml, write_case

CASES = Path(__file__).parents[2] / "validation" / "cases"
SURVEYS = {path.name: path.read_bytes() for path in sorted(CASES.glob("*.csv"))}
# One case reads a survey that is not part of this project: it gets another one.
STAND_IN = SURVEYS["paper_well_b.csv"]
BASES = [CASE, *(path.read_text(encoding="utf-8") for path in sorted(CASES.glob("*.toml")))]

EXTREMES: list[Any] = [
    *WRONG_VALUES,
    *(-0.0, 1e-300, 5e-324, 1e300, 1.7e308, float("-inf"), 1e6, 1e9, 10**12, 2**63, -(2**63), False),
    *("1e300 m", "1e-300 m", "0 m", "1e999 m", "-5 m", "5", "5 m", "5 ft", "5 mm", "5 s", "5 m/s", "5 kN", "5 deg"),
    *(
        "5 furlong",
        "5 degC",
        "5 m m",
        "5 m^9",
        "5 m^-1",
        "5 ()",
        "8 1/2 in",
        "10**10**10 m",
        "5 m; 6 m",
        "５ m",
        "5 µm",
    ),
    *("[/x]", "[bold]", ":x:", "\x1b[31m", "\x9b2J", "\x00", "é", "a" * 5000, "..", "/dev/zero", "/dev/null"),
    *([[0, 0, 0], [1e9, 0, 0]], [[0, 0, 0], [1000, 180, 0]], [1] * 2000, {"a": {"b": {"c": 1}}}),
]
# Values of TOML that no Python value is written as.
LITERALS = [
    *("1979-05-27", "07:32:00", "1979-05-27T07:32:00Z", "0x1F", "0b11", "1_000", "+inf", "-nan", "1e5", "1.", ""),
    *("'''a\nb'''", '"\\u0000"', '"\\U0001F600"', '"\\q"', "'", '"', "{a=1}", "{", "[", "[,]", "=", "9" * 5000),
    *("[" * 1500 + "]" * 1500, "[" * 100_000, "{a=" * 400 + "1" + "}" * 400, '"' + "m" * 70_000 + '"'),
]
KEYS = sorted({key for key, _, _ in RULES})
ODD_KEYS = [
    *("", ".", "a.", "[", "[0]", "0", "a[99999999999]", "a" * 3000, "x." * 500 + "x", "é", "\x1b", "friction"),
    *("operations[-1]", "operations", "wellbore.intervals[0]", "string.components[0]", "file"),
]
ENCODINGS = ["utf-16", "utf-16-le", "utf-32", "latin-1", "utf-8-sig", "utf-7"]
UNITS = [
    "m",
    "ft",
    "mm",
    "in",
    "km",
    "s",
    "min",
    "kg",
    "N",
    "kN",
    "klbf",
    "Pa",
    "psi",
    "deg",
    "m/s",
    "ppg",
    "sg",
    "N/m",
    "",
]

FACTORS = [-1, 0, 1e-12, 1e-3, 0.1, 0.3, 0.5, 0.9, 1.1, 2, 5, 10, 100, 1e4, 1e12]


def mutant(rng: Random) -> Item:
    """A case file with one to three changes; one in seven has overrides too."""
    text = rng.choice(BASES)
    survey = re.search(r'^survey = "(.*?)"', text, re.MULTILINE)
    files = {survey[1]: SURVEYS.get(survey[1], STAND_IN)} if survey else {}
    how = rng.random()
    if how < 0.75:
        content = _changed_data(rng, text).encode()
    elif how < 0.9:
        content = _changed_lines(rng, text).encode()
    else:
        content = changed_bytes(rng, text.encode())
    overrides = [_override(rng) for _ in range(rng.randint(1, 3))] if rng.random() < 0.15 else []
    return Item(content, files, tuple(overrides))


def _changed_data(rng: Random, text: str) -> str:
    """The case with values replaced, deleted, renamed, repeated, multiplied, or keys set that were not there."""
    raw = tomllib.loads(text)
    for _ in range(rng.choice([1, 2, 3])):
        table, key = rng.choice(places(raw))
        how = rng.choice(["delete", "rename", "move", "repeat", "set", "replace", *["scale"] * 8])
        if how == "delete":
            del table[key]
        elif how == "rename" and isinstance(table, dict):
            name = str(key)
            odd = [name[:-1], f"{name}x", name.upper(), f" {name}", "", f"{name}\x1b[0m", "[/x]"]
            table[rng.choice(odd)] = table.pop(key)
        elif how == "move":
            other, place = rng.choice(places(raw))
            table[key] = copy.deepcopy(other[place])
        elif how == "scale" and isinstance(table[key], int | float):
            with suppress(OverflowError):  # a whole number beyond the floats stays
                table[key] *= rng.choice(FACTORS)
        elif how == "scale" and isinstance(table[key], str):
            table[key] = _scaled(rng, table[key])
        elif how == "scale":
            continue  # a table or a list has no size
        elif how == "repeat" and isinstance(table, list):
            table[key:key] = [copy.deepcopy(table[key]) for _ in range(rng.choice([1, 3, 300]))]
        elif how == "set":
            _set_key(raw, rng)
        else:
            table[key] = copy.deepcopy(rng.choice(EXTREMES))
    return write_case(raw)


def _scaled(rng: Random, text: str) -> str:
    """A quantity times a factor, or in another unit."""
    number, _, unit = text.partition(" ")
    if rng.random() < 0.2:
        return f"{number}{rng.choice([' ', '', 'e3 ', 'e-6 '])}{rng.choice(UNITS)}"
    try:
        return f"{float(number) * rng.choice(FACTORS):g} {unit}"
    except ValueError:
        return text.upper()


def _set_key(raw: dict[str, Any], rng: Random) -> None:
    """Set what a rule of the case tests sets, or such a key to an extreme value."""
    key, value, _ = rng.choice(RULES)
    changes = rng.choice([{key: value}, {key: copy.deepcopy(rng.choice(EXTREMES))}, rng.choice(COMBINED)[0]])
    for path, new in changes.items():
        if new is not None:
            # An earlier change may have taken away the list that the key leads through.
            with suppress(InputError):
                set_key(raw, path, new)


def _changed_lines(rng: Random, text: str) -> str:
    """The text with lines lost, doubled, swapped or rewritten."""
    lines = text.splitlines()
    for _ in range(rng.choice([1, 1, 2, 5])):
        k = rng.randrange(len(lines))
        how = rng.randrange(6)
        if how == 0:
            lines[k] = ""
        elif how == 1:
            lines.insert(rng.randrange(len(lines)), lines[k])
        elif how == 2:
            other = rng.randrange(len(lines))
            lines[k], lines[other] = lines[other], lines[k]
        elif how == 3:
            at = rng.randrange(len(lines[k]) + 1)
            lines[k] = (
                lines[k][:at]
                + rng.choice(['"', "\\", "#", "=", "]", "\t", "\x00", "\x1b", "\x85", "\u2028"])
                + lines[k][at:]
            )
        else:
            lines[k] = f"{lines[k].split('=')[0]}= {rng.choice(LITERALS)}"
    return rng.choice(["\n", "\n", "\n", "\r\n", "\r"]).join(lines)


def changed_bytes(rng: Random, content: bytes) -> bytes:
    """The content cut short, in another encoding, twice, or with some bytes flipped, added or lost."""
    how = rng.randrange(6)
    if how == 0:
        return content[: rng.randrange(len(content) + 1)]
    if how == 1:
        return content.decode("utf-8", "replace").replace("e", "é").encode(rng.choice(ENCODINGS), "replace")
    if how == 2:
        return content * 2
    changed = bytearray(content)
    for _ in range(rng.choice([1, 1, 3, 30])):
        at = rng.randrange(len(changed) + 1)
        if how == 3:
            changed[at : at + 1] = bytes([rng.randrange(256)])
        elif how == 4:
            changed[at:at] = rng.randbytes(rng.choice([1, 4, 100]))
        else:
            del changed[at : at + rng.choice([1, 10, 200])]
    return bytes(changed)


def _override(rng: Random) -> str:
    """An override as it is typed: a rule, a key of one with an extreme value, or an odd key."""
    key, value, _ = rng.choice(RULES)
    if rng.random() < 0.6:
        value = rng.choice(EXTREMES)
    if rng.random() < 0.2:
        key = rng.choice(ODD_KEYS)
    written = rng.choice([toml, json.dumps, str])(value) if value is not None else ""
    return rng.choice(["{}={}", "{} = {}", "{}={}", "{}  ={}", "{}{}"]).format(key, written)
