"""What a checkpoint keeps of objects and puts back: each class names its own fields (``Restorable``)."""

import io
import json
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

# Values by the names of their fields: numbers, texts, None, arrays, lists and tuples of them, facts of parts.
Facts = dict[str, Any]
FACTS_FILE, ARRAY = "facts.json", "array"


class Restorable:
    """An object of which a checkpoint keeps the fields that ``FACTS`` names, in the order in which it puts them back.

    A field that is restorable itself keeps its own facts.  A tuple is put back as one of the same type.
    """

    FACTS: ClassVar[tuple[str, ...]] = ()

    def facts(self) -> Facts:
        """The present values, no copies: to be packed before the object changes."""
        values = {name: getattr(self, name) for name in self.FACTS}
        return {name: value.facts() if isinstance(value, Restorable) else value for name, value in values.items()}

    def restore(self, facts: Facts) -> None:
        """Put the values back that ``facts`` has given, perhaps in another process.

        Raises LookupError or ValueError where they do not fit; some are then put back and some are not.
        """
        for name in self.FACTS:
            part, found = getattr(self, name), facts[name]
            if isinstance(part, Restorable):
                part.restore(found)
            else:
                setattr(self, name, _like(part, found))


def _like(present: Any, found: Any) -> Any:
    """A value of the type of the present one, which JSON does not keep of tuples."""
    if not isinstance(present, tuple):
        return found
    return type(present)._make(found) if hasattr(present, "_make") else tuple(found)


def pack(facts: Facts) -> dict[str, bytes]:
    """Facts as the parts of a chunk (log.py): JSON, and each array in a file of its own.  No digit is lost."""
    arrays: list[bytes] = []

    def plain(value: Any) -> Any:
        if isinstance(value, np.generic):
            return value.item()
        sink = io.BytesIO()
        np.save(sink, value, allow_pickle=False)
        arrays.append(sink.getvalue())
        return {ARRAY: len(arrays)}

    text = json.dumps(facts, default=plain)
    return {FACTS_FILE: text.encode()} | {f"{k}.npy": content for k, content in enumerate(arrays, start=1)}


def unpack(parts: Mapping[str, bytes]) -> Facts:
    """The facts that ``pack`` has packed."""

    def back(table: Facts) -> Any:
        return np.load(io.BytesIO(parts[f"{table[ARRAY]}.npy"]), allow_pickle=False) if ARRAY in table else table

    facts: Facts = json.loads(parts[FACTS_FILE], object_hook=back)
    return facts
