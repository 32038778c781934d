"""Wells that can be drilled, with their strings; the checks of mechanics apply to their answers."""

from random import Random

from tests.fuzz.items import Item
from tests.strategies import write_case
from validation.parts import random_wells


def well(rng: Random, simulated: bool = False) -> Item:
    """A well, a string and operations; coarse, and with a short operation, where it is to be simulated."""
    return Item(write_case(random_wells.well(rng, simulated)).encode(), plausible=True, simulated=simulated)
