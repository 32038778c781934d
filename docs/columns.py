"""The page of the columns of results, made from the table of columns."""

from fctd.results.columns import TABLES, Column, meaning_of
from fctd.results.shown_tables import heading_of
from fctd.results.unit_systems import shown_if_any

HEAD = """# The columns of results

`python -m docs` makes this page from `fctd/results/columns.py`. Tables in Python and in Parquet files are in SI units:
the name of a column ends in its unit. Screens, pictures, workbooks and reports show it in the units beside it. The
[conventions](conventions.md) say what signs and angles mean.
"""
TITLES = {
    "chart": "A chart, a row for each operation, friction and depth",
    "profile": "A profile, a row for the upper end and for each contact point",
    "history": "The history of a run, a row for each record interval",
}


def page() -> str:
    """The whole page as Markdown: a section for each table."""
    head = "| column | shown in | field units | meaning |\n|---|---|---|---|\n"
    return "\n".join([HEAD, *(f"## {TITLES[name]}\n\n{head}{''.join(map(_row, of))}" for name, of in TABLES.items())])


def _row(column: Column) -> str:
    si, field = (shown_if_any(column.name, units).label for units in ("si", "field"))
    si = si or heading_of(column.name).head.unit
    return f"| `{column.name}` | {si} | {field or si} | {meaning_of(column)} |\n"
