"""WITSML files of strings and holes for the tests, and those that are damaged with their messages."""

from collections.abc import Mapping, Sequence
from typing import Any
from xml.sax.saxutils import escape

SERIES = "http://www.witsml.org/schemas/1series"
Element = Mapping[str, Any]
"""Elements by name: a text, a (number, uom), a table of elements, or a list of such."""


def xml(name: str, value: Any) -> str:
    """An element of a value, or several of a list."""
    if isinstance(value, list):
        return "".join(xml(name, one) for one in value)
    if isinstance(value, Mapping):
        return f"<{name}>{''.join(xml(*item) for item in value.items())}</{name}>"
    if isinstance(value, tuple):
        return f'<{name} uom="{value[1]}">{value[0]}</{name}>'
    return f"<{name}>{escape(str(value))}</{name}>"


def objects(kind: str, found: Sequence[tuple[str, str, Element]], namespace: str = SERIES) -> str:
    """A file of objects: name, wellbore and elements of each."""
    each = "".join(
        f'<{kind} uid="u{k}"><nameWell>W</nameWell>{xml("nameWellbore", wellbore)}{xml("name", name)}'
        f"{''.join(xml(*item) for item in elements.items())}</{kind}>"
        for k, (name, wellbore, elements) in enumerate(found, start=1)
    )
    of = f' xmlns="{namespace}"' if namespace else ""
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<{kind}s{of} version="1.4.1.1">{each}</{kind}s>'


def component(kind: str, sequence: int, length: Any, outer: Any, inner: Any, **more: Any) -> Element:
    """A component; lengths are in metres and diameters in inches, or with their units."""
    sizes = {"id": (inner, "in"), "od": (outer, "in"), "len": (length, "m")}
    return {"typeTubularComp": kind, "sequence": sequence, **sizes, **more}


def section(kind: str, top: Any, bottom: Any, inner: Any, **more: Any) -> Element:
    """A section, depths in metres and diameters in inches."""
    return {
        "typeHoleCasing": kind, "mdTop": (top, "m"), "mdBottom": (bottom, "m"), "idSection": (inner, "in"), **more,
    }  # fmt: skip


BIT = component("bit PDC fixed cutter", 1, 0.3, 8.5, 2.25)
COLLAR = component("drill collar", 2, 120, 6.75, 2.8125)
PIPE = component("drill pipe", 3, 2900, 5, 4.276, odMx=(6.625, "in"), wtPerLen=(35, "kg/m"))
STRING = [BIT, COLLAR, PIPE]
HOLE = [section("open hole", 1500, 3000, 8.5), section("casing", 0, 1500, 8.681, odSection=(9.625, "in"))]


def tubular(parts: Sequence[Element] = STRING, namespace: str = SERIES, assembly: str = "drilling") -> str:
    """A file of one string."""
    elements = {"typeTubularAssy": assembly, "tubularComponent": list(parts)}
    return objects("tubular", [("BHA 1", "B", elements)], namespace)


def geometry(sections: Sequence[Element] = HOLE, namespace: str = SERIES, bottom: float = 3000) -> str:
    """A file of one hole."""
    elements = {"mdBottom": (bottom, "m"), "wbGeometrySection": list(sections)}
    return objects("wbGeometry", [("hole", "B", elements)], namespace)


_TUBULAR, _HOLE = tubular(), geometry()
BOMB = '<!DOCTYPE a [<!ENTITY b "bbbb"><!ENTITY c "&b;&b;&b;">]>'
TRAJECTORY = f'<trajectorys xmlns="{SERIES}"><trajectory><name>S</name></trajectory></trajectorys>'

