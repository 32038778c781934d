"""The page shows every study: finished, missed, failed, skipped and not run."""

import json
import re
import sys
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pandas as pd
import pytest

pytest.importorskip("jinja2")
pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from typer.testing import CliRunner

from reports import __main__ as command_line
from reports import page, results, sections
from validation.claims.ledger import CLAIMS
from validation.harness import registry, store, study
from validation.harness.store import Judged, Provenance, Record
from validation.harness.study import Check

from . import synthetic

ORIGIN = Provenance("0123abcd", {"fctd": "0.1.0", "numpy": "2.4.6"}, "Some CPU", 2)
BLANK = Record(
    study="overlap",
    question="Does the overlap close the gap?",
    status="finished",
    message="",
    checks=(),
    notes=(),
    display={},
    tables=(),
    quick=False,
    date="2025-01-02T03:04:05+00:00",
    wall_s=1.5,
    provenance=ORIGIN,
)


def judged(value, recorded=None, name="largest jump"):
    return Judged(Check(name, value, 1e-6, "at_most", "kN·m", "continuity <C⁰>"), recorded)


def finished(name, **changes):
    tables = synthetic.STUDIES[name]()
    return replace(BLANK, study=name, tables=tuple(tables), **changes), tables


def pages_of(out):
    """The first page, the claims, and the pages of the studies."""
    return [out / "index.html", out / "claims.html", *sorted((out / "studies").glob("*.html"))]


def study_page(tmp_path, name="overlap"):
    return tmp_path / "out" / "studies" / f"{name}.html"


@pytest.fixture
def render(tmp_path):
    (tmp_path / "claims.toml").write_text("claim = []")

    def call(*runs, studies=(), changes=None, ledger=tmp_path / "claims.toml"):
        for run, tables in runs:
            store.write(run, tables, tmp_path / "results")
        problems = page.render(tmp_path / "results", studies, tmp_path / "out", changes, ledger)
        return "".join(path.read_text(encoding="utf-8") for path in pages_of(tmp_path / "out")), problems

    return call


def words_of(html):
    """The text of the page: without tags, white space collapsed."""
    return re.sub(r"\s+", " ", re.sub(r"<style>.*?</style>|<[^>]+>", " ", html, flags=re.DOTALL))


def test_finished_study_has_question_checks_figure_notes_and_origin(render, tmp_path):
    run, tables = finished("overlap", checks=(judged(5e-7),), notes=("Mind the gap.",))
    html, problems = render((run, tables), studies=["overlap"])
    text = words_of(html)
    assert problems == []
    question = "Does the overlap close the gap?"
    first, page_of_it = (page.read_text() for page in (tmp_path / "out" / "index.html", study_page(tmp_path)))
    assert f'<a href="studies/overlap.html">{question}</a>' in first
    assert f"<h1>{question}</h1>" in page_of_it
    assert "largest jump 5 × 10⁻⁷ kN·m at most 1 × 10⁻⁶ kN·m ✓ met" in text
    assert "continuity &lt;C⁰&gt;" in html
    assert "Mind the gap." in text
    assert "full run of 2025-01-02 03:04 UTC" in text
    assert "commit 0123abcd" in text
    assert "Some CPU, 2 cores" in text
    assert (tmp_path / "out" / "figures" / "overlap-drag.svg").exists()
    assert (tmp_path / "out" / "figures" / "overlap-drag.png").exists()
    assert 'src="data:image/svg+xml;base64,' in html


def test_a_message_from_outside_is_text_on_the_page(render):
    broken = replace(BLANK, status="failed", message="OSError: <b>[/x]</b> {{ 7 * 6 }} data-\udcff")
    html, _ = render((broken, {}))
    assert r"OSError: &lt;b&gt;[/x]&lt;/b&gt; {{ 7 * 6 }} data-\udcff" in html


