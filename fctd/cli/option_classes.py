"""Options as the fields of a dataclass: what typer reads of them, and what an unfinished result keeps of them."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import MISSING, Field, fields, is_dataclass, replace
from functools import wraps
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import Annotated, Any, Final, TypeVar, get_args, get_origin, get_type_hints

from typer.models import ArgumentInfo

from fctd.case.systems import System
from fctd.cli.quantities import Given

T = TypeVar("T")
# Fields that an unfinished result does not keep, beside those that are dataclasses: each process has its own.
OWN: Final = ("quiet",)


def with_options(command: Callable[..., None]) -> Callable[..., None]:
    """The command as typer reads it: an argument that is a dataclass gives one for each of its fields."""
    hints = get_type_hints(command, include_extras=True)

    @wraps(command)
    def called(**given: Any) -> None:
        command(**_gathered(hints, given))

    asked = signature(command).parameters.items()
    parameters = [one for name, of in asked for one in _spread(name, hints[name], of.default)]
    called.__annotations__ = {one.name: one.annotation for one in parameters}
    called.__signature__ = Signature(parameters)  # type: ignore[attr-defined]
    return called


def _spread(name: str, hint: Any, default: Any) -> Iterator[Parameter]:
    """An argument, or those of the fields of a dataclass, in their order."""
    if not is_dataclass(hint):
        yield Parameter(name, Parameter.KEYWORD_ONLY, annotation=hint, default=default)
        return
    hints = get_type_hints(hint, include_extras=True)
    for of in fields(hint):
        yield from _spread(of.name, hints[of.name], _default(of))


def _gathered(hints: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """Arguments by name, those of a dataclass made of its fields."""
    found = {name: given[name] for name in hints if name in given}
    nested: dict[str, Any] = {name: of for name, of in hints.items() if is_dataclass(of)}
    return found | {name: of(**_gathered(get_type_hints(of), given)) for name, of in nested.items()}


def _default(of: "Field[Any]") -> Any:
    if of.default_factory is not MISSING:
        return of.default_factory()
    return Parameter.empty if of.default is MISSING else of.default


def given_options(options: Any) -> dict[str, Any]:
    """The values by option; None of those that have their default."""
    found: dict[str, Any] = {}
    for name, (hint, default) in _restored(options).items():
        (info,) = hint.__metadata__
        option = str(info.metavar) if isinstance(info, ArgumentInfo) else info.default.split("/")[0]
        found[option] = None if getattr(options, name) == default else getattr(options, name)
    return found


def to_keep(options: Any, units: System) -> dict[str, Any]:
    """The options of an unfinished result as JSON takes them; a quantity is the text that was typed, with its unit."""
    return {name: _as_json(getattr(options, name), units) for name in _kept(options)}


def beside(options: T, kept: Mapping[str, Any]) -> T:
    """The options, and in place of those that have their default the kept ones."""
    defaults = {name: hint for name, (hint, default) in _restored(options).items() if getattr(options, name) == default}
    values = {name: _read(hint, kept[name]) for name, hint in defaults.items() if name in kept}
    return replace(options, **values)  # type: ignore[type-var]


def _kept(options: Any) -> dict[str, tuple[Any, Any]]:
    """Annotation and default of each field that an unfinished result keeps."""
    hints = get_type_hints(type(options), include_extras=True)
    names = {of.name: _default(of) for of in fields(options) if of.name not in OWN}
    return {name: (hints[name], default) for name, default in names.items() if not is_dataclass(hints[name])}


def _restored(options: Any) -> dict[str, tuple[Any, Any]]:
    """Those that go on with it as they were; it may be shown in other units, and by default is in its own."""
    return {name: of for name, of in _kept(options).items() if name != "units"}


def _as_json(value: Any, units: System) -> Any:
    if isinstance(value, Path):
        return str(value.absolute())
    return value.complete(units) if isinstance(value, Given) else value


def _read(hint: Any, kept: Any) -> Any:
    """The value of a field that ``_as_json`` gave."""
    plain, *info = get_args(hint) if get_origin(hint) is Annotated else (hint,)
    if isinstance(kept, str) and Path in (plain, *get_args(plain)):
        return Path(kept)
    if isinstance(kept, str) and info and Given in get_args(plain):
        return info[0].parser(kept)
    return kept
