"""What the rows cannot tell apart, by name: from the derivatives of the readings over their noise.

An unknown is not determined where its standard deviation exceeds its typical size and nearly all of it comes from
other unknowns that have the same effect on the readings.  A prior is one more reading, and may hold it.
"""

from collections.abc import Collection
from typing import Final, NamedTuple

import numpy as np

from fctd.arrays import Array
from fctd.calibration.forward import Evaluation, Forward
from fctd.case.errors import InputError

# Multiple correlation with the other unknowns above which an unknown has no effect of its own, and the correlation of
# a pair above which one partner explains it.
EXPLAINED: Final = 0.97
PAIR: Final = 0.95
PARTNER: Final = 0.5
# Standard deviations by which a change of an unknown by its typical size must change all readings together.
LEAST: Final = 0.25
# Share by which the length of a component in the hole must differ between rows to weigh it beside the block.
ALIKE: Final = 0.2
# What separates pairs, by the beginnings of their names.
_REMEDIES: Final = (
    ("rig.sheave_efficiency", "rig.guide_friction", "rows up and down at hook loads that are far apart"),
    ("rig.torque_offset", "friction", "rotating rows at contact loads that are far apart, or a tare"),
    ("rig.block_weight", "mass.", "a row in slips, which weighs the block alone"),
    ("rig.block_weight", "mud.density", "a row in slips, and rows at depths that are far apart"),
    ("rig.torque_offset", "rig.torque_per_rpm", "rotating rows or tares at different rev/min"),
    ("bias.hookload", "rig.block_weight", "rows of another source"),
    ("bias.torque", "rig.torque_offset", "rows of another source"),
    ("mass.", "mud.density", "rows of strings with other components"),
    ("friction", "friction", "rows at more depths, of which some lie above the lower interval"),
)


class Undetermined(NamedTuple):
    """Unknowns that the rows cannot tell apart (one: the rows hardly depend on it), and what would separate them."""

    names: tuple[str, ...]
    remedy: str

    def __str__(self) -> str:
        if len(self.names) == 1:
            return f"{self.names[0]} has hardly any effect on the rows: {self.remedy}"
        return f"{' and '.join(self.names)} cannot be told apart: {self.remedy}"


def information(forward: Forward, evaluation: Evaluation, used: Collection[int]) -> Array:
    """Derivatives of the readings of used rows over their noise, by the unknowns (n, k), and those of the priors.

    A range counts as a value with the variance of its noise and of a uniform distribution over it.
    """
    rows = []
    for i, reading in enumerate(forward.readings):
        low, high = reading.range.low, reading.range.high
        if reading.row in used and not np.isnan(low) and np.isfinite(evaluation.slopes[i]).all():
            noise = np.hypot(reading.noise, (high - low) / np.sqrt(12))
            rows.append(np.sqrt(forward.rows[reading.row].weight) / noise * evaluation.slopes[i])
    for k, unknown in enumerate(forward.unknowns):
        if unknown.prior is not None:
            rows.append(np.eye(len(forward.unknowns))[k] / unknown.prior.sd)
    return np.array(rows).reshape(-1, len(forward.unknowns))


def covariance_of(jacobian: Array, sizes: Array) -> Array:
    """(JᵀJ)⁻¹ (k, k) of derivatives over the noise; directions without effect have a large variance, not none."""
    _, s, V = np.linalg.svd(jacobian * sizes, full_matrices=True)
    singular = np.zeros(len(sizes))
    singular[: len(s)] = s
    # A standard deviation of a million typical sizes stands for none.
    inverse = 1 / np.maximum(singular, 1e-6)
    half = V.T * inverse
    return np.asarray(half @ half.T * np.outer(sizes, sizes))


def undetermined(forward: Forward, evaluation: Evaluation, used: Collection[int]) -> list[Undetermined]:
    """The unknowns that the used rows and the priors do not determine."""
    sizes = np.array([unknown.size for unknown in forward.unknowns])
    J = information(forward, evaluation, used)
    names = forward.names
    found = []
    for k, name in enumerate(names):
        if not np.linalg.norm(J[:, k]) * sizes[k] >= LEAST:
            found.append(Undetermined((name,), "leave it out, or give rows or a prior for it"))
    found += _block_and_masses(forward, used)
    cut = [k for k, name in enumerate(names) if all(name not in one.names for one in found)]
    C = covariance_of(J[:, cut], sizes[cut])
    sd = np.sqrt(np.diag(C))
    alone = np.sqrt((J[:, cut] ** 2).sum(axis=0))
    correlation = C / np.outer(sd, sd)
    groups: set[frozenset[int]] = set()
    for k in range(len(cut)):
        # Share of the variance that the other unknowns cause: 1 − 1/(C_kk H_kk).
        explained = np.sqrt(max(1 - 1 / (sd[k] * alone[k]) ** 2, 0.0))
        if sd[k] <= sizes[cut][k] or explained < EXPLAINED:
            continue
        others = [int(j) for j in np.argsort(-np.abs(correlation[k])) if j != k]
        # Partners that each explain it alone, or else those that do so together.
        alike = [j for j in others if abs(correlation[k][j]) >= PAIR]
        near = alike or [j for j in others if abs(correlation[k][j]) >= PARTNER]
        groups.add(frozenset([k, *near]))
    whole = [group for group in groups if not any(group < other for other in groups)]
    for group in sorted(whole, key=sorted):
        members = tuple(names[cut[k]] for k in sorted(group))
        found.append(Undetermined(members, _remedy(members)))
    return found


def _block_and_masses(forward: Forward, used: Collection[int]) -> list[Undetermined]:
    """The block's weight and each mass that hangs below it in all rows alike, without a row that weighs the block.

    Side force and so torque tell them apart a little; a block weight from them is that of the friction model.
    """
    block = "rig.block_weight"
    held = {unknown.name for unknown in forward.unknowns if unknown.prior is not None}
    weighed = [forward.rows[k] for k in used if forward.rows[k].hookload is not None]
    if block not in forward.names or block in held or any(not row.has_string for row in weighed):
        return []
    found = []
    for name in forward.names:
        if name.startswith("mass.") and name not in held:
            lengths = [forward.length_in_hole(name, row) for row in weighed]
            if lengths and max(lengths) - min(lengths) <= ALIKE * max(lengths):
                found.append(Undetermined((block, name), _remedy((block, name))))
    return found


def refuse(found: list[Undetermined]) -> None:
    """Raise InputError for unknowns that are not determined."""
    if found:
        expected = f"rows that tell the unknowns apart, or a prior for one of each: {'; '.join(map(str, found))}"
        raise InputError(expected, key="fit", value=[name for one in found for name in one.names])


def _remedy(names: tuple[str, ...]) -> str:
    for one, other, remedy in _REMEDIES:
        for a in names:
            for b in names:
                if a != b and a.startswith(one) and b.startswith(other):
                    return f"they need {remedy}"
    return "they need rows in which they act differently"
