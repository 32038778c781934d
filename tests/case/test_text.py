"""The user's texts: on the terminal, and in file names."""

import io
import os
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from fctd.case.text import counted, degrade_output, file_name, printable, printable_lines

ANYTHING = st.text(st.characters(categories=["L", "M", "N", "P", "S", "Z", "C"]), max_size=300)  # surrogates as well


def test_a_count_with_its_noun() -> None:
    assert [counted(count, "row") for count in (0, 1, 2)] == ["0 rows", "1 row", "2 rows"]
    assert [counted(count, "stretch") for count in (0, 1, 2)] == ["0 stretches", "1 stretch", "2 stretches"]


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("Brønn 7 – 8½ in, 井", "Brønn 7 – 8½ in, 井"),
        ("[/x] [bold]y :x: $\\frac{", "[/x] [bold]y :x: $\\frac{"),
        ("\x1b[31mred", "\\x1b[31mred"),
        ("\x1b]0;title\x07", "\\x1b]0;title\\x07"),
        ("\x9b31m\x7f\x00", "\\x9b31m\\x7f\\x00"),
        ("one\ntwo\rthree\bfour", "one\\ntwo\\rthree\\x08four"),
        ("a\u202eb\u2066c\u2069", "a\\u202eb\\u2066c\\u2069"),
        ("line\u2028end", "line\\u2028end"),
        ("name-\udcff", "name-\\udcff"),
    ],
)
def test_what_does_not_print_is_shown_as_its_escape(text: str, shown: str) -> None:
    assert printable(text) == shown


@settings(max_examples=100)
@given(ANYTHING)
def test_only_characters_that_print_are_left_and_those_stay(text: str) -> None:
    shown = printable(text)
    assert shown.isprintable()
    assert printable(shown) == shown
    left = iter(shown)
    assert all(character in left for character in text if character.isprintable())  # in their order


def test_the_lines_of_a_message_stay_lines() -> None:
    assert printable_lines("one\x1b\ntwo\r\n") == "one\\x1b\ntwo\\r\n"


@pytest.mark.parametrize(
    ("text", "name"),
    [
        ("Well 7: 8½ in / A", "Well-7-8½-in-A-result"),
        ("井", "井-result"),
        ("", "case-result"),
        ("...", "case-result"),
        ("../../etc/passwd", "etc-passwd-result"),
        (".hidden", "hidden-result"),
        ("--help", "help-result"),
        ("NUL.txt", "NUL-txt-result"),  # Windows takes NUL.txt for the device NUL
        ("a\x1b[31m\nb\udcff", "a-31m-b-result"),
    ],
)
def test_a_file_name_is_made_of_letters_digits_and_dashes(text: str, name: str) -> None:
    assert file_name(text, "-result") == name


@settings(max_examples=100)
@given(ANYTHING)
def test_any_text_gives_a_file_name_that_can_be_written(text: str) -> None:
    name = file_name(text, "-result")
    assert name.endswith("-result")
    assert name[0] not in ".-"
    assert not set(name) & set('/\\:*?"<>|')
    assert name.isprintable()
    assert len(os.fsencode(name)) <= 200


def test_a_file_name_holds_only_what_the_file_system_can_write(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "getfilesystemencoding", lambda: "ascii")
    assert file_name("Brønn 7", "-result") == "Br-nn-7-result"


@pytest.mark.parametrize(
    ("encoding", "errors", "written"),
    [
        ("ascii", "strict", b"kN\\xb7m, \\u03a3"),
        ("latin-1", "strict", b"kN\xb7m, \\u03a3"),
        ("ascii", "surrogateescape", b"kN\\xb7m, \\u03a3"),
        ("ascii", "replace", b"kN?m, ?"),  # as PYTHONIOENCODING asks for
        ("utf-8", "strict", "kN·m, Σ".encode()),
    ],
)
def test_output_shows_what_its_encoding_lacks_as_escapes(
    encoding: str, errors: str, written: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding, errors=errors)
    monkeypatch.setattr(sys, "stdout", stream)
    degrade_output()
    print("kN·m, Σ", end="", flush=True)
    assert stream.buffer.getvalue() == written


def test_output_that_is_closed_stays_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    degrade_output()
    assert sys.stdout is None
