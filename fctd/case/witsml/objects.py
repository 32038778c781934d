"""One object of a WITSML file, and the quantities in its elements."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final, NamedTuple
from xml.etree.ElementTree import Element

from fctd.case.errors import MISSING, InputError, show
from fctd.case.input_file import decode, read_bytes
from fctd.case.tables.rows import NULLS, read_number
from fctd.case.text import printable
from fctd.case.units import ANGLE, LENGTH, Dimension, Number, Quantity
from fctd.case.xml_file import child, read_xml, tag, text_of

_LARGEST_FILE: Final = 8  # MiB: some thousand components with all that the schema has of them
# Namespaces of WITSML 1.4.1 and 1.3.1; files whose elements have none are read, too.
_NAMESPACES: Final = ("http://www.witsml.org/schemas/1series", "http://www.witsml.org/schemas/131", "")
_NAMESPACE: Final = re.compile(r"\{(.*)\}")
# Spellings of Energistics that are not those of people [SI].
_SURVEY_FOOT: Final = 1200 / 3937
_UOMS: Final[dict[Dimension, dict[str, float]]] = {
    LENGTH: {"ftUS": _SURVEY_FOOT, "usft": _SURVEY_FOOT, **{f"in/{k}": 0.0254 / k for k in (10, 16, 32, 64)}},
    ANGLE: {"dega": math.pi / 180},
}


class Kind(NamedTuple):
    """A kind of object: its element, that of its parts, and the argument and the option that take its file.

    `argument` is that of `fctd.new_case`; with ``_name`` it chooses one of several objects.
    """

    element: str
    part: str
    argument: str

    @property
    def noun(self) -> str:
        """The object, for messages."""
        return f"a WITSML {self.element}"


TUBULAR: Final = Kind("tubular", "tubularComponent", "string")
GEOMETRY: Final = Kind("wbGeometry", "wbGeometrySection", "hole")
_KINDS: Final = (TUBULAR, GEOMETRY)


@dataclass(frozen=True)
class Item:
    """An element, and its place in messages, such as "tubularComponent 2"."""

    element: Element
    place: str

    def text(self, name: str) -> str:
        """The text of an element inside, in one line; "" where there is none."""
        return printable(" ".join(text_of(child(self.element, name)).split()))

    def items(self, name: str) -> Iterator["Item"]:
        """The elements of a name inside, with their numbers."""
        found = (inner for inner in self.element if tag(inner) == name)
        for number, inner in enumerate(found, start=1):
            yield Item(inner, f"{self.place}, {name} {number}" if self.place else f"{name} {number}")

    def quantity(self, name: str, quantity: Quantity) -> float | None:
        """The quantity of an element inside [SI], whose unit is its ``uom``; None where it is absent, empty or null.

        Raises InputError, which names place, element and value, for what is no number, has no such unit, or is out of
        bounds.
        """
        found = child(self.element, name)
        number = self._number(name, found)
        if found is None or number is None:
            return None
        unit = found.get("uom", "").strip()
        factor = _factor(unit, quantity.dimension)
        if factor is None:
            *others, last = quantity.dimension.units
            expected = f"a unit of {', '.join(others)} or {last}"
            raise InputError(expected, key=f"{self._key(name)}, uom", value=unit or MISSING)
        try:
            return quantity.parse(float(f"{number * factor:.15g}"))
        except InputError as error:
            raise InputError(error.expected, key=self._key(name), value=f"{text_of(found)} {unit}") from None

    def number(self, name: str, number: Number) -> float | None:
        """A bare number of an element inside; None and errors as of `quantity`."""
        found = child(self.element, name)
        value = self._number(name, found)
        try:
            return None if value is None else number.parse(int(value) if value.is_integer() else value)
        except InputError as error:
            raise InputError(error.expected, key=self._key(name), value=text_of(found)) from None

    def _number(self, name: str, found: Element | None) -> float | None:
        text = text_of(found)
        if not text:
            return None
        value = read_number(text)
        if value is None or not math.isfinite(value):
            raise InputError("a finite number with a decimal point", key=self._key(name), value=text)
        return None if value in NULLS else value

    def _key(self, name: str) -> str:
        return f"{self.place}, {name}" if self.place else name


def _factor(unit: str, dimension: Dimension) -> float | None:
    """SI units in one of a ``uom``; None for one that is not of the dimension."""
    own = _UOMS.get(dimension, {})
    if unit in own:
        return own[unit]
    known = dimension.unit_of(unit)
    return None if known is None else dimension.factor(known)


def read_object(path: Path, kind: Kind, name: str | None) -> Item:
    """The object of a file with this name or uid, else the only one that has parts.

    Raises InputError, which does not name the file, for a file that has no such object, or several.
    """
    text = decode(read_bytes(path, _LARGEST_FILE, f"{kind.noun} file"), f"{kind.noun} (XML)")
    if not text.lstrip().startswith("<"):
        raise InputError(f"{kind.noun} (XML), found another text")
    root = read_xml(text, kind.noun)
    found = [element for element in root.iter() if tag(element) == kind.element]
    _check_namespace((found or [root])[0], kind)
    whole = [element for element in found if child(element, kind.part) is not None]
    if not whole:
        others = [other for other in _KINDS if other is not kind and other.element in tag(root)]
        remedy = f" (give it as --{others[0].argument})" if others else ""
        remedy = " (give it as the survey)" if "trajectory" in tag(root) else remedy
        raise InputError(f"{kind.noun} with a {kind.part}, found the element {show(tag(root))}{remedy}")
    return Item(_chosen(whole, kind, name), "")


def _check_namespace(element: Element, kind: Kind) -> None:
    """Raise InputError for an element of another standard or version."""
    namespace = _NAMESPACE.match(str(element.tag))
    if namespace is not None and namespace[1] not in _NAMESPACES:
        expected = f"{kind.noun} of version 1.3.1 or 1.4.1, whose namespace is {' or '.join(_NAMESPACES[:2])}"
        raise InputError(expected, key=f"namespace of {tag(element)}", value=namespace[1])


def _chosen(found: list[Element], kind: Kind, name: str | None) -> Element:
    """The object of a name or a uid, or the only one."""
    key = f"{kind.argument}_name"
    fitting = [element for element in found if name in (None, *_names(element))]
    if len(fitting) == 1:
        return fitting[0]
    listed = ", ".join(" of ".join(map(show, filter(None, _titles(element)))) for element in (fitting or found))
    if fitting:
        choice = "the name" if len({_names(element)[0] for element in fitting}) == len(fitting) else "the uid"
        value = MISSING if name is None else name
        one = f"{choice} of one {kind.element} of the {len(fitting)} in the file"
        raise InputError(f"{one} (for init: --{kind.argument}-name): {listed}", key=key, value=value)
    raise InputError(f"the name or the uid of a {kind.element} of the file: {listed}", key=key, value=name)


def _names(element: Element) -> tuple[str, str]:
    """Name and uid."""
    return text_of(child(element, "name")), element.get("uid", "")


def _titles(element: Element) -> tuple[str, str]:
    """Name with uid, and the wellbore of an object, for messages."""
    name, uid = _names(element)
    title = f"{name} (uid {uid})" if uid else name
    return title, text_of(child(element, "nameWellbore"))
