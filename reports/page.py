"""From stored results to pages: the first with its chapters, the claims, measured wells, and one for every study."""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import jinja2
from markupsafe import Markup, escape

from fctd.store.whole_folder import whole_folder
from reports import chapters, results, rounding, wells, which_contact, words
from reports.claims import LOOKS, judged
from reports.figures import Tables
from reports.figures.judged import WELLS
from reports.figures.leading import LEADING, SHOWN
from reports.sections import Picture, Section, anchor, section_of
from validation.claims.ledger import CLAIMS
from validation.harness.full_checks import Full
from validation.harness.sensitivity import REASONS

TEMPLATES = Path(__file__).parent / "templates"
MOST = 4  # claims of one verdict that stand beneath the answer
LONG_CELL = 40  # letters of a text in a table that is broken into lines


def render(
    stored: Path,
    studies: Iterable[str],
    out: Path,
    changes: Mapping[str, str] | None = None,
    ledger: Path = CLAIMS,
    questions: Mapping[str, str] | None = None,
    full: Full | None = None,
) -> list[str]:
    """Write the pages, ``figures`` and ``results.json`` into a folder; return what is missing.

    Pages: ``index.html``, ``claims.html``, ``wells.html``, ``which_contact.html``, ``rounding.html`` and those of
    ``studies``.

    A folder of that name is replaced at the end, as a whole: an interruption leaves the pages before.

    Studies stand in the order given; results of studies that are not among them come after.  The claims of ``ledger``
    are judged by these results.  changes : study -> what has changed since its result was stored.  questions : study ->
    its question, for those that have not been run.  full : the checks of full runs, some of which a quick
    one leaves out.
    """
    with whole_folder(out) as new:
        return _render(stored, studies, new, changes or {}, ledger, questions or {}, full or {})


def _render(
    stored: Path,
    studies: Iterable[str],
    out: Path,
    changes: Mapping[str, str],
    ledger: Path,
    questions: Mapping[str, str],
    full: Full,
) -> list[str]:
    """Write the pages into a folder that does not exist yet; see ``render``."""
    for folder in (out / "figures", out / "studies"):
        folder.mkdir(parents=True)
    found = sorted(path.parent.name for path in stored.glob("[!.]*/verdict.json"))
    sections: dict[str, Section] = {}
    first = {each.study: each for each in LEADING}
    drawn: dict[str, Picture | None] = {}
    measured: dict[str, Tables] = {}
    for study in dict.fromkeys([*studies, *found]):
        section, tables = section_of(stored / study, out, full)
        section.changed = changes.get(study, "")
        section.asked = questions.get(study, "")
        sections[study] = section
        if study in WELLS:
            measured[study] = tables
        if study in first and tables:
            drawn[study] = section.draw(first[study].figure, tables, out)
    leading = [
        (each.study, each.figure.caption, drawn.get(each.study), _ours(f"{each.study}/{each.more}", sections)[1])
        for each in LEADING
    ]
    leading.sort(key=lambda each: each[2] is None)  # keeps the order of those that are drawn
    claims = judged(stored, ledger)
    sensitive = rounding.page_of(stored, REASONS)
    given = {
        "sections": sections,
        "claims": claims,
        "looks": LOOKS,
        "changes": changes,
        "leading": leading[:SHOWN],
        "wells": wells.page_of(sections, measured, claims),
        "chapters": _chapters(sections),
        "paper": [(each, _ours(each.ours, sections)) for each in chapters.contents().paper],
        "papers": {_address(each.ours, sections): each for each in chapters.contents().paper},
        "findings": [(section, judged) for section in sections.values() for judged in section.findings],
        "absent": [section for section in sections.values() if section.absent],
        "machine": _machine(sections),
        "which": which_contact.table(stored),
        "rounding": sensitive,
    }
    _write_pages(out, given)
    results.write(sections.values(), claims, out)
    problems = [f"{section.study}: {problem}" for section in sections.values() for problem in section.problems]
    whole = {"claims": claims.problem, "rounding": sensitive.problem}
    return [f"{name}: {problem}" for name, problem in whole.items() if problem] + problems


def _write_pages(out: Path, given: Mapping[str, Any]) -> None:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(TEMPLATES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.globals |= {
        "number": words.number,
        "found": words.found,
        "bound": words.bound,
        "anchor": anchor,
        "long_cell": LONG_CELL,
        "most": MOST,
    }
    environment.filters["typeset"] = words.typeset
    environment.filters["struck"] = _struck

    def write(template: str, name: str, **more: Any) -> None:
        root = "../" * name.count("/")
        text = environment.get_template(template).render(**given, root=root, page=name, **more)
        (out / name).write_text(text, encoding="utf-8", errors="backslashreplace")

    write("index.html", "index.html")
    write("claims.html", "claims.html")
    write("wells.html", "wells.html")
    write("which_contact.html", "which_contact.html")
    write("rounding.html", "rounding.html")
    for section in given["sections"].values():
        write("study.html", f"studies/{section.study}.html", section=section)


def _struck(text: str) -> Markup:
    """A cell of the guide: parts between ``~~`` are struck through, and a link to another guide becomes its path."""
    plain = re.sub(r"\[.*?\]\((.*?)\)", r"see docs/\1", text)
    return Markup(re.sub(r"~~(.*?)~~", r"<s>\1</s>", str(escape(plain))))


def _chapters(sections: Mapping[str, Section]) -> list[dict[str, Any]]:
    """The chapters, each with its answer, picture and studies."""
    records = {study: section.record for study, section in sections.items() if section.record is not None}
    homes = chapters.by_chapter(sections)
    return [
        {
            "chapter": chapter,
            "answer": [sentence.filled(records) for sentence in chapter.sentence],
            "ours": _ours(chapter.picture, sections),
            "sections": [sections[study] for study in homes[chapter.id] if not sections[study].absent],
        }
        for chapter in chapters.contents().chapter
    ]


def _ours(address: str, sections: Mapping[str, Section]) -> tuple[str, Picture | None]:
    """The study of STUDY/FIGURE, and the picture where it has been drawn; the first one where no figure is named."""
    study, _, name = address.partition("/")
    pictures = sections[study].pictures if study in sections else []
    return study, next((picture for picture in pictures if name in ("", picture.name)), None)


def _address(ours: str, sections: Mapping[str, Section]) -> tuple[str, str]:
    """Study and figure of STUDY/FIGURE."""
    study, picture = _ours(ours, sections)
    return study, picture.name if picture else ""


def _machine(sections: Mapping[str, Section]) -> list[str]:
    """Machines, commits and days of the results, each once, the latest first."""
    records = [section.record for section in sections.values() if section.record is not None]
    found: dict[str, str] = {}
    for record in sorted(records, key=lambda record: record.date, reverse=True):
        origin = record.provenance
        kind = "quick" if record.quick else "full"
        key = f"{origin.cpu}, {origin.cores} cores, commit {origin.commit}, {kind} runs"
        found.setdefault(key, record.date[:10])
    return [f"{key}, {day}" for key, day in found.items()]
