"""Compiled functions leave no option open, whatever calls them first."""

import pkgutil
from importlib import import_module
from typing import Any

from numba.core.dispatcher import Dispatcher

import fctd
from fctd.mechanics import jit


def dispatchers() -> dict[str, Any]:
    """Every compiled function of the engine."""
    modules = [import_module(module.name) for module in pkgutil.walk_packages(fctd.__path__, "fctd.")]
    return {
        f"{value.py_func.__module__}.{name}": value
        for module in modules
        for name, value in vars(module).items()
        if isinstance(value, Dispatcher)
    }


def test_no_compiled_function_leaves_an_option_open() -> None:
    """What is open numba takes from whichever caller compiles a function first: numbers then hang on the order."""
    found = dispatchers()
    assert len(found) > 100
    for name, function in found.items():
        options = {key: function.targetoptions.get(key) for key in jit.OPTIONS}
        assert options in (jit.OPTIONS, jit.INLINED), name
