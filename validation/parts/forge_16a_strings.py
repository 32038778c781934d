"""Strings of well 16A(78)-32 from the component lists of its reports, and where the reports contradict themselves.

Masses follow from dimensions, of steel; drill pipe and heavy-weight pipe have the masses of a metre that manufacturers
give, joints and upsets included.  What the lists lack is assumed by the constants below.  Tools that stand together are
one component, and one shorter than 3 m joins the pipe beside it.

A report prints the weight of the assembly in air and in mud.  Where their ratio is the buoyancy factor within 1 % and
the weight in air is not that of the report before with another assembly, it is an observation with an error of 3 %;
otherwise one of 25 %.  The dimensions are another one, with 8 %.  Their weighted mean is the weight of the assembly,
and its error is that of the mass of its heaviest component, an unknown of the fit.
"""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd

from fctd.case.load import Case
from fctd.case.string import ComponentSpec
from validation.cases import load
from validation.parts.forge_16a import APART, FIT, JUDGED, OF_NOTE, PUMPS, UPPER

FOLDER: Final = "forge-16a-78-32"
FOOT, INCH, POUND_FOOT, POUND_FORCE, PPG = 0.3048, 0.0254, 1.48816394356955, 4.4482216152605, 119.826427316897
GRAVITY, STEEL = 9.80665, 7850.0
PIPE: Final = "5 in drill pipe"
# Pipe: outer and inner diameter, tool joint [in], mass [lb/ft] with joints.
DRILL_PIPE: Final = (5.0, 4.276, 6.625, 21.9)
HEAVY_PIPE: Final = (5.0, 3.0, 6.5, 49.3)
# Where a list has no bore [in]: of motors and steerable tools, as it has for some of them; of all else.
BORE: Final = {"Motor": 1.25, "Steerable Assembly": 1.25}
OTHER_BORE: Final = 2.75
OTHER_SIZE: Final = 6.5  # outer diameter that a list does not have [in]
# Listed diameters beyond these are those of blades and cutters; the bodies then have the second [in], by hole size.
BODIES: Final = {12.25: (10.0, 8.0), 8.75: (7.5, 6.5)}
BLADED: Final = ("Drill Bit", "Stabilizer", "Reamer")
GAP: Final = 0.125  # least difference of hole and contact diameter [in]: bits and blades are listed as wide as the hole
LONG: Final = 100.0  # collars and pipe of this length and more are a component of their own [ft]
LEAST: Final = 3.0  # [m]
# Standard deviations of the weight of an assembly, over it.
OF_DIMENSIONS, OF_PRINTED, OF_DOUBTED, OF_OTHER = 0.08, 0.03, 0.25, 0.20
RATIO: Final = 0.01
KEYS: Final = (*FIT, *APART, *JUDGED)


@dataclass(frozen=True)
class Part:
    """A stretch of a list: kind (tools, collars, heavy-weight pipe or PIPE), length and diameters [m], mass [kg]."""

    kind: str
    length: float
    outer: float
    inner: float
    contact: float
    mass: float


@dataclass(frozen=True)
class Assembly:
    """What a report says of the string below the drill pipe, and what is made of it.

    density : of the mud [kg/m³]; parts : from the bit up; heaviest : of them, an index; weight, sd : in air [N], of all
    parts but drill pipe; by_dimensions : the same from dimensions alone; air, mud : as printed [N], NaN where not;
    listed, length : of the list and as printed [m]; remarks : what contradicts itself or is missing.
    """

    key: str
    density: float
    parts: tuple[Part, ...]
    heaviest: int
    weight: float
    sd: float
    by_dimensions: float
    air: float
    mud: float
    listed: float
    length: float
    remarks: tuple[str, ...]

    @property
    def carrier(self) -> str:
        """Name of the component whose mass holds the error of the weight."""
        return f"{self.parts[self.heaviest].kind}, {self.key} ft"

    @property
    def linear_mass(self) -> tuple[float, float]:
        """Mass of a metre of that component and its standard deviation [kg/m]."""
        part = self.parts[self.heaviest]
        others = GRAVITY * sum(p.mass for p in self.parts if p is not part and p.kind != PIPE)
        unit = GRAVITY * part.length
        return (self.weight - others) / unit, self.sd / unit

    @property
    def buoyancy(self) -> float:
        """Weight of steel in the mud over that in air."""
        return 1 - self.density / STEEL


def reports(data: Path) -> pd.DataFrame:
    """The rows of the readings by their depth, without loads: nothing here is measured on the hook."""
    table = pd.read_csv(data / FOLDER / "observations.csv", dtype=str, keep_default_na=False)
    table.index = pd.Index([f"{float(depth):.0f}" for depth in table["bit_md_ft"]])
    columns = ["date", "mw_ppg", "hole_in", "bha_length_ft", "bha_air_lbf", "bha_mud_lbf"]
    return table.loc[table.index != PUMPS, columns]


