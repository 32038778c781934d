"""Directives of the API pages: ``public``, the public names of a package, and ``room``, all of its modules."""

import inspect
import pkgutil
from importlib import import_module

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
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
        return f".. autoclass:: {package}.{name}\n   :inherited-members: BaseModel, BaseException, tuple\n"
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


def _lead_back(app: Sphinx, env: BuildEnvironment) -> None:
    """Links from a source lead to its module's own page, or to the public names of a package above where the module has
    none: Sphinx mixes the address of the one with the name of the other.  Modules that no page leads to are left out.
    """
    sources = env._viewcode_modules  # type: ignore[attr-defined]
    objects = env.domains.python_domain.objects.items()
    described = {name: found.docname for name, found in objects if not found.aliased}
    for module, entry in list(sources.items()):
        if not entry or not entry[2]:
            del sources[module]
            continue
        code, tags, used, _ = entry
        parts = module.split(".")
        for owner in (".".join(parts[:count]) for count in range(len(parts), 0, -1)):
            if all(f"{owner}.{name}" in described for name in used):
                pages = {name: described[f"{owner}.{name}"] for name in used}
                sources[module] = code, tags, pages, owner
                break


def setup(app: Sphinx) -> ExtensionMetadata:
    """Add the directives, and listen to what has been read."""
    app.connect("env-updated", _lead_back)
    app.add_directive("public", Public)
    app.add_directive("room", Room)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
