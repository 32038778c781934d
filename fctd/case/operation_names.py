"""The names of operations: the kinds of a case, what drillers say and write in sheets, and the words of legends."""

import re
from collections.abc import Mapping, Sequence
from typing import Annotated, Final

from pydantic import BeforeValidator

from fctd.case.errors import InputError, nearest
from fctd.case.operations import KINDS

# Beside the kinds and the words of legends; a case of letters, and what stands between words, do not matter.
_NAMES: Final[Mapping[str, tuple[str, ...]]] = {
    "trip_in": ("slack-off", "SO", "S/O", "down", "running in", "RIH"),
    "trip_out": ("pick-up", "PU", "P/U", "up", "pulling out", "POOH"),
    "rotate_off_bottom": ("rotating", "ROT", "ROB"),
    "back_ream": ("reaming out",),
    "ream_in": ("reaming down",),
    "drill_rotating": ("rotary drilling",),
    "drill_sliding": ("slide drilling",),
}
# Words of several kinds, and which.
_SEVERAL: Final = {
    "drilling": "drill_rotating or drill_sliding",
    "reaming": "back_ream or ream_in",
    "tripping": "trip_in or trip_out",
}
USUAL: Final = ("pick-up", "slack-off", "rotating", "PU", "SO", "ROT")  # in help and messages
# The words of some legends have a comma, which else stands between two names.
_LABELS: Final = [r",\s*".join(map(re.escape, kind.label.split(", "))) for kind in KINDS.values() if "," in kind.label]
_ONE: Final = re.compile(rf"\s*(?:{'|'.join([*_LABELS, '[^,]+'])})", re.IGNORECASE)


def _plain(name: str) -> str:
    return re.sub(r"[\W_]+", "", name.casefold())


def names_of(kind: str) -> tuple[str, ...]:
    """The names of a kind of operation, itself the first."""
    return (kind, *_NAMES.get(kind, ()), KINDS[kind].label)


_KIND_OF: Final = {_plain(name): kind for kind in KINDS for name in names_of(kind)}


def kind_named(name: object) -> str | None:
    """The kind of operation that a name is of; None for another text."""
    return _KIND_OF.get(_plain(name)) if isinstance(name, str) else None


def read_kind(name: object, others: Sequence[str] = ()) -> str:
    """The kind of operation that a name is of, or one of the other words; InputError for another text."""
    kind = kind_named(name)
    if kind is None and name not in others:
        several = _SEVERAL.get(_plain(str(name)))
        expected = f"the kind {several}" if several else nearest(name, [*KINDS, *others, *USUAL], "kind")
        raise InputError(expected, value=name)
    return kind or str(name)


def kinds_of(operation: str | Sequence[str]) -> list[str]:
    """The kinds of operation of a name or several, each once; InputError for none."""
    names = [operation] if isinstance(operation, str) else list(operation)
    if not names:
        raise InputError("at least one kind of operation", key="operation", value=[])
    try:
        return list(dict.fromkeys(read_kind(name) for name in names))
    except InputError as error:
        raise error.at("operation") from None


def split_names(text: str) -> list[str]:
    """The names of a text with commas between them."""
    return [name for found in _ONE.findall(text) if (name := found.strip())]


KindName = Annotated[str, BeforeValidator(read_kind, json_schema_input_type=str)]
