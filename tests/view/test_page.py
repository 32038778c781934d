"""The page of a view: one file without a network, whole, the same twice."""

import base64
import json
import re
from pathlib import Path

import numpy as np
import pytest

from fctd.case.errors import InputError
from fctd.view import page
from tests.view.made import strings

WARNING = "survey.csv: <script>alert(1)</script>"


def content_of(text: str) -> dict[str, object]:
    """What the code of the page reads."""
    found = re.search(r'<script type="application/json" id="fctd-data">(.*?)</script>', text, re.DOTALL)
    assert found is not None
    return dict(json.loads(found[1]))


def test_a_page_is_one_file_that_needs_no_network(tmp_path: Path) -> None:
    first, second = tmp_path / "a.html", tmp_path / "b.html"
    for path in (first, second):
        assert page.save_view(strings(), path, "tension", warnings=[WARNING]) == [path]
    text = first.read_text(encoding="utf-8")
    assert first.read_bytes() == second.read_bytes()
    assert not re.search(r"<(?:script|img)[^>]+(?:src|href)=", text)
    assert re.findall(r"<link[^>]+>", text) == ['<link rel="icon" href="data:,">']
    assert not re.search(r"@[A-Z]+@", text)
    # Texts from outside as they stand.
    assert "<a href=" not in text.split("<style>")[0]
    assert "&lt;a href" in text.split("<style>")[0]
    assert "<script>alert" not in text
    assert "&lt;script&gt;alert(1)" in text


def test_the_page_holds_every_string(tmp_path: Path) -> None:
    made = strings()
    (path,) = page.save_view(made, tmp_path / "view.html", units="field")
    content = content_of(path.read_text(encoding="utf-8"))
    counts = content["counts"]
    assert counts == [len(one.offset) for one in made.snapshots]
    columns = content["columns"]
    assert isinstance(columns, dict)
    for name in page.COLUMNS:
        found = np.frombuffer(base64.b64decode(columns[name]), "<f4")
        np.testing.assert_allclose(found, np.concatenate([one.columns[name] for one in made.snapshots]), rtol=1e-6)
    groups = content["groups"]
    assert isinstance(groups, list)
    assert [group["label"] for group in groups] == ["picking up", "slacking off"]
    assert groups[0]["steps"][0]["where"] == "bit at 1312.3 ft"


def test_too_many_strings_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "MOST_POINTS", 100)
    with pytest.raises(InputError, match="fewer depths"):
        page.save_view(strings(), tmp_path / "view.html")
    assert not (tmp_path / "view.html").exists()
