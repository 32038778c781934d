"""Bending of a pipe's body that touches the wall between two tool joints.

A body that hangs between tool joints (``hanging_body``) sags towards the wall, by u from the arc of the hole through
its tool joints: EI u'''' − T u'' = p, where p is the load per length by which tension in the bend and weight press it.
The wall first presses it back in its middle.  Once that force would bend the middle beyond the hole's own curvature, a
stretch of the body lies on the wall with that curvature.  A part of length a hangs between each of its edges and a tool
joint.  At an edge u is the room towards the wall, u' = 0 and u'' = 0, and a is such that the other end of the part
meets the tool joint.  Of a clamped body without tension the room is p a⁴/72 EI, and p a²/6 the moment that the load
adds at the tool joint.

From the middle or the edge, m = u'' is A cosh κs + B sinh κs/κ + f (cosh κs − 1)/κ², with κ² = T/EI and f = p/EI, and
u' and u are its integrals; in compression cos and sin take the place of cosh and sinh.
"""

import math
from typing import Final

from fctd.mechanics.jit import inlined, kernel

# Below, factors are those of their series; above the second, in tension, products of them lose digits and are written
# out.
SERIES: Final = 0.5
WRITTEN_OUT: Final = 5.0
# Below, curvature is a parabola along the body.
PARABOLA: Final = 1e-3
# The edge of the stretch on the wall is found to this share of its place, by Newton's steps in a few rounds; where a
# step leaves the bracket this is halved, which alone takes 40.
CLOSE: Final = 1e-12
ROUNDS: Final = 60


@inlined
def integrals_of(x, tensile):
    """Repeated integrals of cosh x (of cos x in compression) from 0, over their power of x: c₁ to c₄.

    c₁ = sinh x/x, c₂ = (cosh x − 1)/x², c₃ = (sinh x − x)/x³, c₄ = (cosh x − 1 − x²/2)/x⁴.
    """
    square = x * x if tensile else -x * x
    if x < SERIES:
        c3 = (1 + square / 20 * (1 + square / 42 * (1 + square / 72 * (1 + square / 110)))) / 6
        c4 = (1 + square / 30 * (1 + square / 56 * (1 + square / 90 * (1 + square / 132)))) / 24
        return 1 + square * c3, 0.5 + square * c4, c3, c4
    even, odd = (math.cosh(x), math.sinh(x)) if tensile else (math.cos(x), math.sin(x))
    c1, c2 = odd / x, (even - 1) / square
    return c1, c2, (c1 - 1) / square, (c2 - 0.5) / square


@inlined
def spans_of(x, tensile):
    """Factors of a span by x = κL: 1, c₁ to c₄, and c₃² − c₂c₄, c₂c₃ − c₁c₄, c₂² − c₁c₃, c₁c₂ − c₀c₃.

    All are over cosh x in long spans under tension, of which only ratios are used.
    """
    if tensile and x > WRITTEN_OUT:
        one, odd, square = 1 / math.cosh(min(x, 300.0)), math.tanh(x), x * x
        c1, c2 = odd / x, (1 - one) / square
        c3, c4 = (c1 - one) / square, (c2 - 0.5 * one) / square
        return (
            one, c1, c2, c3, c4,
            (0.5 * square * (1 + one) - 2 * x * odd + 2 - 2 * one) / square**3,
            (0.5 * x * odd - 1 + one) / square**2,
            (x * odd - 2 + 2 * one) / square**2,
            (x - odd) / (x * square),
        )  # fmt: skip
    c1, c2, c3, c4 = integrals_of(x, tensile)
    c0 = 1 + x * x * c2 if tensile else 1 - x * x * c2
    return 1.0, c1, c2, c3, c4, c3 * c3 - c2 * c4, c2 * c3 - c1 * c4, c2 * c2 - c1 * c3, c1 * c2 - c0 * c3


@inlined
def lifts(span, k, tensile, load, room, soft, straight):
    """Above 0 where a span to the wall is too short to lie on it: its end there would bend away from the wall [m].

    span [m]; k : κ [1/m]; the others as ``bend_touching`` has them.
    """
    _, c1, c2, c3, _, d1, d2, _, _ = spans_of(k * span, tensile)
    return room * (c2 * span + soft * c1) - load * span**4 * (d1 * span + soft * d2) + straight * c3 * span * span


@kernel
def edge_of(free, k, tensile, load, room, soft, straight):
    """Length of the part between a tool joint and the stretch on the wall [m], below ``free``."""
    low, high = 0.0, free
    span = min((72 * room / load) ** 0.25, 0.5 * free)  # of a clamped body without tension
    for _ in range(ROUNDS):
        here = lifts(span, k, tensile, load, room, soft, straight)
        low, high = (span, high) if here > 0 else (low, span)
        step = 1e-7 * span
        slope = (lifts(span + step, k, tensile, load, room, soft, straight) - here) / step
        new = span - here / slope if slope != 0 else low
        if not low < new < high:
            new = 0.5 * (low + high)
        if abs(new - span) < CLOSE * span:
            return new
        span = new
    return span


@inlined
def lowest_of(tension, k, span, inner, slope, load):
    """Least curvature between the ends of a span and how far from the inner end it is [1/m, m].

    inner, slope : curvature at the inner end [1/m] and how it grows outwards [1/m²].  Where it has none there, that of
    the inner end.
    """
    if k * span < PARABOLA:
        at = -slope / load
        return (inner + 0.5 * slope * at, at) if 0 < at < span else (inner, 0.0)
    mean = -load / (k * k) if tension >= 0 else load / (k * k)
    even, odd = inner - mean, slope / k
    if tension >= 0:
        ratio = -odd / even if even != 0 else 0.0
        if not 0 < ratio < math.tanh(k * span):
            return inner, 0.0
        return mean + even * math.sqrt(1 - ratio * ratio), math.atanh(ratio) / k
    at, swing = math.atan2(-odd, -even), -math.sqrt(even * even + odd * odd)
    if at < 0:  # the largest one, half a wave further
        at, swing = at + math.pi, -swing
    return (mean + swing, at / k) if at < k * span else (inner, 0.0)


@kernel
def bend_touching(tension, stiffness, free, lever, give, bent, load, room):
    """Curvature that the load adds at the end of a body that touches, in its middle and between, and where the last is.

    tension [N]; free : half length of the body [m]; lever : half length of a tool joint [m], of which ``give`` is the
    curvature over that of a body with its moment; bent : curvature of the hole towards the wall [1/m]; load [N/m],
    above 0, and room [m] : towards the wall.  Curvatures [1/m] towards the tool joints, the place from the middle [m].
    """
    tensile, k = tension >= 0, math.sqrt(abs(tension) / stiffness)
    load, soft, straight = load / stiffness, lever * give, lever * bent * (1 - give)
    rest = lifts(free, k, tensile, load, room, soft, straight)
    span = free if rest > 0 else edge_of(free, k, tensile, load, room, soft, straight)
    one, c1, c2, c3, c4, _, d2, e1, e2 = spans_of(k * span, tensile)
    middle = -rest / (span * span * (e1 * span + soft * e2)) if rest > 0 else 0.0
    slope = -(room * one / span**3 + load * span * c4 + middle * c2 / span) / c3
    end = (load * span * span * d2 - room * c1 / (span * span) - middle * e2) / c3
    lowest, at = lowest_of(tension, k, span, middle, slope, load)
    return end, middle, lowest, free - span + at
