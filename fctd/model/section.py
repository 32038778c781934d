"""Components of a string per metre of their length: mass, stiffness, and the weight in their fluids (§3.2, 5.1)."""

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any, Final, NamedTuple

import numpy as np

from fctd.case.pipes.catalogue import pipe_named
from fctd.case.pipes.names import CASING, TUBING
from fctd.case.string import ComponentSpec, JointSpec
from fctd.mechanics.topdrive import GRAVITY
from fctd.model.capacity import Body
from fctd.model.connection import make_up_torque


class Section(NamedTuple):
    """Properties of a component per metre of its length.

    mass [kg/m], weight (buoyed) [N/m], axial_inertia and tilt_inertia [kg m], EA [N], GJ, EI [N m^2],
    shear κGA [N], outer, inner and contact radius [m], yield_strength [Pa], eccentricity of the mass [m]; point : 1 for
    a component that touches at a point, 0 for a sleeve; compressibility : strain along by pressure on all sides [1/Pa];
    joint, tool_joint : lengths of a joint of pipe and of its tool joint [m], 0 where they are not given; make_up :
    largest make-up torque of its tool joints [N m], infinite where it is not known; body_weight : of its body alone,
    buoyed [N/m]; density : of the steel [kg/m^3]; body_mass : of its body alone [kg/m]; expansion : thermal [1/K];
    burst, collapse : pressures that its body bears, beyond that on its other side [Pa]; wave_weight [N/m], wave_mass
    [kg/m], wave_stiffness [N m^2], wave_radius [m] : with which pipe buckles as a whole; own_friction : factor of its
    contact, 0 where it is that of the hole; bow_stiffness [N/m], starting_force [N] : of bow springs, 0 without them;
    swivel : 1 where its upper end turns freely; worn_outer : outer radius with the wall that its class leaves to its
    strength [m]; yields_earlier : 1 where tension lowers the yield strength in its collapse (API TR 5C3), 0 where it
    lowers its collapse pressure (API RP 7G).

    A resolved tool joint has a ``tool_joint`` and no ``joint``, and a body neither: what they do to the bending of the
    pipe is computed.  Outer and inner radius of the tool joint are those of its body, whose end is stressed most.
    """

    mass: float
    weight: float
    axial_inertia: float
    tilt_inertia: float
    EA: float
    GJ: float
    EI: float
    shear: float
    outer: float
    inner: float
    contact_radius: float
    yield_strength: float
    eccentricity: float = 0.0
    point: float = 0.0
    compressibility: float = 0.0
    joint: float = 0.0
    tool_joint: float = 0.0
    make_up: float = math.inf
    body_weight: float = 0.0
    density: float = 0.0
    body_mass: float = 0.0
    expansion: float = 0.0
    burst: float = math.inf
    collapse: float = math.inf
    wave_weight: float = 0.0
    wave_mass: float = 0.0
    wave_stiffness: float = 0.0
    wave_radius: float = 0.0
    own_friction: float = 0.0
    bow_stiffness: float = 0.0
    starting_force: float = 0.0
    swivel: float = 0.0
    worn_outer: float = 0.0
    yields_earlier: float = 0.0


# Sections that differ by no more are one, written in other units.
SAME: Final = 1e-9


def same_section(one: Section, other: Section) -> bool:
    """Whether two sections are equal but for the rounding of their units, and for a mass beside the axis.

    ``eccentricity`` acts in time alone, and a steady string has the stresses of the same body with it.
    """
    one = one._replace(eccentricity=other.eccentricity)
    return all(a == b or abs(a - b) <= SAME * abs(b) for a, b in zip(one, other, strict=True))


# In place of an own friction factor of 0, which would stand for that of the hole.
FRICTIONLESS: Final = 1e-12


def contact_radii(components: Iterable[ComponentSpec]) -> tuple[float, ...]:
    """The radii with which components, or the parts of their joints, touch the wall [m]."""
    found = set()
    for component in components:
        parts = [section_of(component, 0.0)]
        if component.joint_segments is not None:
            parts += [tool_joint_of(component, 0.0), body_of(component, 0.0)]
        if component.fittings is not None:
            parts.append(fitting_of(component, 0.0))
        found |= {part.contact_radius for part in parts}
    return tuple(sorted(found))