def assemblies(data: Path) -> dict[str, Assembly]:
    """The assembly of every row that fits or is judged, in the order of the dates."""
    lists = pd.read_csv(data / FOLDER / "bha_components.csv", dtype=str, keep_default_na=False)
    found: dict[str, Assembly] = {}
    before: Assembly | None = None
    for key, row in reports(data).sort_values("date", kind="stable").iterrows():
        before = found[str(key)] = assembly_of(str(key), row, lists[lists["date"] == row["date"]], before)
    assert set(found) == set(KEYS)
    return found


def assembly_of(key: str, row: "pd.Series[str]", listed: pd.DataFrame, before: Assembly | None) -> Assembly:
    """The assembly of a report; before : that of the report before."""
    hole = float(row["hole_in"])
    items = [_item(one, hole) for one in listed.to_dict("records")]
    remarks = [remark for _, item_remarks in items for remark in item_remarks]
    parts = [part for part, _ in items]
    length, total = FOOT * float(row["bha_length_ft"]), sum(part.length for part in parts)
    if abs(length - total) > FOOT:
        remarks.append(
            f"list of {total / FOOT:.0f} ft for {length / FOOT:.0f} ft: the rest is taken as heavy-weight pipe"
        )
        parts.append(_pipe("heavy-weight pipe", HEAVY_PIPE, length - total))
    merged = _merged(parts)
    by_dimensions = GRAVITY * sum(part.mass for part in merged if part.kind != PIPE)
    air, mud = (_force(row[f"bha_{name}_lbf"]) for name in ("air", "mud"))
    density = PPG * float(row["mw_ppg"])
    weights, deviations = [by_dimensions], [OF_DIMENSIONS * by_dimensions]
    if np.isnan(air):
        remarks.append("no weight printed")
    else:
        off = mud / air / (1 - density / STEEL) - 1
        carried = before is not None and before.air == air and abs(before.listed - total) > FOOT
        if abs(off) > RATIO:
            remarks.append(f"weight in mud over weight in air is {100 * off:+.1f} % off the buoyancy factor")
        if carried:
            remarks.append("weight in air is that of the report before, of another assembly")
        trusted = abs(off) <= RATIO and not carried and key != OF_NOTE
        weights.append(air)
        deviations.append((OF_PRINTED if trusted else OF_DOUBTED) * air)
        if abs(air / by_dimensions - 1) > 2 * OF_DIMENSIONS:
            remarks.append(f"weight in air is {air / by_dimensions:.2f} of that from dimensions")
    if key == OF_NOTE:
        remarks.append("measured with a packer on heavy-weight pipe, whose list is missing; this list stands for it")
    precision = np.array(deviations) ** -2
    weight = float(precision @ np.array(weights) / precision.sum())
    sd = OF_OTHER * weight if key == OF_NOTE else float(precision.sum() ** -0.5)
    own = [part.mass if part.kind != PIPE else 0.0 for part in merged]
    return Assembly(
        key, density, tuple(merged), int(np.argmax(own)), weight, sd, by_dimensions, air, mud, total, length,
        tuple(dict.fromkeys(remarks)),
    )  # fmt: skip


def _force(cell: str) -> float:
    """A printed weight [N]: below 1,000 it is in klbf."""
    value = float(cell) if cell else float("nan")
    return POUND_FORCE * (1e3 * value if value < 1e3 else value)


def _item(one: Mapping[Any, Any], hole: float) -> tuple[Part, list[str]]:
    """A component of a list, and what it lacks."""
    kind, _, text = str(one["component"]).partition("-")
    length, remarks = FOOT * float(one["length_ft"]), []
    if re.search(r"HWDP|HW WT|HVY WT", text):
        return _pipe("heavy-weight pipe", HEAVY_PIPE, length), []
    if kind == "Drill Pipe":
        if one["id_in"] and float(one["id_in"]) < 4:
            remarks.append(f"drill pipe with a bore of {one['id_in']} in, taken as 4.276")
        return _pipe(PIPE, DRILL_PIPE, length), remarks
    if not one["od_in"]:
        remarks.append(f"no diameter of {kind.lower()}")
    outer = float(one["od_in"] or OTHER_SIZE)
    contact, (most, body) = outer, BODIES[hole]
    if outer > hole:
        remarks.append(f"{kind.lower()} of {outer:g} in, wider than the hole")
    if kind in BLADED and outer > most:
        outer = body
    bore = one["id_in"]
    if not bore and kind not in BORE and kind != "Drill Bit":
        remarks.append(f"no bore of {kind.lower()}")
    inner = float(bore or BORE.get(kind, OTHER_BORE))
    section = 0.25 * np.pi * INCH**2 * (outer**2 - inner**2)
    contact = outer if kind == "Drill Bit" else min(contact, hole - GAP)
    of = "collars" if kind == "Drill Collar" and length >= FOOT * LONG else "tools"
    return Part(of, length, INCH * outer, INCH * inner, INCH * contact, STEEL * section * length), remarks


