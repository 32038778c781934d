"""The table of a case file for the string: its components, from the bit upwards."""

from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, Self

from pydantic import Field, model_validator

from fctd.case import units
from fctd.case.errors import InputError, Table, exclusive
from fctd.case.message import quantity
from fctd.case.pipes.filling import STEEL, filled
from fctd.case.pipes.grades import YieldStrength

# A component is short, as stabilisers, reamers and bits are, up to so many times the diameter with which it touches.
SHORT = 12.0


class JointSpec(Table):
    """Joints of pipe, which repeat along a component: length of a joint, tool joint included, and its tool joint.

    Tool joints touch the wall, and the body hangs between them.
    """

    length: units.JointLength
    tool_joint_length: units.PositiveLength
    tool_joint_diameter: units.Diameter
    tool_joint_inner: units.Bore | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.tool_joint_length > 0.25 * self.length:
            raise InputError(f"at most a quarter of a joint of {quantity(self.length, 'm')}", key="tool_joint_length")
        if self.tool_joint_inner is not None and self.tool_joint_inner >= self.tool_joint_diameter:
            raise InputError("a diameter below tool_joint_diameter", key="tool_joint_inner")
        return self


class FittingSpec(Table):
    """Things on pipe that repeat along a component and touch the wall, at the lower end of every stretch of it.

    `length` and `diameter` are theirs, `segments` the number of segments of the pipe between two of them. They have the
    mass and the stiffness of the pipe. `friction` is their own factor; without it they have that of the hole.
    """

    every: units.PositiveLength
    diameter: units.Diameter
    length: units.PositiveLength = 0.3
    segments: units.SeveralCount = 4
    friction: units.Friction | None = None

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.length > 0.25 * self.every:
            raise InputError(
                f"at most a quarter of every, {quantity(self.every, 'm')}",
                key="length",
                value=quantity(self.length, "m"),
            )
        return self


class CentraliserSpec(FittingSpec):
    """Centralisers: rigid, or with bow springs where they have a `stiffness`.

    Bow springs press the pipe towards the axis of the hole with `stiffness` [N/m] for every metre that it lies off it.
    Hole that is no wider than their `diameter` compresses them: they then have `starting_force` [N] more friction,
    wherever the pipe lies. In wider hole they begin to press where they touch.
    """

    stiffness: units.PositiveStiffness | None = None
    starting_force: units.Force = 0.0

    @model_validator(mode="after")
    def _check_bows(self) -> Self:
        if self.starting_force and self.stiffness is None:
            raise InputError("a stiffness of bow springs beside it", key="starting_force")
        return self


class Repeat(NamedTuple):
    """How a component is laid: a thing of its own at the lower end of every stretch, and pipe above it.

    every : length of a stretch [m]; length : of the thing [m]; segments : number of those of the pipe.
    """

    every: float
    length: float
    segments: int


