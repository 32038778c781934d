"""Statements about the string: the same string written in other ways."""

import copy
import math
from collections.abc import Callable
from typing import Any

from tests.equivalence.answers import EXACT, ROUNDING, base, changed, same
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.table import applies, statement

STEEL = {"youngs_modulus": 206.8e9, "poisson_ratio": 0.3, "density": 7850.0}
OF_LENGTHS = ("length", "segments", "segment_length", "joint_segments", "centralisers", "friction_reducers")


def parts_of(drawn: Drawn, write: Callable[[int, Raw], list[Raw]]) -> Callable[[Raw], None]:
    """A change of the tables that writes components in place of each, from the bit upwards."""

    def change(raw: Raw) -> None:
        parts = raw["string"]["components"]
        raw["string"]["components"] = [new for k, part in enumerate(parts) for new in write(k, copy.deepcopy(part))]

    return change


def stacked(part: Raw, lengths: list[float], **more: Any) -> list[Raw]:
    """Components one above the other in place of one: bend and swivel stay at the upper end, a drop is shared out."""
    pieces = [{**part, "length": length, **more} for length in lengths]
    if "pressure_drop" in part:
        for piece, length in zip(pieces, lengths, strict=True):
            piece["pressure_drop"] = part["pressure_drop"] * length / sum(lengths)
    for piece in pieces[:-1]:
        piece.pop("bend", None)
        piece.pop("swivel", None)
    return pieces


def lengths_in_hole(drawn: Drawn, k: int) -> list[float]:
    """Lengths of the segments of a drawn component in the hole, from the lower end upwards [m]."""
    string = base(drawn).laid.string
    return string.length[string.origin == k][::-1].tolist()


@statement("a component = the same cut in two at a segment's end")
def cut_in_two(drawn: Drawn) -> None:
    """Of all but points, which touch in their middle, and components that the default layout cuts."""
    dice, done = drawn.dice(6), []

    def write(k: int, part: Raw) -> list[Raw]:
        spec, lengths = drawn.case.string.components[k], lengths_in_hole(drawn, k)
        repeat = spec.repeat
        if repeat is not None:
            joints = round(spec.length / repeat.every - 0.5) if spec.length else 0
            at = dice.whole(1, joints) * repeat.every if joints >= 1 else 0.0
            rest = spec.length - at if spec.length else 0.0
            # Beyond the last whole joint less than a quarter of one becomes a part of the joint below it.
            if not at or rest < 0.3 * repeat.every or sum(lengths) < spec.length - 1e-6:
                return [part]
        elif spec.cut_by_default or spec.contact == "point" or len(lengths) < 3:
            return [part]
        else:
            at = sum(lengths[: dice.whole(1, len(lengths) - 2)])
        if repeat is None:
            part.pop("segments", None)
            part |= {"segment_length": lengths[0], "contact": "sleeve"}
        done.append(k)
        whole = spec.length
        rest = math.fsum(lengths) - at if whole is None else whole - at
        first, second = stacked(part, [at, rest])
        if whole is None:
            second.pop("length")
        return [first, second]

    case = changed(drawn, parts_of(drawn, write))
    applies(done)
    same(drawn, case, ROUNDING)


@statement("default segments = the same written out")
def default_segments(drawn: Drawn) -> None:
    """Every segment is a component of its own; a sleeve touches at all its ends."""
    parts = drawn.case.string.components
    chosen = [k for k, part in enumerate(parts) if part.cut_by_default and part.contact == "sleeve"]
    applies(chosen)

    def write(k: int, part: Raw) -> list[Raw]:
        lengths = lengths_in_hole(drawn, k)
        if k not in chosen or not lengths:
            return [part]
        return stacked(part, lengths, segments=1, contact="sleeve")

    same(drawn, changed(drawn, parts_of(drawn, write)), ROUNDING, loads_only=drawn.has("joint", "pipe"))


