"""Components and intervals by their names, where a key has an index."""

import re
from collections.abc import Mapping
from typing import Any, Final

from fctd.case.errors import InputError, nearest, show

# Lists of tables with names, and what an item is called.
_LISTS: Final = {("string", "components"): "component", ("wellbore", "intervals"): "interval"}
_INDEX: Final = re.compile(r"\d+(?:\..*)?")


def by_index(raw: Mapping[str, Any], key: str) -> str:
    """A dotted key of a case with an index in place of a name, of any letters and in any case of them.

    "string.components.HWDP.length" is "string.components[2].length"; a component may be named by its pipe, too.
    Raises InputError for a name that no item has, or that several have, with their indices.
    """
    for path, noun in _LISTS.items():
        table = ".".join(path)
        rest = key.removeprefix(f"{table}.").replace('"', "")
        items = raw.get(path[0], {}).get(path[1]) if isinstance(raw.get(path[0]), Mapping) else None
        if rest == key or not isinstance(items, list):
            continue
        names = [str(item.get("name") or item.get("pipe") or "") if isinstance(item, Mapping) else "" for item in items]
        fitting = [name for name in names if name and f"{rest}.".casefold().startswith(f"{name}.".casefold())]
        if not fitting:
            if _INDEX.fullmatch(rest):
                return key
            name = rest.rpartition(".")[0] or rest
            known = [show(name) for name in names if name]
            raise InputError(nearest(show(name), known, noun), key=table, value=name)
        name = max(fitting, key=len)
        places = [f"{table}[{k}]" for k, other in enumerate(names) if other.casefold() == name.casefold()]
        if len(places) > 1:
            raise InputError(f"one of {', '.join(places)}, which all have this name", key=table, value=name)
        return places[0] + rest[len(name) :]
    return key