class ComponentSpec(Table):
    """Pipe or a tool of one kind. `segments` or `segment_length` [m] sets the length of its segments; without either
    they are short in bends and near the bit, and longer elsewhere.

    `outer_diameter` and `inner_diameter` are those of the pipe body; `contact_diameter` is that of tool joints or
    stabilisers, which touch the wall first. `linear_mass` (with tool joints) and the stiffnesses EA
    (`axial_stiffness`), EI (`bending_stiffness`), GJ (`torsional_stiffness`) and κGA (`shear_stiffness`) are computed
    from the pipe body where they are not given. The default `yield_strength` is that of S-135.

    A "sleeve" touches with its `contact_diameter` along its length, both ends included; beside a narrower neighbour
    the joint has the larger diameter. A "point" touches at its middle, the bit at its end; elsewhere it is no wider
    than the sleeves beside it. Without `contact` a component is a point up to a length of 12 contact diameters. Its
    segments, and those of its neighbours, do not matter.

    `pipe` is a pipe of the catalogue, which `fctd pipes` lists: it gives the keys that you leave out. Its class
    lowers the strength alone. `yield_strength` may be a grade, "S-135".

    With `joint` the largest bending moment of the pipe, at its tool joints or between them, is computed from the
    string's curvature, and mass and stiffnesses that are not given are those of body and tool joints together. With
    `joint_segments` the string is laid joint by joint: its tool joints touch, and each body between them is cut into so
    many segments, shorter towards the tool joints; what `contact` says does not matter.

    `centralisers` or `friction_reducers` repeat along a component, which is then laid from one to the next. A
    component with `swivel` turns freely against the one above it.

    A bent housing has its `bend` [rad] at the upper end, where the component is tilted against the one above
    it towards `toolface` [rad], which counts from the high side clockwise looking downhole.

    `eccentricity` [m] is the distance of the centre of mass from the axis; it acts in time alone.

    A tool has the `pressure_drop` [Pa] at a flow `at_flow` [m^3/s] of mud of the density `at_density`, by default
    that of water; it grows with density and the square of the flow.
    """

    name: str = Field(description="a name in quotes")
    pipe: str | None = Field(
        default=None, description="the name of a pipe in quotes, such as '5 in 19.5 S-135 NC50, premium'"
    )
    length: units.PositiveLength | None = None
    outer_diameter: units.Diameter
    inner_diameter: units.Bore
    joint: JointSpec | None = None
    contact_diameter: units.Diameter = Field(
        default_factory=lambda given: (
            given["joint"].tool_joint_diameter if given.get("joint") else given["outer_diameter"]
        )
    )
    contact: Literal["point", "sleeve"] = Field(
        default_factory=lambda given: (
            "point" if given["length"] and given["length"] <= SHORT * given["contact_diameter"] else "sleeve"
        )
    )
    segments: units.Count | None = None
    segment_length: units.PositiveLength | None = None
    joint_segments: units.SeveralCount | None = None
    centralisers: CentraliserSpec | None = None
    friction_reducers: FittingSpec | None = None
    swivel: bool = False
    linear_mass: units.PositiveLinearMass | None = None
    youngs_modulus: units.PositiveStress = 206.8e9
    poisson_ratio: units.PoissonRatio = 0.3
    density: units.PositiveDensity = STEEL
    thermal_expansion: units.Expansion = 12.42e-6  # of steel, 6.9e-6 per °F
    yield_strength: YieldStrength = 931e6  # of S-135, the strongest grade of API 5DP
    axial_stiffness: units.PositiveAxialStiffness | None = None  # EA
    bending_stiffness: units.PositiveBendingStiffness | None = None  # EI
    torsional_stiffness: units.PositiveBendingStiffness | None = None  # GJ
    shear_stiffness: units.PositiveAxialStiffness | None = None  # κGA
    bend: units.Bend = 0.0
    toolface: units.Angle = 0.0
    eccentricity: units.Length = 0.0
    pressure_drop: units.Pressure | None = None
    at_flow: units.PositiveFlow | None = None
    at_density: units.PositiveDensity = 1000.0

    @model_validator(mode="before")
    @classmethod
    def _fill_in_pipe(cls, raw: Any) -> Any:
        return filled(raw) if isinstance(raw, Mapping) else raw

    @model_validator(mode="after")
    def _check(self) -> Self:
        exclusive(self, "segments", "segment_length")
        if self.joint_segments is not None:
            if self.joint is None:
                raise InputError("a component with joint, whose bodies are cut", key="joint_segments")
            exclusive(self, "segments", "joint_segments")
            exclusive(self, "segment_length", "joint_segments")
        self._check_fittings()
        if (self.pressure_drop is None) != (self.at_flow is None):
            missing = "at_flow" if self.at_flow is None else "pressure_drop"
            raise InputError("pressure_drop and at_flow together", key=missing)
        if self.inner_diameter >= self.outer_diameter:
            raise InputError("a diameter below outer_diameter", key="inner_diameter")
        if self.eccentricity >= 0.5 * self.outer_diameter:
            raise InputError("less than half of outer_diameter", key="eccentricity")
        if self.contact_diameter < self.outer_diameter:
            raise InputError(f"at least outer_diameter, {quantity(self.outer_diameter, 'm')}", key="contact_diameter")
        if self.joint is not None and self.joint.tool_joint_diameter <= self.outer_diameter:
            raise InputError(
                f"more than outer_diameter, {quantity(self.outer_diameter, 'm')}", key="joint.tool_joint_diameter"
            )
        if self.joint is not None and self.contact_diameter < self.joint.tool_joint_diameter:
            least = self.joint.tool_joint_diameter
            raise InputError(f"at least joint.tool_joint_diameter, {quantity(least, 'm')}", key="contact_diameter")
        if self.contact == "point" and self.length is None:
            raise InputError("sleeve, for a component without a length", key="contact", value=self.contact)
        return self

    def _check_fittings(self) -> None:
        exclusive(self, "centralisers", "friction_reducers")
        if self.friction_reducers is not None and self.friction_reducers.friction is None:
            raise InputError("their friction factor", key="friction_reducers.friction")
        for name in ("centralisers", "friction_reducers"):
            fittings: FittingSpec | None = getattr(self, name)
            if fittings is None:
                continue
            for key in ("segments", "segment_length", "joint_segments"):
                exclusive(self, name, key)
            if fittings.diameter <= self.contact_diameter:
                expected = f"more than contact_diameter, {quantity(self.contact_diameter, 'm')}"
                raise InputError(expected, key=f"{name}.diameter", value=quantity(fittings.diameter, "m"))
            if self.contact == "point":
                raise InputError(f'"sleeve" beside {name}', key="contact", value=self.contact)

    @property
    def fittings(self) -> FittingSpec | None:
        """Its centralisers or friction reducers."""
        return self.centralisers or self.friction_reducers

    @property
    def has_bows(self) -> bool:
        """Whether it has bow springs."""
        return self.centralisers is not None and self.centralisers.stiffness is not None

    @property
    def has_own_contact(self) -> bool:
        """Whether its fittings touch otherwise than pipe does."""
        return self.has_bows or (self.fittings is not None and self.fittings.friction is not None)

    @property
    def repeat_key(self) -> str:
        """The key by which it repeats."""
        if self.fittings is None:
            return "joint_segments"
        return "centralisers" if self.centralisers is not None else "friction_reducers"

    @property
    def repeats(self) -> str:
        """What repeats along it, in words."""
        if self.fittings is None:
            return "joints"
        return f"stretches between {self.repeat_key.replace('_', ' ')}"

    @property
    def repeat(self) -> Repeat | None:
        """How it is laid where it has fittings or resolves its joints."""
        if (of := self.fittings) is not None:
            return Repeat(of.every, of.length, of.segments)
        if self.joint is not None and self.joint_segments is not None:
            return Repeat(self.joint.length, self.joint.tool_joint_length, self.joint_segments)
        return None

    @property
    def cut_by_default(self) -> bool:
        """Whether nothing is given that says how long its segments are."""
        return self.segments is None and self.segment_length is None and self.repeat is None

    @property
    def long_segment(self) -> bool:
        """Whether the component is one segment up to the top of the string, the paper's long segment."""
        return self.length is None and self.segments == 1


class StringSpec(Table):
    """The string, from the bit upwards. Without a length the last component reaches `top_md` [m]."""

    top_md: units.Length = 0.0
    components: tuple[ComponentSpec, ...] = Field(description="tables [[string.components]]")

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not self.components:
            raise InputError("at least one", key="components")
        for i, component in enumerate(self.components[:-1]):
            if component.length is None:
                expected = "a length, which only the last may omit, as components run from the bit up"
                raise InputError(expected, key=f"components[{i}].length")
        if self.components[-1].swivel:
            expected = "false, or a component above it, against which it turns"
            raise InputError(expected, key=f"components[{len(self.components) - 1}].swivel", value=True)
        return self
