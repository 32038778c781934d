"""What is asked for: methods and engines by name, with options, and what a plugin that is left out says."""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from fctd.arena.method import settings_of
from fctd.arena.result import Kind, Row
from fctd.case.errors import InputError
from fctd.case.raw_case import parse_override
from references import contact, engines, packages
from references.registry import Registry, absent, label

REGISTRIES: Mapping[Kind, Registry[Any]] = {"contact": contact.REGISTRY, "engine": engines.REGISTRY}
ALL = "all"
# A name, or a text "name,key=value,…", or both apart.
Wanted = str | tuple[str, Mapping[str, Any]]


def read(wanted: Wanted, key: str) -> tuple[str, dict[str, Any]]:
    """Name and options; InputError, which names the key, for a text that is none."""
    if not isinstance(wanted, str):
        return wanted[0], dict(wanted[1])
    name, *texts = (part.strip() for part in wanted.split(","))
    return name, options_of(texts, InputError("NAME or NAME,KEY=VALUE,…", key=key, value=wanted))


def options_of(texts: Iterable[str], wrong: InputError | None = None) -> dict[str, Any]:
    """Options from texts KEY=VALUE; InputError for a text without a value, by default of ``--option``."""
    chosen: dict[str, Any] = {}
    for text in texts:
        option, given, _ = text.partition("=")
        if not given:
            raise wrong or InputError("KEY=VALUE", key="--option", value=text)
        chosen[option.strip()] = parse_override(text)[1]
    return chosen


def rows_of(kind: Kind, wanted: Iterable[Wanted]) -> tuple[list[Row], list[str]]:
    """A row for each that is wanted, and the names of those that are not installed and that nobody named.

    "all" stands for all that are installed, and the plugins that are left out are rows then.  Raises InputError for an
    unknown name and for options that are none.
    """
    registry = REGISTRIES[kind]
    rows: list[Row] = []
    absent_ones: list[str] = []
    for each in wanted:
        name, options = read(each, f"--{kind}")
        if name == ALL and not options:
            for known in registry.names():
                row = _row(kind, known, {})
                if row.status == "not installed":
                    absent_ones.append(known)
                else:
                    rows.append(row)
            rows += left_out(kind)
            continue
        if name not in registry.names():
            registry.find(name)  # raises, with the nearest name
        rows.append(_row(kind, name, options))
    unique = {row.label: row for row in rows}
    return list(unique.values()), absent_ones


def every_setting(wanted: Iterable[Wanted], *, defaults: bool = False) -> list[Row]:
    """A row for each setting of contact methods that studies try; with ``defaults`` one for each method.

    A pair of name and options is that setting alone.
    """
    rows: list[Row] = []
    for each in wanted:
        name, options = read(each, "--contact")
        row = _row("contact", name, options)
        if options or defaults or row.status != "not run":
            rows.append(row)
        else:
            rows += [_row("contact", name, chosen) for chosen in settings_of(contact.method_class(name))]
    return rows


def left_out(kind: Kind) -> Iterator[Row]:
    """The plugins that are left out since their names are taken."""
    for point in REGISTRIES[kind].shadowed():
        yield Row(kind=kind, name=label(point), status="refused", reason=f"the name {point.name} is taken")


def _row(kind: Kind, name: str, options: dict[str, Any]) -> Row:
    """The row of a name before anything is asked of it; raises InputError for options that are none."""
    registry, row = REGISTRIES[kind], Row(kind=kind, name=name, options=options)
    try:
        package = registry.find(name).distribution
    except InputError as error:  # a plugin that cannot be imported
        row.status, row.reason = "refused", str(error)
        return row
    if options:
        registry.options(name, options)
    row.package, about = package, packages.about(package)
    row.version, row.licence = about.version, about.licence
    if row.version is None:
        row.status, row.reason = "not installed", f"package {absent(package)}"
    return row
