"""Labels at the ends of curves: within the panel, clear of each other and of each other's lines."""

from hypothesis import given
from hypothesis import strategies as st

from fctd.plots.labels import AIR, CLEAR, GAP, MARKER, SAME, place, width_of

WIDTH = 300.0
TEXTS = ["picking up", "rotating off bottom", "slacking off", "back-reaming", "drilling", "sliding"]


@given(st.lists(st.floats(0, WIDTH), min_size=1, max_size=6))
def test_no_label_covers_another_or_a_line(ends: list[float]) -> None:
    texts = TEXTS[: len(ends)]
    found = place(ends, texts, WIDTH)
    if found is None:
        return
    spans = []
    for x, text, label in zip(ends, texts, found, strict=True):
        near, far = (x + GAP, x + GAP + width_of(text)) if label.right else (x - GAP - width_of(text), x - GAP)
        assert near >= 0
        assert far <= WIDTH
        spans.append((min(near, x - MARKER), max(far, x + MARKER)))
    for k, one in enumerate(found):
        for j, other in enumerate(found):
            if k == j:
                continue
            meet = spans[k][0] < spans[j][1] + AIR and spans[j][0] < spans[k][1] + AIR
            assert not (meet and one.level == other.level)
            # The line of a deeper label passes the text of a higher one.
            inside = spans[k][0] - CLEAR < ends[j] < spans[k][1] + CLEAR and abs(ends[j] - ends[k]) >= SAME
            assert not (inside and other.level > one.level)


def test_curves_whose_ends_look_the_same_are_named_in_their_order() -> None:
    found = place([10.0, 10.1, 9.9], ["a", "b", "c"], WIDTH)
    assert found is not None
    assert [label.level for label in found] == [0, 1, 2]


def test_labels_far_apart_stand_on_one_level() -> None:
    found = place([10.0, 110.0, 210.0], ["a", "b", "c"], WIDTH)
    assert found is not None
    assert {label.level for label in found} == {0}


def test_curves_with_one_end_are_listed_below_each_other() -> None:
    found = place([5.0] * 6, TEXTS, WIDTH)
    assert found is not None
    assert sorted(label.level for label in found) == [0, 1, 2, 3, 4, 5]


def test_a_text_wider_than_the_panel_does_not_fit() -> None:
    assert place([150.0], ["x" * 80], WIDTH) is None


def test_letters_without_an_outline_or_that_the_font_lacks_have_a_width() -> None:
    """A warning would be an error here."""
    assert width_of("\u200b") == 0.0
    assert width_of("水") > 0.0
    assert width_of("$5 to $6") == width_of("05 to 06")