@statement("joints = tool joints and bodies written out")
def joints_written(drawn: Drawn) -> None:
    """Mass and stiffness of a tool joint by its diameters; loads alone, as stresses are those of the whole pipe."""
    parts = drawn.case.string.components
    chosen = [k for k, part in enumerate(parts) if part.joint_segments is not None]
    # Mud flows between the blades of a point that is written out, and past all of a tool joint; what pumps add to the
    # pressure inside stretches the tool joint by its own bore.
    applies(not any(row.get("flow") for row in drawn.raw.get("operations", [])))
    applies(chosen and not lengths_by_clearance(drawn) and not drawn.has("viscosity", "rheology", "fann"))

    def write(k: int, part: Raw) -> list[Raw]:
        if k not in chosen:
            return [part]
        lengths, spec = lengths_in_hole(drawn, k), parts[k]
        pieces: list[Raw] = []
        kinds = [kind.kind.value for kind in base(drawn).laid.string.parts]
        string = base(drawn).laid.string
        of = [kinds[i] for i in string.component[string.origin == k][::-1]]
        for length, kind in zip(lengths, of, strict=True):
            pieces.append(tool_joint(part, spec) if kind == "tool joint" else body(part, spec))
            pieces[-1] |= {"length": length, "segments": 1}
        for key in ("bend", "swivel"):
            if key in part:
                pieces[-1][key] = part[key]
        return pieces

    same(drawn, changed(drawn, parts_of(drawn, write)), ROUNDING, loads_only=True)


def lengths_by_clearance(drawn: Drawn) -> bool:
    """Whether the clearance of parts that repeat decides how long the segments beside them are."""
    return any(part.cut_by_default for part in drawn.case.string.components)


def solid(outer: float, inner: float) -> tuple[float, float]:
    """Area [m²] and second moment of area [m⁴] of a pipe."""
    return math.pi / 4 * (outer**2 - inner**2), math.pi / 64 * (outer**4 - inner**4)


def kappa(outer: float, inner: float, poisson: float) -> float:
    """Hutchinson's shear coefficient of a hollow circle (2001)."""
    m = inner / outer
    top = 6 * (1 + poisson) ** 2 * (1 + m * m) ** 2
    rest = (7 + 12 * poisson + 4 * poisson**2) * (1 + m * m) ** 2
    return top / (rest + (4 * m * m) * (5 + 6 * poisson + 2 * poisson**2))


def stripped(part: Raw) -> Raw:
    """A component without what repeats along it."""
    return {key: value for key, value in part.items() if key not in (*OF_LENGTHS, "joint", "bend", "swivel")}


def of_joint(spec: Any) -> tuple[float, float, float, float, float, float]:
    """Share of tool joints in the length; area and second moment over the body's; bore; compliances along and about."""
    joint = spec.joint
    share = joint.tool_joint_length / joint.length
    bore = spec.inner_diameter if joint.tool_joint_inner is None else joint.tool_joint_inner
    (area, second), (wide, stiff) = (
        solid(spec.outer_diameter, spec.inner_diameter),
        solid(joint.tool_joint_diameter, bore),
    )
    larger, stiffer = wide / area, stiff / second
    return share, larger, stiffer, bore, 1 - share + share / larger, 1 - share + share / stiffer


def body(part: Raw, spec: Any) -> Raw:
    """The pipe between two tool joints: what is given of the whole is what body and tool joint make up in series."""
    _, _, _, _, along, about = of_joint(spec)
    area, _ = solid(spec.outer_diameter, spec.inner_diameter)
    new = stripped(part) | {"contact_diameter": spec.outer_diameter, "contact": "sleeve"}
    if spec.axial_stiffness is not None:
        new["axial_stiffness"] = spec.axial_stiffness * along
    if spec.torsional_stiffness is not None:
        new["torsional_stiffness"] = spec.torsional_stiffness * about
    if spec.linear_mass is not None:
        new["linear_mass"] = min(spec.linear_mass, spec.density * area)
    return new


def tool_joint(part: Raw, spec: Any) -> Raw:
    """A tool joint as a point: its diameters make it as much heavier and stiffer than the body."""
    share, larger, stiffer, bore, along, about = of_joint(spec)
    area, second = solid(spec.outer_diameter, spec.inner_diameter)
    modulus, poisson = spec.youngs_modulus, spec.poisson_ratio
    shear_modulus = modulus / (2 * (1 + poisson))
    mass = spec.density * area * (1 - share + share * larger) if spec.linear_mass is None else spec.linear_mass
    rest = min(mass, spec.density * area)
    wider = kappa(spec.joint.tool_joint_diameter, bore, poisson) / kappa(
        spec.outer_diameter, spec.inner_diameter, poisson
    )
    given = {
        "axial_stiffness": modulus * area if spec.axial_stiffness is None else spec.axial_stiffness * along,
        "torsional_stiffness": 2 * shear_modulus * second if spec.torsional_stiffness is None
        else spec.torsional_stiffness * about,
        "bending_stiffness": modulus * second if spec.bending_stiffness is None else spec.bending_stiffness,
        "shear_stiffness": kappa(spec.outer_diameter, spec.inner_diameter, poisson) * shear_modulus * area
        if spec.shear_stiffness is None else spec.shear_stiffness,
    }  # fmt: skip
    times = {"axial": larger, "torsional": stiffer, "bending": stiffer, "shear": larger * wider}
    return stripped(part) | {
        "contact_diameter": spec.contact_diameter, "contact": "point",
        "linear_mass": (mass - (1 - share) * rest) / share,
        **{key: value * times[key.removesuffix("_stiffness")] for key, value in given.items()},
    }  # fmt: skip


