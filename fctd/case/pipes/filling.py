"""The keys of a component that its pipe gives, and those of an interval of the hole that its casing gives."""

from collections.abc import Mapping
from typing import Any, Final

from fctd.case.errors import InputError
from fctd.case.pipes.catalogue import Pipe, pipe_named
from fctd.case.pipes.names import CASING, EXAMPLE, TUBING, parse

STEEL: Final = 7850.0  # [kg/m³]
CASING_EXAMPLE: Final = "'9 5/8 in 47 N-80'"


def filled(raw: Mapping[str, Any]) -> Mapping[str, Any]:
    """A component with what its `pipe` gives and it does not say itself; raises InputError for an unknown pipe."""
    text = raw.get("pipe")
    if text is None:
        return raw
    if not isinstance(text, str):
        raise InputError(f"the name of a pipe in quotes, such as {EXAMPLE}", key="pipe", value=text)
    try:
        pipe = pipe_named(text)
    except InputError as error:
        raise error.at("pipe") from None
    given = {key: value for key, value in raw.items() if value is not None}
    if pipe.yield_strength is None and "yield_strength" not in given:
        raise InputError(f"{pipe.name} with its grade, such as 'N-80', or yield_strength", key="pipe", value=text)
    of_pipe = _keys_of(pipe)
    if isinstance(joint := given.get("joint"), Mapping):
        given["joint"] = {**of_pipe.get("joint", {}), **joint}
        if given["joint"] != of_pipe.get("joint"):  # else what touches and weighs would be other tool joints
            of_pipe = {key: of_pipe[key] for key in of_pipe if key not in ("contact_diameter", "linear_mass")}
    return {**of_pipe, **given}


def casing_filled(raw: Mapping[str, Any]) -> Mapping[str, Any]:
    """An interval of the hole with what its `casing` gives and it does not say itself; raises InputError for others."""
    text = raw.get("casing")
    if text is None:
        return raw
    if not isinstance(text, str):
        raise InputError(f"the name of casing in quotes, such as {CASING_EXAMPLE}", key="casing", value=text)
    pipe = casing_named(text)
    given = {key: value for key, value in raw.items() if value is not None}
    if pipe.yield_strength is None and "yield_strength" not in given:
        raise InputError(f"{pipe.name} with its grade, such as 'N-80', or yield_strength", key="casing", value=text)
    of_casing = {
        "kind": "cased", "diameter": pipe.inner, "outer_diameter": pipe.outer, "yield_strength": pipe.yield_strength,
    }  # fmt: skip
    return {**of_casing, **given}


def casing_named(text: str) -> Pipe:
    """The casing that a name stands for, with or without the word; raises InputError, with the key `casing`."""
    try:
        pipe = pipe_named(text if parse(text).kind is not None else f"{text} casing")
        if pipe.kind not in (CASING, TUBING):
            raise InputError(f"casing, such as {CASING_EXAMPLE}", value=text)
    except InputError as error:
        raise InputError(error.expected, key="casing", value=text) from None
    return pipe


def _keys_of(pipe: Pipe) -> dict[str, Any]:
    keys: dict[str, Any] = {
        "name": pipe.name, "outer_diameter": pipe.outer, "inner_diameter": pipe.inner,
        "yield_strength": pipe.yield_strength, "linear_mass": pipe.linear_mass,
    }  # fmt: skip
    joint = pipe.joint
    if joint is not None:
        keys["contact_diameter"] = joint.outer
    if pipe.coupling is not None:
        keys["contact_diameter"] = pipe.coupling
    if joint is not None and joint.length is not None and joint.joint_length is not None:
        keys["joint"] = {
            "length": joint.joint_length, "tool_joint_length": joint.length, "tool_joint_diameter": joint.outer,
            "tool_joint_inner": joint.inner,
        }  # fmt: skip
    return {key: value for key, value in keys.items() if value is not None}


def lacks_joints(pipe: Pipe) -> bool:
    """Whether no page gives the tool joints or the couplings of a pipe, or what it weighs with them."""
    if pipe.kind in (CASING, TUBING):
        return pipe.coupling is None
    return pipe.connection == "" or (pipe.joint is not None and pipe.linear_mass is None)