def shear_coefficient(outer: float, inner: float, poisson: float) -> float:
    """Timoshenko's κ of a hollow circle (Eq. 20 as Hutchinson 2001 has it, with (1 + ν)²)."""
    a, b, nu = inner, outer, poisson
    top = 6 * (a * a + b * b) ** 2 * (1 + nu) ** 2
    rest = 7 * a**4 + 34 * a**2 * b**2 + 7 * b**4
    rest += nu * (12 * a**4 + 48 * a**2 * b**2 + 12 * b**4)
    rest += nu**2 * (4 * a**4 + 16 * a**2 * b**2 + 4 * b**4)
    return top / rest


def buoyed(mass: Any, density: Any, inner: Any, outside: Any, inside: Any) -> Any:
    """Weight of a metre of pipe and of the fluid in its bore, less that of the fluid outside that it displaces [N/m].

    mass [kg/m] and density [kg/m³] of the steel; inner radius [m]; densities outside and inside [kg/m³]; numbers or
    arrays.
    """
    return mass * GRAVITY * (1 - outside / density) + (inside - outside) * GRAVITY * np.pi * inner * inner


@lru_cache(maxsize=256)  # a chart lays out the same components at every depth
def section_of(component: ComponentSpec, outside: float, inside: float | None = None) -> Section:
    """Properties of a component per metre, with fluids of these densities [kg/m³] outside and inside.

    The steel displaces the fluid outside (buoyancy factor, Eq. 25), and the bore contains that inside, by default the
    same, in its place.  Inertia is that of the steel.
    """
    inside = outside if inside is None else inside
    b, a = 0.5 * component.outer_diameter, 0.5 * component.inner_diameter
    area = np.pi * (b * b - a * a)
    second = np.pi / 4 * (b**4 - a**4)
    modulus = component.youngs_modulus
    shear_modulus = modulus / (2 * (1 + component.poisson_ratio))
    kappa = shear_coefficient(b, a, component.poisson_ratio)
    share, larger, stiffer = _of_tool_joints(component)
    mass = component.linear_mass
    if mass is None:
        mass = component.density * area * (1 + share * (larger - 1))

    body, body_mass = _body(component), min(component.density * area, mass)

    def given(value: float | None, computed: float) -> float:
        return computed if value is None else value

    return Section(
        mass=mass,
        weight=buoyed(mass, component.density, a, outside, inside),
        axial_inertia=0.5 * mass * (a * a + b * b),
        tilt_inertia=0.25 * mass * (a * a + b * b),
        EA=given(component.axial_stiffness, modulus * area / (1 - share * (1 - 1 / larger))),
        GJ=given(component.torsional_stiffness, shear_modulus * 2 * second / (1 - share * (1 - 1 / stiffer))),
        EI=given(component.bending_stiffness, modulus * second),
        shear=given(component.shear_stiffness, kappa * shear_modulus * area),
        outer=b,
        inner=a,
        contact_radius=0.5 * component.contact_diameter,
        yield_strength=component.yield_strength,
        eccentricity=component.eccentricity,
        point=float(component.contact == "point"),
        compressibility=(1 - 2 * component.poisson_ratio) / modulus,
        joint=0.0 if component.joint is None else component.joint.length,
        tool_joint=0.0 if component.joint is None else component.joint.tool_joint_length,
        make_up=_make_up(component),
        body_weight=buoyed(body_mass, component.density, a, outside, inside),
        density=component.density,
        body_mass=body_mass,
        expansion=component.thermal_expansion,
        burst=body.burst,
        collapse=body.collapse,
        wave_weight=buoyed(mass, component.density, a, outside, inside),
        wave_mass=mass,
        wave_stiffness=given(component.bending_stiffness, modulus * second),
        worn_outer=0.5 * body.worn_outer,
        yields_earlier=float(body.is_steel and _is_casing(component)),
    )


def bearing(section: Section) -> Body:
    """The body of a section with the wall that its class leaves to its strength."""
    left = (section.worn_outer - section.inner) / (section.outer - section.inner)
    return Body(2 * section.outer, 2 * section.inner, section.yield_strength, left)


def fitting_of(component: ComponentSpec, outside: float) -> Section:
    """Properties of a centraliser or a friction reducer of a component, in fluid of a density [kg/m³]."""
    of, bows = component.fittings, component.centralisers
    assert of is not None  # the caller has asked
    return section_of(component, outside)._replace(
        contact_radius=0.5 * of.diameter, point=1.0, joint=0.0, tool_joint=0.0,
        own_friction=0.0 if of.friction is None else max(of.friction, FRICTIONLESS),
        bow_stiffness=0.0 if bows is None or bows.stiffness is None else bows.stiffness,
        starting_force=0.0 if bows is None else bows.starting_force,
    )  # fmt: skip


