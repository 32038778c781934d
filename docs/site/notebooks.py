"""Notebooks as pages: their text, and the code of their cells."""

import json
from pathlib import Path
from typing import Any


def cells(path: Path) -> list[tuple[str, str]]:
    """Kind ("markdown" or "code") and text of each cell."""
    notebook: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return [(cell["cell_type"], "".join(cell["source"])) for cell in notebook["cells"]]


def as_markdown(path: Path) -> str:
    """A notebook as a guide is written."""
    return "\n\n".join(text if kind == "markdown" else f"```python\n{text}\n```" for kind, text in cells(path))