def test_verdicts_are_printed_in_words(render):
    checks = (
        judged(1.0, name="a"),
        judged(1.0, "missed: chords are chords", name="b"),
        judged(0.0, "old reason", name="c"),
        judged(float("nan"), name="d"),
    )
    text = words_of(render((replace(BLANK, checks=checks), {}), studies=["overlap"])[0])
    assert "✗ worse than recorded" in text
    assert "✗ missed (recorded)" in text
    assert "Recorded as missed: chords are chords" in text
    assert "✓ better than recorded" in text
    assert "d no number at most" in text
    assert "2 worse than recorded, 1 missed (recorded), 1 better than recorded" in text


def test_table_for_display_has_units_in_its_head(render):
    run, tables = finished("ownership", display={"owners": "Wrong owners"}, quick=True)
    text = words_of(render((run, tables))[0])
    assert "Wrong owners" in text
    assert "wrong owner %" in text
    assert "build to 120° 120 10 000 42.1" in text
    assert "quick run" in text


def test_skipped_failed_and_missing_studies_are_visible(render):
    skipped = replace(BLANK, study="volve", status="skipped", message="the public data folder is missing")
    failed = replace(BLANK, study="broken", status="failed", message="ArithmeticError: lost", question="")
    html, _ = render((skipped, {}), (failed, {}), studies=["volve", "broken", "absent"])
    text = words_of(html)
    # Those without a result stand together at the end of the first page, with how to run them.
    (index, *_) = html.split("</html>")
    end = words_of(index[index.index('<section id="absent"') :])
    assert "Q? ○ skipped" not in end
    assert "python -m validation volve" in end
    assert "python -m validation absent" in end
    assert "broken" not in end
    assert "○ skipped" in text
    assert "Skipped: the public data folder is missing" in text
    assert "✗ failed" in text
    assert "Failed: ArithmeticError: lost" in text
    assert "○ not run" in text
    assert "python -m validation absent" in text


def test_registry_order_then_what_else_was_found(render):
    runs = [(replace(BLANK, study=study, question=f"Q-{study}?"), {}) for study in ("a", "b", "c")]
    (index, *_) = render(*runs, studies=["c", "b"])[0].split("</html>")
    # No chapter names them: they stand in the last.
    assert re.findall(r'<li><a href="studies/(\w+).html">Q-', index) == ["c", "b", "a"]


def test_result_that_cannot_be_read_leaves_the_page(render, claims, tmp_path):
    run, tables = finished("overlap", checks=(judged(5e-7),))
    render((run, tables))
    results = tmp_path / "results"
    (results / "overlap" / "drag.parquet").write_text("no table")
    (results / "jumps" / "verdict.json").write_text("{")
    html, problems = render(studies=["overlap", "jumps"])
    assert [problem.partition(" cannot be read: ")[0] for problem in problems] == [
        "overlap: the result", "jumps: the result",
    ]  # fmt: skip
    assert "largest jump" in html  # its verdict is there
    assert words_of(html).count("cannot be read") == 2 + 5  # pages, claims that rest on jumps


@pytest.mark.parametrize(
    ("key", "value"),
    [("status", 3), ("display", None), ("display", {"gone": "A table"}), ("date", 3), ("wall_s", "long"),
     ("checks", [{"name": "error", "kind": 3, "recorded": None}])],
)  # fmt: skip
def test_a_verdict_of_another_shape_cannot_be_read(key, value, render, tmp_path):
    store.write(*finished("overlap"), tmp_path / "results")
    path = tmp_path / "results" / "overlap" / "verdict.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {key: value}))
    html, problems = render(studies=["overlap"])
    assert [problem.partition(" cannot be read: ")[0] for problem in problems] == ["overlap: the result"]
    assert "cannot be read" in words_of(html)


def test_a_study_without_tables_has_no_figures(render):
    html, problems = render((replace(BLANK, notes=("Not installed, and so not run: a package.",)), {}))
    assert problems == []
    assert "Not installed, and so not run" in html
    assert "<img" not in html


