"""Chunks of the tube mesh: together the tube, each near its origin and with all faces that its points may need."""

import numpy as np
import pytest

from references.contact.chunks import BEYOND, CHUNK, Chunks
from references.contact.tube_mesh import Tube, TubeOptions, build_tube
from tests.references.wells import HOLE, bent_case


@pytest.fixture(scope="module")
def tube() -> Tube:
    return build_tube(bent_case(), TubeOptions(facets=24, ring_spacing=3.0))


def test_chunks_together_are_the_tube(tube: Tube) -> None:
    chunks = Chunks(tube, whole=False)
    assert len(chunks.parts) == len(chunks.origins) == np.ceil((tube.md[-1] - tube.md[0]) / CHUNK)
    corners = np.asarray(tube.mesh.triangles)
    for number, part in enumerate(chunks.parts):
        faces = slice(part.first_face, part.first_face + len(part.faces))
        local = part.vertices[part.faces] + chunks.origins[number]
        np.testing.assert_allclose(local, corners[faces], atol=np.spacing(np.float32(0.6 * CHUNK)))
        # The chunk's own stretches, and the hole beyond them on both sides.
        own = tube.md[np.append(chunks.of == number, False) | np.append(False, chunks.of == number)]
        rings = tube.md[part.first_face // 48], tube.md[faces.stop // 48]
        assert rings[0] <= max(own[0] - BEYOND, tube.md[0])
        assert rings[1] >= min(own[-1] + BEYOND, tube.md[-1])
        assert np.abs(part.vertices).max() < 0.5 * CHUNK + BEYOND + 2 * 3.0 + HOLE


def test_rounding_is_that_of_the_farthest_vertex(tube: Tube) -> None:
    """Half a unit in the last place in each of nine coordinates: 2^-18 m below 64 m, 2^-15 m below 256 m."""
    assert Chunks(tube, whole=False).rounding == pytest.approx(1.5 * 3**0.5 * 2.0**-18)
    whole = Chunks(tube, whole=True)
    assert (len(whole.parts), whole.rounding) == (1, pytest.approx(1.5 * 3**0.5 * 2.0**-16))
    assert (whole.origins == 0).all()


def test_rings_farther_apart_than_a_chunk_is_long() -> None:
    """Each stretch is a chunk of its own; none is empty."""
    straight = bent_case(stations=[[0, 0, 0], [600, 0, 0]], intervals=[{"to_md": 600, "diameter": 0.2, "friction": 0}])
    tube = build_tube(straight, TubeOptions(facets=6, ring_spacing=300.0))
    chunks = Chunks(tube, whole=False)
    assert [len(part.faces) > 0 for part in chunks.parts] == [True] * len(chunks.parts)
    assert (np.diff(chunks.of) >= 0).all()
    assert chunks.of[-1] == len(chunks.parts) - 1
