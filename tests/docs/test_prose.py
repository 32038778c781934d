"""Guides and help texts are plain: sentences of at most 40 words, and none of the words that only this project used.

CONTRIBUTING, which holds the page of style, keeps its limit of 30.
"""

import re
from pathlib import Path

import pytest
import typer.main

from fctd.cli import main
from tests.docs.prose import sentences, text_of, words

ROOT = Path(__file__).parents[2]
LONGEST = 40
GUIDES = [
    ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks" / "KERNELS.md", *(ROOT / "docs").rglob("*.md"),
    *(path for suffix in ("py", "toml") for path in (ROOT / "examples").glob(f"*.{suffix}")),
]  # fmt: skip
# Told for given, said for shown, so many for a number, the same of for a function's twin.
DIALECT = re.compile(r"\b(told|said|so (many|much|often|long|far)(?! as)|the same of|with care|all the same)\b", re.I)


def test_sentences_are_short_and_plain() -> None:
    wrong = []
    for guide in GUIDES:
        text = text_of(guide)
        wrong += [(guide.name, one) for one in sentences(text) if words(one) > LONGEST]
        wrong += [(guide.name, match[0]) for match in DIALECT.finditer(text)]
    assert wrong == []


def test_the_page_of_style_keeps_its_own_rules() -> None:
    """Its limit of 30 words holds for all of CONTRIBUTING, and for what it gives as the better sentence."""
    text = text_of(ROOT / "CONTRIBUTING.md")
    pairs = [row.strip("|").split(" | ") for row in text.partition("## Style")[2].splitlines() if row.startswith("| ")]
    better = [after for _, _, after in pairs[1:]]
    assert len(better) >= 20
    assert [one for one in sentences("\n\n".join([text, *better])) if words(one) > 30] == []
    assert [match[0] for after in better for match in DIALECT.finditer(after)] == []


def test_help_texts_are_plain() -> None:
    """They have a subject, and say what an option is rather than of what."""
    app = typer.main.get_group(main.app)
    context = typer.Context(app)
    commands = [app.get_command(context, name) for name in app.list_commands(context)]
    texts = [
        text or ""
        for command in commands
        for text in (command.help, *(getattr(option, "help", None) for option in command.params))
    ]
    assert len(texts) > 100
    wrong = [text for text in texts if DIALECT.search(text) or text.startswith("Of ")]
    assert wrong == []


@pytest.mark.parametrize(("text", "expected"), [
    ("One. Two, e.g. this one, as Eq. 3 says. 3.11 to 3.14. `fctd` runs (yes!). So does Python 3.", 5),
    ("# Heading\nOne sentence\nover lines.\n\n- an item: of a list\n- another. One\n  more.\n", 5),
    ("A [link. Of two](https://a.b/c. D) sentences.\n\n| a. B | table. C |\n|---|---|\n\n```sh\ncode. Here\n```\n", 2),
    ("A formula $a. B$ and\n\n$$\nx. Y\n$$\n\n> quoted text\n> goes on.\n\n![A picture. Two](a.png)\n", 2),
    ("He said \"no.\" Then 5.5 m. of pipe", 2),
])  # fmt: skip
def test_sentences_are_found(text: str, expected: int) -> None:
    assert len(list(sentences(text))) == expected


def test_words_are_counted_without_marks() -> None:
    assert words("A – b: 3.5 m, “c”; – ( ) d/e") == 6
    assert words(next(iter(sentences("Code of `three words here` and $x + y$ is one word.")))) == 8
    assert text_of(ROOT / "examples" / "my_well.toml").count("=") < 5
