"""``python -m docs``: write the table of keys and the pictures of README and guides."""

from pathlib import Path

from docs import keys, pictures, tutorial
from fctd.view.still import browser_path

FOLDER = Path(__file__).parent

if __name__ == "__main__":
    (FOLDER / "keys.md").write_text(keys.page(), encoding="utf-8")
    print("docs/keys.md")
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
