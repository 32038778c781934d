"""The process that reads and solves: each request has an answer, whatever it asks."""

import base64
import io
import json
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any
from unittest.mock import Mock

import pytest

from fctd.app import worker
from fctd.app.sessions import Source
from fctd.app.worker import KEPT_WELLS, Wells, answer, serve
from tests.app.made import NAME, SURVEY, TEXT, source


def request(do: str, given_source: Source, *, whole: bool = True, **given: Any) -> dict[str, Any]:
    content = {
        "text": given_source.text, "name": given_source.survey_name,
        "survey": base64.b64encode(given_source.survey).decode(),
    }  # fmt: skip
    about = {"do": do, "digest": given_source.digest, "units": "si", "given": given}
    return about | ({"source": content} if whole else {})


def test_a_source_is_sent_once(tmp_path: Path) -> None:
    wells = Wells(tmp_path)
    assert answer(wells, request("open", source(), whole=False)) == {"unknown": True}
    assert answer(wells, request("open", source()))["found"]["name"] == NAME
    assert "found" in answer(wells, request("open", source(), whole=False))
    for k in range(KEPT_WELLS):
        answer(wells, request("open", source(TEXT + f"# {k}")))
    assert answer(wells, request("open", source(), whole=False)) == {"unknown": True}


@pytest.mark.parametrize(
    "text",
    ["", "=", "a." * 5000 + "b = 1", TEXT.replace('"survey.csv"', '"/etc/passwd"'), TEXT.replace('"0.16 m"', '"-1 m"')],
)
def test_a_case_that_cannot_be_used_is_refused(text: str, tmp_path: Path) -> None:
    found = answer(Wells(tmp_path), request("open", source(text)))
    assert set(found) == {"refused"}
    assert "root:" not in found["refused"]
    json.dumps(found)


def test_operations_to_add_are_read_in_this_process(tmp_path: Path) -> None:
    """Whose memory and time have limits, as those of the server have not."""
    wells, asked = Wells(tmp_path), request("text", source()) | {"given": {"values": {}, "more": "a." * 40_000 + "a=1"}}
    assert "operations in TOML (line 1 has a key of more than 16 parts)" in answer(wells, asked)["refused"]
    asked["given"]["more"] = "[[operations]]\nkind = 'trip_in'"
    assert tomllib.loads(answer(wells, asked)["found"]["text"])["operations"][-1] == {"kind": "trip_in"}


def test_a_defect_and_a_lack_of_memory_are_answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for error, words in (
        (MemoryError(), "1024 MiB"), (RecursionError(), "memory"), (KeyError("x\x1b[31m"), "KeyError: 'x\\x1b[31m'"),
    ):  # fmt: skip
        monkeypatch.setitem(worker.OTHERS, "new_case", Mock(side_effect=error))
        assert words in answer(Wells(tmp_path), {"do": "new_case"})["refused"]
    assert "refused" in answer(Wells(tmp_path), {"do": "nothing"})
    assert "refused" in answer(Wells(tmp_path), {})


def test_it_is_ready_and_then_answers_line_by_line(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    limits = list[int]()
    monkeypatch.setattr(worker, "limit_memory", limits.append)
    survey = base64.b64encode(SURVEY).decode()
    asked = {"do": "new_case", "given": {"name": "s.csv", "survey": survey, "given_units": "si"}}
    answers = io.BytesIO()
    serve(tmp_path, io.BytesIO(json.dumps(asked).encode() + b"\n"), answers)
    *_, ready, found = map(json.loads, answers.getvalue().splitlines())
    assert ready == {"ready": True}
    assert 'survey = "s.csv"' in found["found"]["text"]
    assert limits == [2**30]


@pytest.mark.slow
def test_memory_has_a_limit() -> None:
    pytest.importorskip("resource")
    program = (
        "from fctd.app.worker import limit_memory; limit_memory(600 * 2**20)\n"
        "try: bytearray(700 * 2**20)\nexcept MemoryError: print('refused')"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "refused"
