"""Public names of a package, which its source has once: as imports that type checkers read and that nothing runs."""

import ast
import sys
from functools import cache
from importlib import import_module
from typing import Any


def offer(package: str, *packages: str) -> tuple[Any, Any, list[str]]:
    """``__getattr__``, ``__dir__`` and ``__all__`` of a package: each name is imported at its first use.

    The names are those that its source imports below ``if TYPE_CHECKING:``, as ``from module import name as name``.
    packages : of more public names, which need packages of their own.
    """
    source = vars(sys.modules[package])["__loader__"].get_source(package)
    below = (node for block in ast.parse(source).body if isinstance(block, ast.If) for node in block.body)
    homes = {name.name: str(node.module) for node in below if isinstance(node, ast.ImportFrom) for name in node.names}
    names = sorted(homes.keys() - {"__version__"})

    @cache  # a loop may ask for a name each time
    def find(name: str) -> Any:
        if name in packages:
            return import_module(f"{package}.{name}")
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        return getattr(import_module(homes[name]), name)

    return find, lambda: sorted([*names, *packages]), names
