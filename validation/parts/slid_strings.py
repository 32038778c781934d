"""A string that is fed into its hole in time: whether its bit follows its top, or stands while the push grows."""

from typing import NamedTuple

import pandas as pd

from fctd import Case, Simulation
from fctd.case.operations import KINDS
from fctd.steady.equilibrium import Solver

# Speed of the top [m/s] and the length fed [m]; Coulomb friction does not hang on the speed.
SPEED, FED = 0.1, 10.0
# The string stalls where its top needs a push of so many weights of the string, or where its bit moves by less than
# this share of the last ``LAST`` of the feed [m].
MOST, FOLLOWS, LAST = 10.0, 0.5, 2.5
DAMPING = 50.0  # lateral [N s/m²], which lets the string come to rest
# The hook load has settled where it changes by less than this share of the weight in ``FED``, and is waited for up to
# this length fed [m].
SETTLED, LONGEST = 1e-3, 50.0
RECORDED = 0.05  # [m] fed between two records


class Slid(NamedTuple):
    """How a string ended: status of the run, share of the feed that the bit moves, push in weights of the string, the
    length fed [m], and its profile."""

    status: str
    share: float
    push: float
    fed: float
    profile: pd.DataFrame

    @property
    def slides(self) -> bool:
        """Whether the bit follows the top."""
        return self.push <= MOST and self.share >= FOLLOWS


def slide(case: Case, kind: str, depth: float, speed: float = SPEED, settles: bool = False) -> Slid:
    """Feed a string into its hole until its bit is at a depth [m], off bottom and without rotation.

    settles : it is fed farther, until its hook load has settled, and begins as far above that depth as this may take.
    """
    if KINDS[kind].direction != 1 or KINDS[kind].on_bottom:
        raise ValueError(f"{kind} does not slide into the hole off bottom")
    string = Solver(case).lay_out(depth).string
    weight = float(string.weight @ string.length)
    begins = depth - (LONGEST if settles else FED)
    operation = {"kind": kind, "from_md": begins, "to_md": depth, "speed": speed, "ramp_time": 2.0}
    mud = case.mud.model_dump(exclude_defaults=True) | {"lateral_damping": DAMPING}
    changes = {"operations": [operation], "mud": mud, "bit": {}, "solver": {}, "record": {"interval": RECORDED / speed}}
    simulation = Simulation(Case.model_validate(case.model_dump(exclude_defaults=True) | changes))
    records: list[tuple[float, float, float]] = []
    for record in simulation:
        records.append((record["bit_depth_m"], record["bit_md_m"], -record["hookload_N"] / weight))
        if records[-1][2] > MOST or (settles and _has_settled(records, begins)):
            break
    fed, md, push = records[-1]
    before, stood, _ = next(row for row in records if row[0] >= fed - LAST)
    share = (md - stood) / (fed - before) if fed > before else 0.0
    return Slid(str(simulation.status), share, push, fed - begins, simulation.result().profile)


def _has_settled(records: list[tuple[float, float, float]], begins: float) -> bool:
    """Whether the push has stayed within ``SETTLED`` over the last ``FED``."""
    fed = records[-1][0]
    if fed - begins < FED:
        return False
    over = [push for depth, _, push in records if depth >= fed - FED]
    return max(over) - min(over) < SETTLED