@lru_cache(maxsize=64)
def released(section: Section) -> Section:
    """The same section with a swivel at its upper end."""
    return section._replace(swivel=1.0)


def body_of(component: ComponentSpec, outside: float) -> Section:
    """Properties of the body of a component with ``joint``, in fluid of a density [kg/m³].

    With those of ``tool_joint_of`` they make up those of the component: mass and weight in all, the compliance along
    and about the axis in series.
    """
    whole, (share, larger, stiffer) = section_of(component, outside), _of_tool_joints(component)
    b, a = whole.outer, whole.inner
    mass = min(component.density * np.pi * (b * b - a * a), whole.mass)
    return whole._replace(
        mass=mass, weight=whole.body_weight, axial_inertia=0.5 * mass * (a * a + b * b),
        tilt_inertia=0.25 * mass * (a * a + b * b), EA=whole.EA * (1 - share * (1 - 1 / larger)),
        GJ=whole.GJ * (1 - share * (1 - 1 / stiffer)), contact_radius=b, point=0.0, joint=0.0, tool_joint=0.0,
        wave_radius=whole.contact_radius,
    )  # fmt: skip


def tool_joint_of(component: ComponentSpec, outside: float) -> Section:
    """Properties of the tool joint of a component with ``joint``, in fluid of a density [kg/m³].

    It weighs what the component does beyond its body.  A stiffness that is given for the component is that of its body;
    the tool joint's is as much larger as their diameters make it.
    """
    whole, body, (share, larger, stiffer) = (
        section_of(component, outside),
        body_of(component, outside),
        _of_tool_joints(component),
    )
    assert component.joint is not None  # the caller has one
    (d, c), poisson = tool_joint_radii(component.joint, whole.inner), component.poisson_ratio
    mass = (whole.mass - (1 - share) * body.mass) / share
    wider = shear_coefficient(d, c, poisson) / shear_coefficient(whole.outer, whole.inner, poisson)
    return body._replace(
        mass=mass, weight=(whole.weight - (1 - share) * body.weight) / share,
        axial_inertia=0.5 * mass * (c * c + d * d), tilt_inertia=0.25 * mass * (c * c + d * d), EA=body.EA * larger,
        GJ=body.GJ * stiffer, EI=body.EI * stiffer, shear=body.shear * larger * wider,
        contact_radius=whole.contact_radius, point=1.0, tool_joint=component.joint.tool_joint_length,
    )  # fmt: skip


def tool_joint_radii(joint: JointSpec, bore: float) -> tuple[float, float]:
    """Outer and inner radius of a tool joint [m]; bore : inner radius of the body."""
    inner = bore if joint.tool_joint_inner is None else 0.5 * joint.tool_joint_inner
    return 0.5 * joint.tool_joint_diameter, inner


def _of_tool_joints(component: ComponentSpec) -> tuple[float, float, float]:
    """Share of tool joints in the length, and how many times as large their area and second moment are as the body's.

    Without tool joints nothing is added to the body.
    """
    joint = component.joint
    if joint is None:
        return 0.0, 1.0, 1.0
    b, a = 0.5 * component.outer_diameter, 0.5 * component.inner_diameter
    d, c = tool_joint_radii(joint, a)
    share = joint.tool_joint_length / joint.length
    return share, (d * d - c * c) / (b * b - a * a), (d**4 - c**4) / (b**4 - a**4)


def _make_up(component: ComponentSpec) -> float:
    torque = None if component.pipe is None else make_up_torque(pipe_named(component.pipe))
    return math.inf if torque is None else torque


def _is_casing(component: ComponentSpec) -> bool:
    """Whether its pipe is casing or tubing of the catalogue."""
    return component.pipe is not None and pipe_named(component.pipe).kind in (CASING, TUBING)


def _body(component: ComponentSpec) -> Body:
    """The body that bears the loads: its class leaves a share of the nominal wall, or a measured diameter less."""
    outer, inner, share = component.outer_diameter, component.inner_diameter, 1.0
    if component.pipe is not None and (pipe := pipe_named(component.pipe)).wall_share < 1:
        wall, measured = pipe.outer - pipe.inner, outer - inner  # on both sides
        outer = inner + max(wall, measured)
        share = min(pipe.wall_share * wall, measured) / (outer - inner)
    return Body(outer, inner, component.yield_strength, share, component.youngs_modulus, component.poisson_ratio)
