"""Statements about strings of many parts: pipe that buckles joint by joint, and a bent string written in pieces."""

import numpy as np

from fctd.case.load import Case
from tests.equivalence.answers import ROUNDING, Answers, alike, apart, base, changed
from tests.equivalence.draws import Drawn
from tests.equivalence.holes import Raw
from tests.equivalence.table import applies, statement

# Tension presses pipe into a bend by where its segments end: the median of limits along it moves by less than this.
WHOLE_PIPE = 0.02
WEIGHTS_ON_BIT = (0.05, 0.1, 0.2, 0.4)  # of the string's weight


@statement("joints in series = segments in series")
def in_series(drawn: Drawn) -> None:
    """Half of each neighbouring segment gives way in a joint; what is below the last joint is no joint's."""
    string = base(drawn).laid.string
    for name in ("EA", "shear", "EI"):
        give = string.length / string.of(name)
        joints = float((1 / string.joints(name)).sum()) / float(give.sum() - 0.5 * give[-1])
        apart({name: joints}, {name: 1.0}, 1e-9)


@statement("two unlike sleeves touch with the wider one")
def wider_sleeve(drawn: Drawn) -> None:
    """At the joint of two segments the string is as wide as the wider of both."""
    string, parts = base(drawn).laid.string, drawn.case.string.components
    wide = np.array([0.5 * part.contact_diameter for part in parts])[string.origin]
    sleeve = np.array([part.contact == "sleeve" and part.repeat is None for part in parts])[string.origin]
    both = sleeve[:-1] & sleeve[1:]
    found, expected = string.contact_radius()[:-1][both], np.maximum(wide[:-1], wide[1:])[both]
    apart({"radius": found}, {"radius": expected}, 1e-12)


@statement("buckling of a row = of its profile", slow=True)
def buckled_row(drawn: Drawn) -> None:
    """Compression over the limit where a profile is buckled; pipe in joints buckles as a whole."""
    applies(drawn.has("joint", "joint_segments"))

    def pressed(share: float) -> Case:
        def press(raw: Raw) -> None:
            raw.get("solver", {}).pop("buckling", None)
            raw.get("contact", {}).pop("helical_force", None)
            raw["bit"], raw["operations"] = {"weight_on_bit": share * base(drawn).weight}, []
            for part in raw["string"]["components"]:
                part.pop("bend", None)
                if "joint" in part:
                    part["joint_segments"] = 2
                    for key in ("segments", "segment_length"):
                        part.pop(key, None)

        return changed(drawn, press)

    modes, compared = ("none", "sinusoidal", "helical"), 0
    for share in WEIGHTS_ON_BIT:
        point = Answers(pressed(share), drawn.depth)["drill_sliding"]
        if not point.answered:
            continue
        of = point.profile
        worst = modes[max(map(modes.index, of["buckling"]))]
        assert worst == point.buckling.mode, f"{share}: {point.buckling.mode}, in its profile {worst}"
        compared += worst != "none"
        limit = np.where(of["buckling"] == "none", np.inf, of["sinusoidal_limit_N"])
        excess = max(float((-of["effective_tension_N"] / limit).max()), 0.0)
        apart({"excess": point.buckling.excess}, {"excess": excess}, ROUNDING, f"{share}: ")
    applies(compared)


@statement("limits of buckling in joints = of pipe whose joints are not laid out")
def limits_in_joints(drawn: Drawn) -> None:
    """The pipe snakes as a whole, with its tool joints on the wall: its clearance is theirs, and not its body's."""
    parts = drawn.case.string.components
    joints = next((k for k, part in enumerate(parts) if part.joint is not None), None)
    applies(joints is not None)

    def limits(segments: int | None) -> np.ndarray:
        def cut(raw: Raw) -> None:
            part = raw["string"]["components"][joints]
            for key in ("segments", "segment_length", "joint_segments"):
                part.pop(key, None)
            part |= {"segment_length": 9.0} if segments is None else {"joint_segments": segments}

        answers = Answers(changed(drawn, cut), drawn.depth)
        point, origin = answers["trip_out"], answers.laid.string.origin
        applies(point.answered)
        of = point.profile[np.append(False, origin == joints)]
        found = np.interp(places, of["md_m"], of["sinusoidal_limit_N"])
        return np.asarray(found)

    origin = base(drawn).laid.string.origin == joints
    ends = drawn.case.string.top_md + np.append(0.0, np.cumsum(base(drawn).laid.string.length))
    places = np.linspace(ends[:-1][origin].min(initial=np.inf), ends[1:][origin].max(initial=-np.inf), 42)[1:-1]
    applies(origin.any())
    median = float(np.median(limits(2) / limits(None)))
    apart({"limit": median}, {"limit": 1.0}, WHOLE_PIPE)


@statement("a bent string = the same with each segment a component", slow=True)
def bent_in_pieces(drawn: Drawn) -> None:
    """A body has the stresses of the whole, however many components it is written in."""
    spec, top = drawn.case.string.components[-1], drawn.case.string.top_md
    body = {
        "name": "pipe", "outer_diameter": spec.outer_diameter, "inner_diameter": spec.inner_diameter,
        "contact_diameter": spec.contact_diameter, "contact": "sleeve",
    }  # fmt: skip
    housing = body | {"name": "housing", "length": 9.0, "segments": 3, "bend": 0.004, "toolface": 1.0}
    count = max(round((drawn.depth - top) / 30.0), 3)
    every = (drawn.depth - top - 9.0) / count

    def of(pipe: list[Raw]) -> Answers:
        def write(raw: Raw) -> None:
            raw["string"] = {"components": [housing, *pipe]} | ({"top_md": top} if top else {})

        return Answers(changed(drawn, write), drawn.depth)

    whole = of([body | {"segment_length": every, "length": count * every}])
    pieces = of([body | {"length": every, "segments": 1} for _ in range(count)])
    alike(whole, pieces, ("trip_out",), ROUNDING)
