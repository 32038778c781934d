"""Every equation of the theory has the functions that compute it, and none of the paper's that the code names lacks."""

import ast
import re
from pathlib import Path

from .test_architecture import found

ROOT = Path(__file__).parents[2]
TEXT = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
PARTS = [part.strip() for part in re.split(r"\n\n+", TEXT)]
EQUATIONS = [at for at, part in enumerate(PARTS) if part.startswith("$$")]
NAME = re.compile(r"`((?:fctd|references)(?:\.\w+)+)`")


def numbers(text: str) -> set[int]:
    """Numbers of equations of the paper in a text: Eq. 10, Eqs 5–6, Eqs 5 and 14."""
    some: set[int] = set()
    for first, sign, last in re.findall(r"\bEqs?\.? (\d+)(?:( and |, |–)(\d+))?", text):
        some |= set(range(int(first), int(last) + 1)) if sign == "–" else {int(n) for n in (first, last) if n}
    return some


def test_an_equation_is_a_paragraph() -> None:
    assert len(EQUATIONS) > 40
    for at in EQUATIONS:
        assert PARTS[at].endswith("$$")
        assert PARTS[at].count("$$") == 2


def test_an_equation_names_its_functions() -> None:
    """In the paragraph after it, and they are there and can be called."""
    for at in EQUATIONS:
        after = PARTS[at + 1]
        names = NAME.findall(after)
        assert names, PARTS[at]
        assert after.startswith("Functions: " if len(names) > 1 else "Function: "), after
        assert [name for name in names if not callable(found(name))] == [], after


def test_the_numbered_equations_of_the_code_are_there() -> None:
    """Those that docstrings of the engine name."""
    named: set[int] = set()
    for path in (ROOT / "fctd").rglob("*.py"):
        source = path.read_text(encoding="utf-8")
        if not numbers(source):
            continue  # parsing takes its time
        for node in ast.walk(ast.parse(source)):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                named |= numbers(ast.get_docstring(node) or "")
    assert named >= {1, 2, 11, 15, 16, 20, 24}
    assert named - numbers(TEXT) == set()


def test_numbers_of_equations_are_read() -> None:
    assert numbers("(Eq. 10, Eqs 5–7; Eqs 13 and 14; Eqs 21–23)") == {10, 5, 6, 7, 13, 14, 21, 22, 23}
