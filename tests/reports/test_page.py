"""The page shows every study: finished, missed, failed, skipped and not run."""

import json
import re
import sys
from dataclasses import replace
from html.parser import HTMLParser
from unittest.mock import Mock

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from typer.testing import CliRunner

from reports import __main__ as command_line
from reports import page, results, sections
from tests.left_over import left_folders
from tests.reports.pages import BLANK, finished, judged, missing, study_page, words_of
from validation.harness import store, study
from validation.harness.store import Judged


@pytest.mark.slow
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
    assert not missing(
        text, "Mind the gap.", "full run of 2025-01-02 03:04 UTC", "commit 0123abcd", "Some CPU, 2 cores"
    )
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
    assert not missing(
        text,
        "✗ worse than recorded",
        "✗ missed (recorded)",
        "Recorded as missed: chords are chords",
        "✓ better than recorded",
        "d no number at most",
        "2 worse than recorded, 1 missed (recorded), 1 better than recorded",
    )


def test_findings_about_the_paper_are_listed_apart(render):
    checks = (judged(1.0, "finding: a misprint", name="eq 23"), judged(1.0, "missed: chords", name="chords"))
    html = render((replace(BLANK, checks=checks), {}), studies=["overlap"])[0]
    first = words_of(html[html.index('<section id="findings"') : html.index('<section id="figures"')])
    assert "eq 23 : a misprint" in first
    assert "chords" not in first
    page = words_of(html[html.index("<h1>Does the overlap") :])
    own, _, found = page.partition("Findings about the paper")
    assert "✗ missed (recorded)" in own
    assert "eq 23" not in own
    assert "✗ finding about the paper" in found
    assert "Finding: a misprint" in found
    assert "chords" not in found


def test_a_figure_stands_beside_what_was_expected_and_how_to_make_it(render):
    found = replace(judged(5e-7, name="largest change of force in a step with overlap"))
    run, tables = finished("overlap", checks=(found, judged(0.0, name="points that leave the hole")), quick=True)
    html = render((run, tables), full={"overlap": ["largest change of force without overlap", "other"]})[0]
    shown = html[html.index("A point pressed against", html.index("<h1>Does the overlap")) :]
    caption = words_of(shown[: shown.index("</figcaption>")])
    assert not missing(
        caption,
        "✓ met largest change of force in a step with overlap: 5",
        "expected at most",
        "(continuity &lt;C⁰&gt;)",
        "○ not checked largest change of force without overlap",
        "python -m validation overlap --quick",
    )
    assert "leave the hole" not in caption


def test_what_a_quick_run_leaves_out_keeps_its_verdict_from_green(render):
    run, tables = finished("overlap", checks=(judged(5e-7),), quick=True)
    text = words_of(render((run, tables), full={"overlap": ["largest jump", "order"]})[0])
    assert not missing(text, "◐ 1 met, 1 not checked", "Not checked by this quick run: order.")
    assert "✓ 1 met" not in text


def test_a_figure_of_the_paper_says_what_the_text_prints(render):
    run, tables = finished("paper_well", checks=(judged(5e-7),))
    text = words_of(render((run, tables))[0])
    assert "Our copy of the paper has no curves. Its text prints for Fig. 12: no torque; readings to 2450 m" in text


def test_table_for_display_has_units_in_its_head(render):
    run, tables = finished("ownership", display={"owners": "Wrong owners"}, quick=True)
    text = words_of(render((run, tables))[0])
    assert not missing(text, "Wrong owners", "wrong owner %", "build to 120° 120 10 000 42.1", "quick run")


def test_times_of_an_engine_that_failed_the_gate_are_struck_through_with_the_reason(render):
    """And kept: the time of an engine that passed stands beside it, as do numbers that are no time."""
    rows = {"engine": ["sound", "loose"], "hookload_kN": [1.5, 2.5], "real_time_factor": [3.5, 4.5]}
    table = pd.DataFrame(rows | {"gate": ["passed", "failed: lean 19.8 ° (at most 15)"]})
    given = replace(BLANK, tables=("times",), display={"times": "Times"})
    html, _ = render((given, {"times": table}))
    struck = re.findall(r"<s>(.*?)</s>", html)  # those of the table of needs stand in the record
    assert "4.5" in struck
    assert "3.5" not in struck
    assert not missing(words_of(html), "3.5", "failed: lean 19.8 ° (at most 15)")
    plain, _ = render((given, {"times": table.drop(columns="gate")}))
    assert "<s>4.5</s>" not in plain


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
    assert not missing(
        text,
        "○ skipped",
        "Skipped: the public data folder is missing",
        "✗ failed",
        "Failed: ArithmeticError: lost",
        "○ not run",
        "python -m validation absent",
    )


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


@pytest.mark.slow
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


@pytest.mark.slow
def test_command_prints_where_the_page_is(tmp_path, monkeypatch):
    monkeypatch.setattr(command_line, "STUDIES", {"overlap": command_line.STUDIES["overlap"]})
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


@pytest.mark.slow
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
    assert not missing(
        text, "Σ rμFₙ at 10⁷ N/m", "30 N·m", "Recorded as varying: 2 to 3", "As in sticking.", "Σ rμFₙ 1 row "
    )
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


def test_a_column_that_says_nothing_in_any_row_is_left_out():
    table = pd.DataFrame(
        {"engine": ["a", "b"], "failed": ["", ""], "torque_kN_m": [np.nan, np.nan], "off_percent": [1, 2]}
    )
    found = sections.printed(table, "Engines")
    assert [label for label, _, _ in found.columns] == ["engine", "off"]
    assert found.rows == [("a", "1"), ("b", "2")]
    assert len(sections.printed(table[:0], "None").columns) == 4


def test_an_interruption_leaves_the_pages_before(render, tmp_path, monkeypatch):
    render((replace(BLANK, checks=(judged(0.0),)), {}), studies=["overlap"])
    before = {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()}
    left_folders(tmp_path / "out")[0].mkdir()
    monkeypatch.setattr("reports.page._write_pages", Mock(side_effect=KeyboardInterrupt))
    with pytest.raises(KeyboardInterrupt):
        render(studies=["overlap"])
    assert {path: path.read_bytes() for path in (tmp_path / "out").rglob("*") if path.is_file()} == before
    assert sorted(path.name for path in tmp_path.glob(".*")) == []
