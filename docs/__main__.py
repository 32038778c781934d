"""``python -m docs``: write the table of keys and the pictures of README and guides."""

from pathlib import Path

from docs import keys, pictures

FOLDER = Path(__file__).parent

if __name__ == "__main__":
    (FOLDER / "keys.md").write_text(keys.page(), encoding="utf-8")
    print("docs/keys.md")
    for name in pictures.PICTURES:
        if name in pictures.FROM_STUDY and not pictures.STUDY.is_dir():
            print(f"left as it is: docs/pictures/{name}.png, drawn after python -m validation volve_f4")
            continue
        print(pictures.draw(name, FOLDER / "pictures").relative_to(FOLDER.parent))