def _pipe(kind: str, pipe: tuple[float, float, float, float], length: float) -> Part:
    outer, inner, joint, mass = pipe
    return Part(kind, length, INCH * outer, INCH * inner, INCH * joint, POUND_FOOT * mass * length)


def _merged(parts: Sequence[Part]) -> list[Part]:
    """Tools that stand together as one, and what is shorter than ``LEAST`` with the pipe below, or above at the bit."""
    found = [_one(list(group)) for _, group in groupby(parts, key=lambda part: part.kind)]
    while len(found) > 1 and (short := [k for k, part in enumerate(found) if part.length < LEAST]):
        k = max(short[0] - 1, 0)
        keeps = max(found[k : k + 2], key=lambda part: part.length)
        length, mass = (sum(getattr(part, name) for part in found[k : k + 2]) for name in ("length", "mass"))
        found[k : k + 2] = [replace(keeps, length=length, mass=mass)]
    return [_one(list(group)) for _, group in groupby(found, key=lambda part: part.kind)]


def _one(parts: Sequence[Part]) -> Part:
    """Parts of a kind as one: mean squares of the diameters by length, the largest contact."""
    if len(parts) == 1:
        return parts[0]
    lengths = np.array([part.length for part in parts])
    outer, inner = (
        float(np.sqrt(np.average([getattr(part, name) ** 2 for part in parts], weights=lengths)))
        for name in ("outer", "inner")
    )
    return Part(
        parts[0].kind, float(lengths.sum()), outer, inner, max(outer, *(part.contact for part in parts)),
        sum(part.mass for part in parts),
    )  # fmt: skip


def cases(data: Path, found: Mapping[str, Assembly]) -> dict[str, Case]:
    """The case of every row by its key: its assembly below the drill pipe, its mud, the survey of the public data."""
    survey = data / FOLDER / "survey.csv"
    holes = {name: load(f"forge_16a_{name}", wellbore__survey=survey) for name in ("8in", "12in")}
    return {key: _case(holes["12in" if key in UPPER else "8in"], one) for key, one in found.items()}


def _case(hole: Case, assembly: Assembly) -> Case:
    pipe = hole.string.components[-1]
    counted: dict[str, int] = {}
    components = []
    for k, part in enumerate(assembly.parts):
        if part.kind == PIPE:
            components.append(pipe.model_copy(update={"length": part.length}))
            continue
        counted[part.kind] = counted.get(part.kind, 0) + 1
        name = f"{part.kind} {counted[part.kind]}, {assembly.key} ft"
        mass = part.mass / part.length
        if k == assembly.heaviest:
            name, mass = assembly.carrier, assembly.linear_mass[0]
        components.append(
            ComponentSpec(
                name=name,
                length=part.length,
                outer_diameter=part.outer,
                inner_diameter=part.inner,
                contact_diameter=part.contact,
                contact="sleeve",
                linear_mass=mass,
                segment_length=10.0,
            )
        )
    if assembly.parts[-1].kind == PIPE:  # lists that go up to the surface: the pipe has what length the depth asks for
        components.pop()
    components.append(pipe)
    return hole.model_copy(
        update={
            "name": f"forge-16a {assembly.key} ft",
            "string": hole.string.model_copy(update={"components": tuple(components)}),
            "mud": hole.mud.model_copy(update={"density": assembly.density}),
        }
    )


def contradictions(found: Mapping[str, Assembly]) -> pd.DataFrame:
    """A row for each assembly: what is printed, what follows from dimensions, what is taken [ft, klbf], and remarks."""
    klbf = 1e3 * POUND_FORCE
    return pd.DataFrame(
        [
            {
                "row": one.key, "length_ft": one.length / FOOT, "listed_ft": one.listed / FOOT,
                "air_klbf": one.air / klbf, "mud_klbf": one.mud / klbf, "mud_over_air": one.mud / one.air,
                "buoyancy_factor": one.buoyancy, "dimensions_klbf": one.by_dimensions / klbf,
                "taken_klbf": one.weight / klbf, "sd_klbf": one.sd / klbf,
                "remarks": "; ".join(one.remarks) or "none",
            }
            for one in found.values()
        ]
    )  # fmt: skip
