"""The reader of WITSML files."""

import pytest

from fctd.case.errors import InputError
from fctd.case.xml_file import child, read_xml, tag, text_of


def test_elements_have_names_without_their_namespace() -> None:
    root = read_xml('<logs xmlns="http://www.witsml.org/schemas/1series"><log> a </log></logs>', "a log")
    assert tag(root) == "logs"
    assert text_of(child(root, "log")) == "a"
    assert text_of(child(root, "other")) == ""


@pytest.mark.parametrize("text", ["<log>", '<!DOCTYPE x [<!ENTITY a "b">]><log>&a;</log>'])
def test_what_is_no_plain_xml_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="a log"):
        read_xml(text, "a log")
