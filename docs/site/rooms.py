"""Directives of the API pages: ``public``, the public names of a package, and ``room``, all of its modules."""

import inspect
import pkgutil
from importlib import import_module

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata


def modules(package: str) -> list[str]:
    """The modules of a package and of the packages in it, by name."""
    found = pkgutil.walk_packages(import_module(package).__path__, f"{package}.")
    return sorted(each.name for each in found if not each.name.endswith(".__main__"))


def directive_for(package: str, name: str) -> str:
    """What describes a public name of a package."""
    thing = getattr(import_module(package), name)
    if inspect.isclass(thing):
        return f".. autoclass:: {package}.{name}\n"
    if inspect.isfunction(thing):
        return f".. autofunction:: {package}.{name}\n"
    return f".. py:data:: {package}.{name}\n"


class Public(SphinxDirective):
    """``.. public:: fctd.plots``: the docstring of a package, and all that its ``__all__`` names."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """The descriptions one after the other."""
        package = self.arguments[0]
        parts = [f".. automodule:: {package}\n   :no-members:\n   :no-index:\n"]
        parts += [directive_for(package, name) for name in import_module(package).__all__]
        return self.parse_text_to_nodes("\n".join(parts))


class Room(SphinxDirective):
    """``.. room:: fctd.mechanics``: a section for each module, with its functions and classes."""

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """The docstring of the package and the sections."""
        package = self.arguments[0]
        parts = [f".. automodule:: {package}\n   :no-members:\n"]
        for name in modules(package):
            title = f"``{name}``"
            parts.append(f"{title}\n{'-' * len(title)}\n\n.. automodule:: {name}\n")
        return self.parse_text_to_nodes("\n".join(parts), allow_section_headings=True)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Add the directives."""
    app.add_directive("public", Public)
    app.add_directive("room", Room)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
