"""The sentences of guides, and of the texts in examples, for the tests of their prose."""

import io
import re
import tokenize
from collections.abc import Iterator
from pathlib import Path

# A full stop after these ends no sentence.
_ABBREVIATIONS = ("e.g.", "i.e.", "cf.", "etc.", "al.", "vs.", "Eq.", "Eqs.", "Fig.", "Figs.", "Sec.", "No.", "pp.")
# A mark, and what closes quotes or brackets after it, before a word that does not begin with a small letter.
_END = re.compile(r"(?<=[.!?])([\"')\]”*_]*)\s+(?=[^a-zα-ω\s])")


def paragraphs(markdown: str) -> list[str]:
    """Paragraphs, headings and items of lists, without code blocks, tables, pictures and comments."""
    text = re.sub(r"^(```|~~~|:::).*?^\1\s*$", "\n", markdown, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"<!--.*?-->|^\$\$.*?\$\$", "\n", text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^[ \t]*(\||!\[|---|===).*$", "\n", text, flags=re.MULTILINE)
    text = re.sub(r"^[ \t]*> ?", "", text, flags=re.MULTILINE)
    text = re.sub(r"^#+\s+(.*)$", r"\n\n\1\n\n", text, flags=re.MULTILINE)
    text = re.sub(r"^[ \t]*(?:[-*+]|\d+\.)[ \t]+", "\n\n", text, flags=re.MULTILINE)
    return [" ".join(part.split()) for part in re.split(r"\n\s*\n", text) if part.strip()]


def sentences(markdown: str) -> Iterator[str]:
    """Sentences of a Markdown text; code or a formula within a line is one word, and a link is its text."""
    for paragraph in paragraphs(markdown):
        text = re.sub(r"`[^`]*`|\$[^$]+\$", "CODE", paragraph)
        text = re.sub(r"\[([^\]]*)\](?:\([^)]*\)|\[[^\]]*\])", r"\1", text)
        for abbreviation in _ABBREVIATIONS:
            text = re.sub(rf"\b{re.escape(abbreviation)}(?=\s)", abbreviation.replace(".", ""), text)
        yield from filter(words, _END.sub(r"\1\n", text).split("\n"))


def words(sentence: str) -> int:
    """Number of words and numbers."""
    return sum(any(character.isalnum() for character in word) for word in sentence.split())


def text_of(path: Path) -> str:
    """The text of a guide; of an example its comments, and its docstrings."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".toml":
        return re.sub(r"^(?!#).*$|^#+ ?", "", text, flags=re.MULTILINE)
    return _text_of_code(text) if path.suffix == ".py" else text


def _text_of_code(source: str) -> str:
    """Comments, of which lines below each other are one paragraph, and docstrings."""
    parts, row = [], -1
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type == tokenize.COMMENT:
            parts += ["" for _ in range(token.start[0] != row + 1)] + [token.string.lstrip("# ")]
            row = token.start[0]
        elif token.type == tokenize.STRING and token.string.startswith('"""'):
            parts += ["", token.string.strip('"'), ""]
    return "\n".join(parts)
