"""The notebooks run, cell by cell; with the doctests they show every public function."""

import ast
import doctest
import inspect
import json
import shutil
from pathlib import Path
from types import FunctionType
from typing import Any

import pytest

import fctd
from docs.site.notebooks import as_markdown, cells

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
NOTEBOOKS = sorted(EXAMPLES.glob("*.ipynb"))
FUNCTIONS = {name: of for name in fctd.__all__ if isinstance(of := getattr(fctd, name), FunctionType)}


def code(notebook: Path) -> list[str]:
    """The code cells."""
    return [text for kind, text in cells(notebook) if kind == "code"]


def run(cell: str, names: dict[str, Any]) -> object:
    """Run a cell; the value of its last expression, which a notebook shows."""
    tree = ast.parse(cell)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    return eval(compile(ast.Expression(last.value), "cell", "eval"), names) if isinstance(last, ast.Expr) else None


def looks(value: object) -> list[object]:
    """How a notebook shows a value."""
    ways = (getattr(value, way, None) for way in ("_repr_png_", "_repr_html_", "__repr__"))
    return [way() for way in ways if way is not None]


@pytest.mark.slow
@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(notebook: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In its own folder, as a server of notebooks does."""
    shutil.copytree(EXAMPLES, tmp_path / "examples", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.chdir(tmp_path / "examples")
    names: dict[str, Any] = {"__name__": "__main__"}
    shown = [looks(value) for cell in code(notebook) if (value := run(cell, names)) is not None]
    assert len(shown) >= 5
    assert all(all(ways) for ways in shown)


@pytest.mark.parametrize("notebook", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_without_outputs(notebook: Path) -> None:
    kept = json.loads(notebook.read_text(encoding="utf-8"))
    assert (kept["nbformat"], kept["nbformat_minor"]) == (4, 5)
    assert len({cell["id"] for cell in kept["cells"]}) == len(kept["cells"])
    assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in kept["cells"] if "outputs" in cell)
    assert len(code(notebook)) == 10
    assert notebook.stat().st_size < 12_000


def test_there_are_two_and_the_site_shows_them() -> None:
    from docs.site.pages import with_notebooks

    assert [notebook.stem for notebook in NOTEBOOKS] == ["a_well", "own_contact"]
    for notebook in NOTEBOOKS:
        page = ROOT / "docs" / "project" / f"{notebook.stem}.md"
        text = with_notebooks(page.read_text(encoding="utf-8"), page.parent)
        assert text.strip() == as_markdown(notebook)
        assert text.startswith("# ")
        assert text.count("```python\n") == 10


def documented(function: FunctionType) -> bool:
    return bool(doctest.DocTestParser().get_examples(inspect.getdoc(function) or ""))


def test_every_public_function_has_a_doctest_or_stands_in_a_notebook() -> None:
    trees = [ast.parse(cell) for notebook in NOTEBOOKS for cell in code(notebook)]
    used = {
        node.attr
        for tree in trees
        for node in ast.walk(tree)
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "fctd"
    }
    assert {name for name, function in FUNCTIONS.items() if not documented(function)} - used == set()


@pytest.mark.parametrize("name", [name for name, function in FUNCTIONS.items() if documented(function)])
def test_a_doctest_holds(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    (example,) = doctest.DocTestFinder(recurse=False).find(FUNCTIONS[name], name, globs={"fctd": fctd})
    assert doctest.DocTestRunner().run(example).failed == 0
