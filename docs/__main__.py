"""``python -m docs``: write the tables of keys and columns, and the pictures of README and guides."""

from pathlib import Path

from docs import columns, keys, pictures, tutorial
from fctd.view.still import browser_path

FOLDER = Path(__file__).parent

if __name__ == "__main__":
    for made in keys, columns:
        name = f"{made.__name__.rpartition('.')[2]}.md"
        (FOLDER / name).write_text(made.page(), encoding="utf-8")
        print(f"docs/{name}")
    for name in pictures.PICTURES:
        if name in pictures.FROM_STUDY and not pictures.STUDY.is_dir():
            print(f"left as it is: docs/pictures/{name}.png, drawn after python -m validation volve_f4")
            continue
        print(pictures.draw(name, FOLDER / "pictures").relative_to(FOLDER.parent))
    for command in tutorial.commands():
        if "--png" in command and browser_path() is None:
            print(f"left as it is, for it needs a browser: {command}")
            continue
        for drawn in tutorial.draw(command, FOLDER / "pictures"):
            print(drawn.relative_to(FOLDER.parent))
