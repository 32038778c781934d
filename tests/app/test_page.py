"""The page as it is sent: its parts, each with one name."""

from typing import Any

from fctd.app.downloads import FILES


def walk(part: Any) -> list[Any]:
    """A part of the page and all within it."""
    inner = getattr(part, "children", None)
    inner = inner if isinstance(inner, list | tuple) else [inner] if inner is not None else []
    return [part, *(found for one in inner for found in walk(one))]


def test_every_part_has_its_own_name() -> None:
    from fctd.app import page

    names = [part.id for part in walk(page.layout()) if hasattr(part, "id")]
    assert len(names) == len(set(names))
    assert {*page.GRAPHS, "upload", "sliders", "run", "stop", "fault", "note", "operations"} <= set(names)


def test_texts_from_outside_are_children_and_no_markup() -> None:
    from fctd.app import page

    text = "<script>alert(1)</script>"
    assert [part for part in walk(page.warned([text])) if part == text]
    assert page.warned([]) == []
    assert not [part for part in walk(page.layout()) if type(part).__name__ in ("Markdown", "DangerouslySetInnerHTML")]


def test_links_lead_to_the_files_of_the_session() -> None:
    from fctd.app import page

    links = [part for one in page.links("/t/s/k/") for part in walk(one) if hasattr(part, "href")]
    assert [link.href for link in links] == [f"/t/s/k/files/{name}" for name in FILES]


def test_a_slider_stands_at_its_value() -> None:
    from fctd.app import page

    one = {"name": "mud", "label": "mud density", "unit": "kg/m³", "low": 800, "high": 2200, "step": 10, "value": 1}
    parts = walk(page.slider(one, 1250.0))
    assert "1250" in parts
    assert " kg/m³" in parts
    (slider,) = [part for part in parts if hasattr(part, "updatemode")]
    assert (slider.min, slider.max, slider.value, slider.updatemode) == (800, 2200, 1250.0, "mouseup")