def test_figure_that_cannot_be_drawn_leaves_the_page(render, capsys):
    html, problems = render((replace(BLANK, checks=(judged(0.0),)), {}), studies=["overlap"])
    assert problems == ["overlap: figure 'drag' could not be drawn: KeyError: 'drag'"]
    assert "could not be drawn" in html
    assert "largest jump" in html
    assert "KeyError" in capsys.readouterr().err


LEDGER = """
[[claim]]
id = "good"
section = "5.2"
says = "No <gap> is left."
verdict = "holds"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 1.0
[claim.limited]
limit = "never told"
study = "jumps"
check = "largest jump"
at_most = 2.0
[[claim]]
id = "narrow"
section = "abstract, 4.2"
says = "Owners are found."
verdict = "holds with limits"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[claim.limited]
limit = "In gentle wells."
study = "jumps"
check = "largest jump"
at_most = 2.0
[claim.second_route]
study = "drops"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "narrow-by-one-route"
section = "4.3"
says = "Owners were counted."
verdict = "holds with limits"
because = "target"
one_route = "One number is printed."
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[claim.limited]
limit = "In wide wells."
study = "jumps"
check = "largest jump"
at_most = 2.0
[[claim]]
id = "wrong"
section = "6.3"
says = "It takes more."
verdict = "does not hold"
because = "target"
remark = "Mind the step."
[claim.number]
study = "jumps"
check = "largest jump"
at_least = 5.0
[claim.second_route]
study = "drops"
check = "largest jump"
at_least = 4.0
[[claim]]
id = "other"
section = "6.3"
says = "Recorded otherwise."
verdict = "holds"
because = "target"
[claim.number]
study = "jumps"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "absent"
section = "7"
says = "Torque is right."
because = "target"
[claim.number]
study = "ownership"
check = "largest jump"
at_most = 0.0
[[claim]]
id = "closed"
section = "7"
says = "It was measured."
verdict = "cannot be tested"
untestable = "The points are not public"
[[misprint]]
where = "Eq. 4"
printed = "r̃ω"
meant = "−r̃ω"
reason = "It turns the other way."
tests = ["tests/test_joints.py::test_a_hinge_moves_along"]
"""


@pytest.fixture
def claims(tmp_path, monkeypatch):
    """A ledger with a claim for every verdict, and the results that it is judged by."""
    (tmp_path / "claims.toml").write_text(LEDGER)
    for name, value in (("jumps", 0.5), ("drops", 0.75)):
        store.write(replace(BLANK, study=name, checks=(judged(value),)), {}, tmp_path / "results")
        monkeypatch.setitem(registry.STUDIES, name, "no.module")


def test_claims_stand_on_top_with_verdict_number_bound_and_study(render, claims, tmp_path):
    html, problems = render(studies=["jumps"])
    text = words_of(html)
    assert problems == []
    counts = "✓ holds: 1 ◐ holds with limits: 2 ✗ does not hold: 2 – cannot be tested: 1 ○ not yet run: 1"
    assert f"The paper's claims: {counts}" in text
    holds = "5.2 No &lt;gap&gt; is left. ✓ holds 0.5 kN·m (at most 1 kN·m) largest jump: jumps Bound: target."
    assert f"{holds} python -m validation jumps" in text
    assert "never told" not in text
    assert "abs., 4.2 Owners are found. ◐ holds with limits 0.5 kN·m (at most 0 kN·m: not met)" in text
    assert "Limit. In gentle wells. 0.5 kN·m (at most 2 kN·m) largest jump" in text
    # Next to the first number, before the bound.
    first = "0.5 kN·m (at most 0 kN·m: not met) largest jump: jumps"
    assert f"{first} Second route. 0.75 kN·m (at most 0 kN·m: not met) largest jump: drops Bound: target." in text
    assert f"{first} No second route. One number is printed. Bound: target." in text
    assert "Second route. 0.75 kN·m (at least 4 kN·m: not met) largest jump: drops Bound: target." in text
    assert "Mind the step." in text
    assert "✗ does not hold recorded: holds" in text
    assert "○ not yet run ownership has not been run python -m validation ownership" in text
    assert "– cannot be tested The points are not public" in text
    assert "Eq. 4 r̃ω −r̃ω It turns the other way. tests/test_joints.py a hinge moves along" in text
    assert html.count('id="claims"') == 1
    assert 'href="studies/jumps.html#check-largest-jump"' in html
    assert 'id="check-largest-jump"' in study_page(tmp_path, "jumps").read_text()
    assert 'href="claims.html#claim-good"' in html
    assert 'id="claim-good"' in html
    assert "1 of 7 hold; 2 of 7 hold within limits; 2 of 7 do not hold;" in text


