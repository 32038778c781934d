"""A string that is fed into its hole in time: whether its bit follows its top, or stands while the push grows."""

from typing import NamedTuple

from fctd import Case, Simulation
from fctd.case.operations import KINDS
from fctd.steady.equilibrium import Solver

# Speed of the top [m/s] and the length fed [m]; Coulomb friction does not hang on the speed.
SPEED, FED = 0.1, 10.0
# The string stalls where its top needs a push of so many weights of the string, or where its bit moves by less than
# this share of the last quarter of the feed.
MOST, FOLLOWS = 10.0, 0.5
DAMPING = 50.0  # lateral [N s/m²], which lets the string come to rest


class Slid(NamedTuple):
    """How a string ended: status of the run, share of the feed that the bit moves, push in weights of the string."""

    status: str
    share: float
    push: float

    @property
    def slides(self) -> bool:
        """Whether the bit follows the top."""
        return self.push <= MOST and self.share >= FOLLOWS


def slide(case: Case, kind: str, depth: float) -> Slid:
    """Feed a string into its hole until its bit is at a depth [m], off bottom and without rotation."""
    if KINDS[kind].direction != 1 or KINDS[kind].on_bottom:
        raise ValueError(f"{kind} does not slide into the hole off bottom")
    string = Solver(case).lay_out(depth).string
    weight = float(string.of("weight") @ string.length)
    operation = {"kind": kind, "from_md": depth - FED, "to_md": depth, "speed": SPEED, "ramp_time": 2.0}
    mud = case.mud.model_dump(exclude_defaults=True) | {"lateral_damping": DAMPING}
    changes = {"operations": [operation], "mud": mud, "bit": {}, "solver": {}, "record": {"interval": 0.5}}
    simulation = Simulation(Case.model_validate(case.model_dump(exclude_defaults=True) | changes))
    records = []
    for record in simulation:
        records.append((record["bit_depth_m"], record["bit_md_m"], -record["hookload_N"] / weight))
        if records[-1][2] > MOST:
            break
    fed, md, push = records[-1]
    before, stood, _ = next(row for row in records if row[0] >= fed - 0.25 * FED)
    share = (md - stood) / (fed - before) if fed > before else 0.0
    return Slid(str(simulation.status), share, push)
