"""The record of a probable mistake."""

from fctd.case.input_warnings import InputWarning


def test_a_warning_says_where_what_and_what_to_do() -> None:
    warning = InputWarning("no_mud", "mud.density", "there is \x1b no mud", "give one")
    assert str(warning) == "mud.density: there is \\x1b no mud: give one"
    assert InputWarning(**warning.as_metadata()) == warning
