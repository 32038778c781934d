"""The table of a case file for how much of what the string bears it may be loaded with."""

from fctd.case import units
from fctd.case.errors import Table


class LimitsSpec(Table):
    """How near to its limits the string may be loaded.

    Stress, tension, pressure and the weight in slips may reach the string's capacity over the `design_factor`, and the
    torque `torque_share` of the make-up torque of its tool joints. `overpull_margin` [N] is the pull at the hook that
    is to be left for a string that is stuck. Notes and `fctd limits` say where a load is beyond; what is computed is
    not limited.
    """

    design_factor: units.DesignFactor = 1.0
    torque_share: units.PositiveShare = 1.0
    overpull_margin: units.Force = 0.0

    @property
    def all_used(self) -> bool:
        """Whether all of each capacity may be used."""
        return self.design_factor == 1.0 and self.torque_share == 1.0
