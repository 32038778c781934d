"""A string with torsion and friction only: discs on torsion springs with dry friction.

Each segment is a spring GJ/ℓ with half of its moment of inertia at each end; a long segment thus is a spring with half
its inertia at its lower end.  Dry friction can stop a disc but not reverse it; its limits come from the soft string.
No code is shared with FCTD's stepper: no contact, no bending, no axial motion.
"""

from collections.abc import Callable

import numpy as np

from fctd.arrays import Array
from fctd.case.load import Case
from fctd.model.drillstring import lay_out
from references.soft_string.integration import soft_string


def twisted(case: Case, bit_depth: float, angle: Callable[[Array], Array], duration: float, step: float) -> Array:
    """Torque at the top [N m] after every step, for a string that starts untwisted at rest and is turned at its top.

    angle : function of times [s] to angles of the top drive [rad]; duration [s]; step [s] : stable below 1/π of the
    shortest period of the discs.
    """
    string = lay_out(case, bit_depth)
    sections = [string.sections[k] for k in string.component]
    spring = np.array([section.GJ for section in sections]) / string.length
    half = 0.5 * np.array([section.axial_inertia for section in sections]) * string.length
    inertia = half + np.append(half[1:], 0.0)
    ends = string.top_md + np.cumsum(string.length)
    middles = ends - 0.5 * string.length
    # Largest friction torque on a disc: increase of the soft string's torque between the middles of its two segments.
    soft = soft_string(case, "rotate_off_bottom", bit_depth).profile
    limit = -np.diff(np.interp(middles, soft.md, soft.torque), append=0.0)
    # Angles of the top drive and of the discs; largest change of a disc's rate by friction in a step.
    angles, rate, most = np.zeros(len(ends) + 1), np.zeros(len(ends)), step * limit / inertia
    torque = np.empty(round(duration / step))
    for k, drive in enumerate(angle(np.arange(1, len(torque) + 1) * np.float64(step))):
        angles[0] = drive
        pull = spring * (angles[:-1] - angles[1:])
        torque[k] = pull[0]
        pull[:-1] -= pull[1:]
        rate += step / inertia * pull
        rate -= np.minimum(np.maximum(rate, -most), most)
        angles[1:] += step * rate
    return torque