def test_claims_that_were_not_judged(render, tmp_path):
    assert "○ not yet run: " in words_of(render(ledger=CLAIMS)[0])
    (tmp_path / "claims.toml").write_text("[[claim")
    html, problems = render()
    assert problems[0].startswith("claims: the claims cannot be judged: claims.toml: expected a TOML file")
    assert "Failed: the claims cannot be judged: claims.toml" in words_of(html)


def test_a_result_whose_inputs_changed_says_so(render, claims):
    text = words_of(render(studies=["jumps"], changes={"jumps": "fctd/run.py"})[0])
    assert "Out of date: fctd/run.py has changed since. python -m validation jumps" in text
    assert "largest jump: jumps out of date Bound" in text
    assert "1 worse than recorded out of date" in text
    assert "ut of date" not in words_of(render(studies=["jumps"])[0])


def test_page_without_results(render):
    html, problems = render()
    assert problems == []
    assert "There is no study yet." in html


def test_tags_are_balanced(render, claims):
    class Balance(HTMLParser):
        def __init__(self):
            super().__init__()
            self.open = []

        def handle_starttag(self, tag, attributes):
            if tag not in {"meta", "img", "link"}:
                self.open.append(tag)

        def handle_endtag(self, tag):
            assert self.open.pop() == tag

    run, tables = finished("ownership", display={"owners": "Wrong owners"}, checks=(judged(1.0, "why"),))
    html, _ = render((run, tables), studies=["ownership", "absent"])
    for text in html.split("</html>")[:-1]:
        parser = Balance()
        parser.feed(re.sub(r"<script>.*?</script>", "", text, flags=re.DOTALL) + "</html>")
        assert parser.open == []


def test_command_prints_where_the_page_is(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "RESULTS", tmp_path / "results")
    monkeypatch.setattr(command_line, "OUT", tmp_path / "out")
    answer = CliRunner().invoke(command_line.app)
    assert answer.exit_code == 0
    assert str(tmp_path / "out" / "index.html") in answer.output.replace("\n", "")