# Name, the option, the file, and the message below its name.
DAMAGED: list[tuple[str, str, str, str]] = [
    (
        "truncated",
        "string",
        _TUBULAR[:300],
        "expected a WITSML tubular in XML (unclosed token: line 2, column 260)",
    ),
    (
        "another namespace",
        "string",
        tubular(namespace="http://www.energistics.org/energyml/data/witsmlv2"),
        'namespace of tubular = "http://www.energistics.org/energyml/data/witsmlv2": expected a WITSML tubular of '
        "version 1.3.1 or 1.4.1, whose namespace is http://www.witsml.org/schemas/1series or "
        "http://www.witsml.org/schemas/131",
    ),
    (
        "an entity bomb",
        "string",
        _TUBULAR.replace("<tubulars", BOMB + "<tubulars"),
        "expected a WITSML tubular without a document type (DOCTYPE)",
    ),
    (
        "a survey",
        "string",
        TRAJECTORY,
        'expected a WITSML tubular with a tubularComponent, found the element "trajectorys" (give it as the survey)',
    ),
    (
        "a hole as a string",
        "string",
        _HOLE,
        'expected a WITSML tubular with a tubularComponent, found the element "wbGeometrys" (give it as --hole)',
    ),
    (
        "a string as a hole",
        "hole",
        _TUBULAR,
        'expected a WITSML wbGeometry with a wbGeometrySection, found the element "tubulars" (give it as --string)',
    ),
    ("no components", "string", tubular([]), "expected a WITSML tubular with a tubularComponent, found the element"),
    ("a table", "string", "md_m,inc_deg,azi_deg\n0,0,0\n", "expected a WITSML tubular (XML), found another text"),
    ("binary", "hole", "\0\1\2\3", "expected a WITSML wbGeometry (XML)"),
    (
        "a negative length",
        "string",
        _TUBULAR.replace(">120<", ">-120<"),
        'tubularComponent 2, len = "-120 m": expected a length at least 0 and at most 50000 m',
    ),
    (
        "an unknown unit",
        "string",
        _TUBULAR.replace('len uom="m">120', 'len uom="joints">120'),
        'tubularComponent 2, len, uom = "joints": expected a unit of m, cm, mm, km, ft or in',
    ),
    (
        "a unit of another dimension",
        "string",
        _TUBULAR.replace('uom="kg/m"', 'uom="kg"'),
        'tubularComponent 3, wtPerLen, uom = "kg": expected a unit of kg/m, N/m, lb/ft, lbf/ft or ppf',
    ),
    (
        "no unit",
        "string",
        _TUBULAR.replace('len uom="m">120', "len>120"),
        "tubularComponent 2, len, uom is missing: expected a unit of m, cm, mm, km, ft or in",
    ),
    (
        "a text in a number",
        "string",
        _TUBULAR.replace(">120<", ">four stands<"),
        'tubularComponent 2, len = "four stands": expected a finite number with a decimal point',
    ),
    (
        "a decimal comma",
        "string",
        _TUBULAR.replace(">6.75<", ">6,75<"),
        'tubularComponent 2, od = "6,75": expected a finite number with a decimal point',
    ),
    (
        "NaN",
        "hole",
        _HOLE.replace(">8.681<", ">NaN<"),
        'wbGeometrySection 2, idSection = "NaN": expected a finite number with a decimal point',
    ),
    (
        "inches as metres",
        "hole",
        _HOLE.replace('idSection uom="in">8.681', 'idSection uom="m">8.681'),
        'wbGeometrySection 2, idSection = "8.681 m": expected a length at least 0 and at most 5 m '
        "(8.681 looks like '8.681 in')",
    ),
    (
        "a section upside down",
        "hole",
        geometry([section("casing", 1500, 0, 8.681)]),
        'wbGeometrySection 1, mdBottom = "0 m": expected a depth below mdTop, 1500 m',
    ),
    (
        "a section without a top",
        "hole",
        _HOLE.replace('<mdTop uom="m">1500</mdTop>', ""),
        "wbGeometrySection 1, mdTop is missing: expected a measured depth with its uom",
    ),
    (
        "a friction factor in per cent",
        "hole",
        geometry([section("open hole", 0, 3000, 8.5, factFric="30")]),
        'wbGeometrySection 1, factFric = "30": expected a friction factor at least 0 and at most 5',
    ),
    (
        "a sequence twice",
        "string",
        tubular([BIT, {**COLLAR, "sequence": 1}]),
        'tubularComponent 2, sequence = "1": expected a number that no component before it has',
    ),
    (
        "a sequence of some",
        "string",
        tubular([BIT, {**COLLAR, "sequence": ""}]),
        "tubularComponent 2, sequence is missing: expected a number, as others have it",
    ),
    (
        "a part of a sequence",
        "string",
        tubular([{**BIT, "sequence": "1.5"}]),
        'tubularComponent 1, sequence = "1.5": expected a whole number at least 0 and at most 1e+06',
    ),
]  # fmt: skip
