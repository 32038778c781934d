"""Random straight strings under compression, each on several meshes that ought to give the same loads."""

from random import Random
from typing import Any, NamedTuple

import numpy as np

from fctd import Case
from fctd.model.operations import SteadyRates, steady_rates
from fctd.model.section import section_of
from fctd.results.buckling import HANGING_SINUSOIDAL
from fctd.steady.equilibrium import Solver
from fctd.steady.laid_string import LaidString
from fctd.steady.problem import Pose, Problem
from fctd.steady.shape import Shape
from fctd.steady.steady_string import Equilibrium

OPERATION = "drill_sliding"
# Outer and inner diameter of pipes and least and largest hole [in].
PIPES = (
    (2.375, 1.995, 3.5, 6.2), (2.875, 2.441, 4.0, 6.2), (3.5, 2.764, 4.9, 8.5), (4.5, 3.826, 6.0, 12.25),
    (5.0, 4.276, 6.5, 12.25), (5.5, 4.778, 7.0, 12.25), (6.625, 5.965, 8.5, 17.5), (6.5, 2.8125, 7.875, 12.25),
)  # fmt: skip
INCH = 0.0254
# Inclinations [°]: exactly vertical, nearly so, inclined, nearly level.
INCLINATIONS = ((0.0, 0.0), (0.1, 3.0), (3.0, 75.0), (75.0, 90.0))
FRICTIONLESS = 0.2  # share of the strings
LOAD = (0.4, 2.6)  # over the sinusoidal limit, at the bit
WAVES = (4.0, 14.0)  # half waves in the string
SEGMENT = (0.1, 0.7)  # of a half wave
SPLIT = 0.37  # of the string, in the first of two like components
BLOCK = 1e7  # weight that can push any string [N]


class Drawn(NamedTuple):
    """A string: its case, with one component, load at the bit over the sinusoidal limit, weight [N]."""

    case: dict[str, Any]
    over_limit: float
    weight: float


def drawn(seed: int, index: int) -> Drawn:
    """The string of a seed and an index; the kinds of hole follow each other."""
    rng = Random(f"compressed strings:{seed}:{index}")
    outer, inner, least, largest = rng.choice(PIPES)
    inclination = rng.uniform(*INCLINATIONS[index % len(INCLINATIONS)])
    friction = 0.0 if rng.random() < FRICTIONLESS else round(rng.uniform(0.05, 0.3), 3)
    hole, load = rng.uniform(least, largest), rng.uniform(*LOAD)
    waves, segment = rng.uniform(*WAVES), rng.uniform(*SEGMENT)
    pipe = {"name": "pipe", "outer_diameter": outer * INCH, "inner_diameter": inner * INCH}
    mud = {"density": rng.choice((0.0, 1100.0, 1500.0))}
    case: dict[str, Any] = {
        "name": f"compressed {index}",
        "wellbore": {
            "stations": [[0.0, inclination, 0.0], [3000.0, inclination, 0.0]],
            "geometry": "arcs",
            "stiffness_per_length": 1e7,
            "intervals": [{"to_md": 3000.0, "diameter": hole * INCH, "friction": friction}],
        },
        "string": {"components": [pipe | {"segment_length": 10.0}]},
        "mud": mud,
        "rig": {"block_weight": BLOCK},
    }
    of = section_of(Case.model_validate(case).string.components[0], mud["density"])
    clearance = 0.5 * hole * INCH - of.contact_radius
    lying = 2 * np.sqrt(of.EI * of.weight * np.sin(np.radians(inclination)) / clearance)
    limit = max(float(lying), HANGING_SINUSOIDAL * float(np.cbrt(of.EI * of.weight**2)))
    half_wave = float(np.pi * np.sqrt(2 * of.EI / (load * limit)))
    length = round(waves * half_wave, 2)
    case["wellbore"]["stations"][1][0] = case["wellbore"]["intervals"][0]["to_md"] = length
    case["string"]["components"] = [pipe | {"segment_length": round(segment * half_wave, 2)}]
    case["bit"] = {"weight_on_bit": round(load * limit, 1)}
    return Drawn(case, load, of.weight * length)


def on_mesh(string: Drawn, mesh: str, buckling: str, load: float = 1.0) -> Case:
    """The case of a string as it is, with its segments ``halved`` or its component ``split``; load : share of its."""
    case = {name: dict(table) if isinstance(table, dict) else table for name, table in string.case.items()}
    (pipe,) = case["string"]["components"]
    length = case["wellbore"]["intervals"][0]["to_md"]
    if mesh == "halved":
        pipe = pipe | {"segment_length": pipe["segment_length"] / 2}
    parts = [pipe | {"length": round(SPLIT * length, 2)}, pipe] if mesh == "split" else [pipe]
    case["string"] = {"components": parts}
    case["bit"] = {"weight_on_bit": load * case["bit"]["weight_on_bit"]}
    case["solver"] = {"buckling": buckling}
    return Case.model_validate(case)


class Found(NamedTuple):
    """The steady string of a case, and its unstable modes; −1 for one without loads."""

    point: Equilibrium
    modes: int


class Watched(Solver):
    """A solver that keeps the poses of its answers."""

    def __init__(self, case: Case) -> None:
        super().__init__(case)
        self.kept: list[tuple[Shape, Problem, Pose, int]] = []

    def answer(self, problem: Problem, code: int, iterations: int, negative: int, method: str) -> Equilibrium:
        """The steady string of a problem in its pose, which is kept."""
        point = super().answer(problem, code, iterations, negative, method)
        self.kept.append((point._shape, problem, problem.copy_pose(), problem.at_axis))
        return point

    def modes(self, point: Equilibrium, rates: SteadyRates, laid: LaidString) -> int:
        """Negative pivots of the symmetric part of the tangent of an answer."""
        for shape, problem, pose, at_axis in self.kept:
            if shape is point._shape:
                problem.laid.put(problem.work.S)
                problem.put_pose(pose)
                problem.at_axis = at_axis
                return problem.unstable_modes()
        # The pose of a first attempt is left in the workspace.
        return self.problem(point.operation, rates, laid).unstable_modes()


def solved(case: Case) -> Found:
    """The steady string of a case, with its bit at the end of the hole."""
    solver, rates = Watched(case), steady_rates(case, OPERATION)
    laid = solver.lay_out(case.wellbore.intervals[-1].to_md)
    point = solver.solve_string(OPERATION, rates, laid)
    return Found(point, solver.modes(point, rates, laid) if point.answered else -1)