@statement("rigid centralisers = short wide components")
def centralisers_written(drawn: Drawn) -> None:
    """Those without a factor or a spring of their own."""
    parts = drawn.case.string.components
    chosen = [k for k, part in enumerate(parts) if part.fittings is not None and not part.has_own_contact]
    applies(chosen and not lengths_by_clearance(drawn))

    def write(k: int, part: Raw) -> list[Raw]:
        if k not in chosen:
            return [part]
        string = base(drawn).laid.string
        kinds = [string.parts[i].kind.value for i in string.component[string.origin == k][::-1]]
        pieces = []
        for length, kind in zip(lengths_in_hole(drawn, k), kinds, strict=True):
            wide = {"contact_diameter": parts[k].fittings.diameter, "contact": "point"} if kind == "fitting" else {}
            pieces.append(stripped(part) | {"contact": "sleeve", **wide, "length": length, "segments": 1})
        for key in ("bend", "swivel"):
            if key in part:
                pieces[-1][key] = part[key]
        return pieces

    same(drawn, changed(drawn, parts_of(drawn, write)), ROUNDING)


@statement("catalogue pipe = the same written out")
def pipe_written(drawn: Drawn) -> None:
    """What `pipe` gives stands in its place; loads alone, as connection and class then are not known."""
    applies(drawn.has("pipe"))
    names = ("outer_diameter", "inner_diameter", "contact_diameter", "linear_mass", "yield_strength")

    def write(k: int, part: Raw) -> list[Raw]:
        if part.pop("pipe", None) is not None:
            spec = drawn.case.string.components[k]
            part |= {key: getattr(spec, key) for key in names if getattr(spec, key) is not None}
            if spec.joint is not None:
                part["joint"] = spec.joint.model_dump(exclude_none=True)
        return [part]

    same(drawn, changed(drawn, parts_of(drawn, write)), EXACT, loads_only=True)


@statement("class of a pipe: strength alone")
def pipe_class(drawn: Drawn) -> None:
    """RP 7G classes say which wall is left for strength; the string weighs and bends as it was made."""
    worn = ", premium"
    applies(any(worn in part.get("pipe", "") for part in drawn.raw["string"]["components"]))

    def renew(k: int, part: Raw) -> list[Raw]:
        if "pipe" in part:
            part["pipe"] = part["pipe"].replace(worn, "")
        return [part]

    same(drawn, changed(drawn, parts_of(drawn, renew)), ROUNDING, loads_only=True)


@statement("names of components")
def renamed(drawn: Drawn) -> None:
    """No number depends on them."""

    def write(k: int, part: Raw) -> list[Raw]:
        return [part | {"name": f"{'zyx'[k % 3]} {k}"}]

    same(drawn, changed(drawn, parts_of(drawn, write)), EXACT)


@statement("segments = segment_length")
def by_length(drawn: Drawn) -> None:
    """So many segments of a component, or the length of each."""

    def write(k: int, part: Raw) -> list[Raw]:
        if "segments" in part and "length" in part:
            part["segment_length"] = part["length"] / part.pop("segments")
        return [part]

    applies(any("segments" in part and "length" in part for part in drawn.raw["string"]["components"]))
    same(drawn, changed(drawn, parts_of(drawn, write)), EXACT)


@statement("string above the table")
def surplus(drawn: Drawn) -> None:
    """A last component without a length reaches the table, as one that is longer does."""
    last = drawn.raw["string"]["components"][-1]
    applies("length" not in last and drawn.case.string.components[-1].cut_by_default)

    def write(raw: Raw) -> None:
        raw["string"]["components"][-1] |= {"length": 3000.0, "contact": "sleeve"}

    same(drawn, changed(drawn, write), ROUNDING)


@statement("perturbed by 1e-13 = itself (unbuckled)")
def perturbed(drawn: Drawn) -> None:
    """Noise of the size of rounding in stations and segments."""

    def noise(raw: Raw) -> None:
        raw.setdefault("solver", {})["perturbed"] = drawn.index

    same(drawn, changed(drawn, noise), ROUNDING)
