"""Settings of the docs site, which Sphinx reads: ``make docs`` writes it to docs/out."""

import os
from importlib.metadata import version as version_of

# Without compilation a function keeps its docstring and its source.
os.environ["NUMBA_DISABLE_JIT"] = "1"

project = "FCTD"
author = "the authors of FCTD"
project_copyright = author
release = version = version_of("fctd")
language = "en"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.viewcode",
    "docs.site.equations",
    "docs.site.docstrings",
    "docs.site.pages",
    "docs.site.rooms",
]
exclude_patterns = ["out"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = False

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_default_options = {"members": True}
python_maximum_signature_line_length = 100
autodoc_use_type_comments = False
toc_object_entries = False  # the sidebar shows modules
add_module_names = False
# A public name stands under its package and under the module that has it: a link may lead to either.
suppress_warnings = ["ref.python"]
html_math_renderer = "mathml"

html_theme = "furo"
html_title = f"FCTD {version}"
html_theme_options = {"navigation_with_keys": True}
html_copy_source = html_show_sourcelink = False
html_show_copyright = html_show_sphinx = False
# A summary is fetched from the page that was found, which a browser refuses for files of a disk.
html_show_search_summary = False
