"""Runs that are kept, and gone on with: what the tests of checkpoints share."""

from typing import Any

import pandas as pd

from fctd.case.load import Case
from fctd.results.tables import TABLES, SimulationResult
from fctd.simulation.chunks import Cursor, add_chunk, chunk_since, read_chunk
from fctd.simulation.simulate import Simulation
from fctd.store.facts import Facts, pack, unpack
from tests.cases import make_case, pipe, rotation, trip

BUILD = [[0, 0, 0], [150, 0, 0], [450, 60, 0], [1000, 60, 0]]
STRING = [pipe(60, None, outer=0.16, segment_length=20.0), pipe(None, None, segment_length=28.5)]
DRILLED = {"kind": "drill_rotating", "from_md": 900.0, "to_md": 900.3, "speed": 0.01, "rpm": 120, "ramp_time": 5.0}


def tripping(geometry: str = "arcs") -> Case:
    """In and out with connections, and a rotation between; mud moves along, two profiles are wanted."""
    moves = [trip(300, 360, speed=2.0, ramp=2), rotation(360, 3, ramp=1), trip(360, 330, speed=2.0, ramp=2)]
    return make_case(
        BUILD, STRING, moves, mud={"density": 1200.0}, rig={"feed": "stands", "connection_time": 3.0},
        wellbore={"geometry": geometry}, record={"profile_at": [320.0, 340.0]},
    )  # fmt: skip


def drilling(geometry: str = "arcs") -> Case:
    """An autodriller and a drive with inertia, on rock whose torque falls with the rotation."""
    return make_case(
        None, [pipe(100, 4, outer=0.165), pipe(None, 1)], [DRILLED],
        mud={"density": 1200.0, "axial_damping": 2.0, "rotational_damping": 0.3}, wellbore={"geometry": geometry},
        bit={"weight_on_bit": 4e4, "torque": 1500.0, "rock": {"weakening": 0.5}},
        rig={"drive": "impedance", "autodriller": True},
    )  # fmt: skip


def drilling_on(geometry: str = "arcs") -> Case:
    """An autodriller over a connection: its stroke takes longer than planned before it, and less time after it."""
    connection = 31 * 28.5
    return make_case(
        [[0, 0, 0], [300, 0, 0], [600, 45, 0], [1000, 45, 0]], STRING,
        [DRILLED | {"from_md": connection - 1.0, "to_md": connection + 0.6}],
        mud={"density": 1200.0, "axial_damping": 2.0, "rotational_damping": 0.3}, wellbore={"geometry": geometry},
        bit={"weight_on_bit": 4e4, "rock": {"specific_energy": "25 MPa", "wear_flat": 0}},
        rig={"autodriller": True, "feed": "stands", "connection_time": 5.0},
    )  # fmt: skip


def stopped(simulation: Simulation, after: int, chunk: int = 7) -> tuple[Facts, list[dict[str, bytes]]]:
    """The facts of a run after so many records more, as they would be read back, and its chunks of so many records."""
    cursor, chunks = Cursor.at_end(simulation.recorder) if simulation.started else Cursor(), []
    for k, _ in enumerate(simulation, start=1):
        if k % chunk == 0 or k == after:
            chunks.append(chunk_since(simulation.recorder, cursor))
            cursor = Cursor.at_end(simulation.recorder)
        if k == after:
            break
    return unpack(pack(simulation.facts())), chunks


def gone_on(case: Case, facts: Facts, chunks: list[dict[str, bytes]], contact: Any = None) -> Simulation:
    """A new run in the state of a checkpoint."""
    simulation = Simulation(case, contact)
    simulation.restore(facts)
    for chunk in chunks:
        add_chunk(simulation.recorder, read_chunk(chunk))
    return simulation


def same(found: SimulationResult, wanted: SimulationResult) -> None:
    """Assert that two results have bitwise the same tables, the same notes, status and counts."""
    for name in TABLES:
        pd.testing.assert_frame_equal(getattr(found, name), getattr(wanted, name), check_exact=True)
    assert (found.status, found.message) == (wanted.status, wanted.message)
    assert found.notes == wanted.notes
    times = {"wall_s", "real_time_factor", "guards_s", "checkpoints_s", "checkpoints_wall_s"}
    assert {k: v for k, v in found.run.items() if k not in times} == {
        k: v for k, v in wanted.run.items() if k not in times
    }
