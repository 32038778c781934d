"""The page of measured wells: every judged reading of each, by stiff string, soft string and one factor."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import pandas as pd

from reports import words
from reports.claims import Claims
from reports.figures import Tables
from reports.figures.judged import WELLS
from reports.sections import Picture, Printed, Section, printed
from validation.claims.ledger import Finding
from validation.harness.study import between
from validation.parts.judged_well import CAPTIONS, STIFF, which_is_better

CLAIMS: Final = "measured-torque-of-"  # what their names begin with
SHARE: Final = 10.0  # the paper's, of torque [%]
_SCORES: Final = {
    "model": "model", "unit": "unit", "readings": "readings", "in_95": "in 95 % band", "coverage": "coverage (95 %)",
    "compatible": "count compatible", "crps": "CRPS", "crps_carried_on": "CRPS of last reading carried on",
    "bias": "bias",
}  # fmt: skip


@dataclass(frozen=True)
class Group:
    """Readings of a well that are judged together: their name, and which model has the better score."""

    name: str
    better: str
    tables: list[Printed]


@dataclass(frozen=True)
class Well:
    """A well on the page; missing : why it is not there, or empty."""

    study: str
    name: str
    missing: str = ""
    groups: list[Group] = field(default_factory=list)
    picture: Picture | None = None


@dataclass(frozen=True)
class Page:
    """The wells, the torques that were judged, the wells without any, and the claims on measured torque."""

    wells: list[Well]
    torques: Printed | None
    without: list[str]
    claims: list[Finding]


def page_of(sections: Mapping[str, Section], tables: Mapping[str, Tables], claims: Claims) -> Page:
    """The page from the sections and the tables of the studies that have been run."""
    wells = [_well(study, name, sections.get(study), tables.get(study, {})) for study, name in WELLS.items()]
    asked = [each for each in claims.judgement.findings if each.claim.id.startswith(CLAIMS)]
    torques = [
        stiff_torques(tables[well.study]["judged"]).assign(of=well.name) for well in wells if not well.missing
    ]  # fmt: skip
    without = [
        well.name for well, found in zip([w for w in wells if not w.missing], torques, strict=True) if found.empty
    ]
    every = pd.concat(torques, ignore_index=True) if torques else pd.DataFrame()
    return Page(wells, _print_torques(every) if len(every) else None, without, asked)


def _well(study: str, name: str, section: Section | None, tables: Tables) -> Well:
    if not set(CAPTIONS) <= set(tables):
        if section is None or section.record is None:
            why = f"The study {study} has not been run: python -m validation {study}."
        elif section.record.status == "skipped":
            why = f"The study {study} was skipped: {section.record.message}."
        else:
            why = f"The study {study} has no judged readings in its stored result: python -m validation {study}."
        return Well(study, name, why)
    groups = []
    for well in dict.fromkeys(tables["judged"]["well"]):
        one = {key: tables[key][tables[key]["well"] == well] for key in CAPTIONS}
        parts = [
            printed(readings(one["judged"]), CAPTIONS["judged"]),
            printed(scores(one["scores"]), CAPTIONS["scores"]),
            printed(widths(one["widths"]), CAPTIONS["widths"]),
        ]
        groups.append(Group(str(well), which_is_better(one), parts))
    assert section is not None
    picture = next((each for each in section.pictures if each.name == "judged"), None)
    return Well(study, name, "", groups, picture)


def readings(judged: pd.DataFrame) -> pd.DataFrame:
    """A row for each reading: recorded range, and band of 95 % of each model with in or out."""
    found: dict[tuple[str, str], dict[str, str]] = {}
    for one in judged.to_dict("records"):
        row = found.setdefault(
            (one["row"], one["quantity"]),
            {"row": one["row"], "quantity": one["quantity"], "unit": str(one["unit"]).replace(" ", "·"),
             "recorded": _range(one["measured_low"], one["measured_high"])},
        )  # fmt: skip
        inside = "in" if one["in_95"] else "out"
        row[str(one["model"])] = f"{_range(one['low_95'], one['high_95'])}: {inside}"
    return pd.DataFrame(list(found.values()))


def scores(table: pd.DataFrame) -> pd.DataFrame:
    """Coverage with its interval, CRPS and bias."""
    ends = zip(table["coverage_95"], table["coverage_low"], table["coverage_high"], strict=True)
    coverage = [between(*map(words.number, (a, b, c))) for a, b, c in ends]
    found = table.assign(coverage=coverage, unit=table["unit"].str.replace(" ", "·"))
    return found[[*_SCORES]].rename(columns=_SCORES)


def widths(table: pd.DataFrame) -> pd.DataFrame:
    """Widths of pick-up minus slack-off by model: medians, and the ratio of the two."""
    found = table.groupby("model", sort=False)[["width", "scatter_width"]].median().reset_index()
    found["ratio"] = found["width"] / found["scatter_width"]
    return found.rename(columns={"width": "width over reading", "scatter_width": "of scatter alone"})


def stiff_torques(judged: pd.DataFrame) -> pd.DataFrame:
    """The judged torques of the stiff string."""
    return judged[(judged["model"] == STIFF) & (judged["unit"] == "kN m")]


def _print_torques(table: pd.DataFrame) -> Printed:
    rows = pd.DataFrame(
        {
            "well": table["of"], "row": table["row"], "model": table["well"],
            "recorded": [_range(a, b) for a, b in zip(table["measured_low"], table["measured_high"], strict=True)],
            "predicted_kN_m": table["median"], "distance_percent": table["distance_percent"],
            "within 10 %": table["distance_percent"] <= SHARE, "in 95 % band": table["in_95"],
        }
    )  # fmt: skip
    return printed(rows, "Judged torques: distance of the stiff string's median from the recorded range (kN·m)")


def _range(low: float, high: float) -> str:
    """A range as print has it, three digits of the larger end."""
    digits = 1 if max(abs(low), abs(high)) < 100 else 0
    ends = [f"{end:.{digits}f}".replace("-", words.MINUS) for end in (low, high)]
    return ends[0] if ends[0] == ends[1] else f"{ends[0]} to {ends[1]}"
