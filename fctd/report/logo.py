"""A company's logo: a small picture, read as a whole before anything is computed."""

import io
import warnings
from pathlib import Path
from typing import Final

from fctd.case.errors import InputError
from fctd.case.input_file import check_regular

LARGEST: Final = 4 * 2**20  # bytes of a file
WIDEST: Final = 4000  # pixels
KEPT: Final = 600  # pixels of the logo in a report


def read_logo(path: Path, key: str = "--logo") -> bytes:
    """A picture, PNG or JPEG, as PNG of at most ``KEPT`` pixels; raises InputError for a file that is none."""
    from PIL import Image, UnidentifiedImageError

    expected = f"a PNG or JPEG of at most {LARGEST // 2**20} MiB and {WIDEST} by {WIDEST} pixels"
    try:
        check_regular(path, key)
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise InputError(f"{expected} that can be read ({error.strerror or error})", key=key, value=path) from None
    if len(content) > LARGEST:
        raise InputError(expected, key=key, value=path)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # of a picture that is a bomb
            with Image.open(io.BytesIO(content), formats=("PNG", "JPEG")) as picture:
                if max(picture.size) > WIDEST:
                    raise InputError(expected, key=key, value=path)
                drawn = picture.convert("RGBA")
    except InputError:
        raise
    except (UnidentifiedImageError, OSError, ValueError, SyntaxError, Warning, Image.DecompressionBombError):
        raise InputError(expected, key=key, value=path) from None
    drawn.thumbnail((KEPT, KEPT))
    kept = io.BytesIO()
    drawn.save(kept, "PNG")
    return kept.getvalue()
