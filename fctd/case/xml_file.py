"""WITSML files: XML without a document type, and its elements by names without their namespace."""

from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from fctd.case.errors import InputError


def read_xml(text: str, noun: str) -> Element:
    """The root element; noun : what the file should be, for messages.

    A document type is refused: its entities could fill the memory.  Raises InputError for a text that is not XML.
    """
    if "<!DOCTYPE" in text:
        raise InputError(f"{noun} without a document type (DOCTYPE)")
    try:
        return ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError) as error:
        raise InputError(f"{noun} in XML ({error})") from error


def has_doctype(content: bytes) -> bool:
    """Whether a file has a document type, in any letters and in UTF-8 or UTF-16."""
    upper = content.upper()
    return any("<!DOCTYPE".encode(encoding) in upper for encoding in ("ascii", "utf-16-le", "utf-16-be"))


def tag(element: Element) -> str:
    """The name of an element without its namespace, which is that of the version."""
    return str(element.tag).rpartition("}")[2]


def child(element: Element, name: str) -> Element | None:
    """The first element of a name inside another."""
    return next((inner for inner in element if tag(inner) == name), None)


def text_of(element: Element | None) -> str:
    """The text of an element without blanks around it, "" where there is none."""
    return "" if element is None else (element.text or "").strip()
