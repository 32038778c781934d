"""Every compiled function sets all its options, so that its code does not depend on its first caller."""

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


def test_every_compiled_function_sets_all_options() -> None:
    """numba takes an option not set from the first caller of a function: numbers would depend on the order."""
    found = dispatchers()
    assert len(found) > 100
    for name, function in found.items():
        options = {key: function.targetoptions.get(key) for key in jit.OPTIONS}
        assert options in (jit.OPTIONS, jit.INLINED, jit.ROUNDED), name
