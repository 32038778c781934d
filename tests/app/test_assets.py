"""Scripts and styles of the page: its own files alone, for parts that are there."""

import re
from pathlib import Path

import fctd.app
from tests.app.test_page import walk

ASSETS = Path(fctd.app.__file__).parent / "assets"
SCRIPT, STYLE = (ASSETS / f"app.{kind}" for kind in ("js", "css"))


def test_nothing_is_fetched_from_elsewhere_or_made_of_text() -> None:
    for path in ASSETS.iterdir():
        text = path.read_text("utf-8")
        assert not re.search(r"https?:|//\w+\.|@import|url\(", text), path
        assert not re.search(r"\beval\b|new Function|innerHTML|document\.write|insertAdjacentHTML", text), path


def test_styles_and_scripts_name_parts_of_the_page() -> None:
    from fctd.app import page  # slow to import

    parts = walk(page.layout())
    names = {part.id for part in parts if hasattr(part, "id")}
    colours = re.compile(r"#[0-9a-fA-F]{3,6}\b")
    for name in re.findall(r"#([a-z-]+)", colours.sub("", STYLE.read_text("utf-8"))):
        assert name in names, name
    for name in re.findall(r'set\("([a-z-]+)"', SCRIPT.read_text("utf-8")):
        assert name in names, name
    classes = {word for part in parts for word in getattr(part, "className", "").split()} | {"slider", "name"}
    for name in re.findall(r"\.([a-z]+)[ ,.:{]", re.sub(r"\{[^}]*\}", "{", STYLE.read_text("utf-8"))):
        assert name in classes, name
