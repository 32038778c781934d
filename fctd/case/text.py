"""The user's texts (names, keys, values, paths, messages that quote them), made safe for terminal and file names."""

import io
import re
import sys

_LONGEST_NAME = 100  # bytes of a text in a file name, whose limit is 255 with endings and scratch names


def printable(text: str) -> str:
    """The text on a terminal: each character that does not print is shown as its escape, such as ``\\x1b`` or ``\\n``.

    Python's ``str.isprintable`` decides: control characters, marks of direction and lone surrogates do not print.
    """
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def printable_lines(text: str) -> str:
    """As `printable`, but line ends are kept: for texts of several lines, such as a message."""
    return "\n".join(map(printable, text.split("\n")))


def counted(count: int, noun: str) -> str:
    """A count with its noun: "1 row", "2 rows", "0 stretches"; noun : in the singular, of a regular plural."""
    ending = "" if count == 1 else "es" if noun.endswith("ch") else "s"
    return f"{count} {noun}{ending}"


def file_name(text: str, ending: str) -> str:
    """A name for a file or folder of this process's file system: letters, digits and dashes, then the ending.

    Dots turn into dashes, so that no name is hidden, leads upwards, or is that of a device.
    """
    encoding = sys.getfilesystemencoding()
    encodable = text.encode(encoding, errors="replace").decode(encoding)
    safe = re.sub(r"[^\w-]+", "-", encodable).strip("-").encode(encoding)[:_LONGEST_NAME]
    return (safe.decode(encoding, errors="ignore") or "case") + ending


def is_utf8(text: str) -> bool:
    """Whether a text, as Python reads it from a command line or a folder, came in UTF-8 (has no lone surrogate)."""
    return not any("\ud800" <= c <= "\udfff" for c in text)


def degrade_output() -> None:
    """Make standard output and error write characters that their encoding lacks as escapes, instead of failing."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper) and stream.errors in ("strict", "surrogateescape"):
            stream.reconfigure(errors="backslashreplace")