def test_command_reports_a_missing_figure(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(study, "RESULTS", tmp_path / "results")
    monkeypatch.setattr(command_line, "OUT", tmp_path / "out")
    store.write(replace(BLANK, checks=(judged(5e-7),)), {}, tmp_path / "results")
    assert CliRunner().invoke(command_line.app).exit_code == 1


def test_command_names_a_package_that_is_missing(monkeypatch, capsys):
    monkeypatch.delattr("reports.page")
    monkeypatch.delitem(sys.modules, "reports.page")
    monkeypatch.setitem(sys.modules, "jinja2", None)
    answer = CliRunner().invoke(command_line.app)
    assert answer.exit_code == 2
    assert "expected the package jinja2" in answer.output


def test_command_names_a_folder_that_cannot_be_written(tmp_path, monkeypatch):
    monkeypatch.setattr(study, "RESULTS", tmp_path / "results")
    monkeypatch.setattr(command_line, "OUT", tmp_path / "file" / "out")
    (tmp_path / "file").write_text("")
    answer = CliRunner().invoke(command_line.app)
    assert answer.exit_code == 2
    assert "expected a folder that can be written" in answer.output


def test_two_runs_of_the_pages_are_the_same(render, tmp_path, claims):
    run, tables = finished("ownership", display={"owners": "Wrong owners"}, checks=(judged(1.0, "why"),))
    out, kept = tmp_path / "out", []
    for _ in range(2):
        render((run, tables), studies=["ownership", "absent"])
        kept.append({path.relative_to(out): path.read_bytes() for path in out.rglob("*") if path.is_file()})
    assert kept[0] == kept[1]
    assert len(kept[0]) > 5


def test_results_for_programs_fit_their_schema(render, tmp_path, claims):
    checks = (judged(5e-7), judged(float("nan"), name="lost"))
    run, tables = finished("overlap", checks=checks)
    render((run, tables), studies=["overlap", "absent"])
    found = json.loads((tmp_path / "out" / "results.json").read_text())
    kept = results.Results.model_validate(found)
    (overlap, absent, *_) = kept.studies
    assert [check.value for check in overlap.checks] == [5e-7, None]
    assert overlap.checks[0].page == "studies/overlap.html#check-largest-jump"
    assert absent.status == "not run"
    assert {claim.verdict for claim in kept.claims} >= {"holds", "does not hold", "cannot be tested"}
    schema = json.loads((tmp_path / "out" / "results.schema.json").read_text())
    assert schema == results.Results.model_json_schema()
    assert set(schema["properties"]) == set(found)


def test_texts_are_set_as_in_print(render, tmp_path):
    run, _ = finished("ownership", display={"owners": "Σ rμF_n"}, notes=("As in `sticking`.",))
    tables = {"owners": pd.DataFrame({"reason": ["word " * 20], "status": ["under_resolved"]})}
    check = replace(judged(1.0, "varies: 2 to 3").check, name="Σ rμF_n at 1e7 N/m", source="30 N*m")
    render((replace(run, tables=("owners",), checks=(Judged(check, "varies: 2 to 3"),)), tables))
    html = study_page(tmp_path, "ownership").read_text()
    text = words_of(html)
    assert "Σ rμFₙ at 10⁷ N/m" in text
    assert "30 N·m" in text
    assert "Recorded as varying: 2 to 3" in text
    assert "As in sticking." in text
    assert "Σ rμFₙ 1 row " in text
    assert '<td class="long">word' in html
    assert "<td>under resolved</td>" in html


def test_a_study_that_was_not_run_shows_its_question(tmp_path):
    (tmp_path / "claims.toml").write_text("claim = []")
    asked = {"absent": "Does it hold?"}
    page.render(tmp_path, ["absent", "other"], tmp_path / "out", None, tmp_path / "claims.toml", asked)
    index = (tmp_path / "out" / "index.html").read_text()
    assert '<a href="studies/absent.html">Does it hold?</a>' in index
    assert '<a href="studies/other.html">other</a>' in index
    assert "<h1>Does it hold?</h1>" in study_page(tmp_path, "absent").read_text()


def test_a_figure_is_as_wide_as_its_smallest_letters_need():
    canvas = Figure(figsize=(5, 2))
    canvas.text(0.5, 0.5, "large", fontsize=12)
    canvas.text(0.5, 0.2, "small", fontsize=8)
    canvas.text(0.5, 0.2, "", fontsize=1)
    assert sections.readable_width(canvas) == 450 + sections.FRAME


def test_a_long_table_is_folded_and_a_short_one_open(render, tmp_path):
    run, _ = finished("ownership", display={"owners": "Few", "many": "Many"})
    few = pd.DataFrame({"wrong_owner_percent": [1.0, 2.0]})
    many = pd.DataFrame({"wrong_owner_percent": np.arange(sections.LONG + 1.0)})
    tables = {"owners": few, "many": many}
    render((replace(run, tables=tuple(tables)), tables))
    text = study_page(tmp_path, "ownership").read_text()
    assert re.findall(r'<details class="table"( open)?>\s*<summary>(\w+)', text) == [(" open", "Few"), ("", "Many")]
