"""Five broken methods from elsewhere: the contract names each fault in words that lead to the mend."""

from collections.abc import Callable
from typing import Annotated, Any, ClassVar

import numpy as np
import pytest
from pydantic import Field

from fctd.arena.contract import DEMANDS, Finding, examine
from fctd.arena.exact_hole import ExactHole
from fctd.arrays import Array, Contacts
from fctd.case.errors import InputError, Table
from fctd.case.load import Case


class Options(Table):
    """facets : as others have, which means nothing here."""

    facets: Annotated[float, Field(examples=[3.0, 6.0])] = 3.0


class Exact:
    """The exact contacts, and what a subclass makes of them."""

    name = "foreign"
    distribution: ClassVar[str] = "numpy"
    does: ClassVar[str] = "the exact contacts"
    gives_clearance = True
    Options: ClassVar[type[Table]] = Options
    pieces = 1

    def __init__(self, case: Case, options: Any) -> None:
        self.hole = ExactHole(case.wellbore)

    def query(self, points: Array, radii: Array) -> Any:
        return self.spoil(self.hole.contacts(points, radii))

    def spoil(self, hits: Contacts) -> Any:
        """What it returns of the exact contacts."""
        return hits

    def error_bound(self, curvature: float) -> tuple[float, float]:
        return 0.0, 0.0


def spoiled(how: Callable[[Contacts], Any], **facts: Any) -> type[Exact]:
    """A method that spoils its contacts."""
    return type("Spoiled", (Exact,), {"spoil": staticmethod(how), **facts})


def broken(method: type[Exact]) -> dict[str, str]:
    """What is wrong with a method by demand."""
    return {found.demand: found.says for found in examine(method) if not found.kept}


def turned(hits: Contacts, by: float) -> Contacts:
    """Normals that lean along x."""
    normal = hits.normal + np.array([np.tan(np.radians(by)), 0, 0])
    return hits._replace(normal=normal / np.linalg.norm(normal, axis=1)[:, None])


def test_the_exact_hole_keeps_all_of_it() -> None:
    found = list(examine(Exact))
    assert [(each.demand, each.says) for each in found if not each.kept] == []
    assert len(found) == len(DEMANDS)


@pytest.mark.parametrize(
    ("how", "says"),
    [
        (lambda hits: hits._replace(penetration=np.where(hits.penetration > 0, hits.penetration, np.nan)),
         "is not a number: a point without contact has −inf"),
        (lambda hits: hits._replace(normal=-hits.normal), "point into the hole: expected from the axis to the wall"),
        (lambda hits: hits._replace(normal=2 * hits.normal), "divide them by their lengths"),
        (lambda hits: hits._replace(penetration=1e3 * hits.penetration), "they seem to be in millimetres"),
        (lambda hits: hits._replace(penetration=-hits.penetration), "turn the sign"),
        (lambda hits: turned(hits, 3.0), "the normal in the straight hole is off by"),
        (lambda hits: hits._replace(md=hits.md + 1.0), "md in the straight hole is off by up to 1 m"),
        (lambda hits: hits.penetration, "query returns"),
        (lambda hits: hits._replace(md=hits.md[:-1]), "query returns the shapes"),
        (lambda hits: hits._replace(penetration=hits.penetration - 2e-3), "missed contact, up to"),
        (lambda hits: hits._replace(penetration=hits.penetration + 2e-3), "false contact, up to"),
    ],
)  # fmt: skip
def test_a_fault_is_named_with_its_mend(how: Callable[[Contacts], Any], says: str) -> None:
    found = broken(spoiled(how))
    assert any(says in each for each in found.values()), found


def test_clearance_is_what_the_method_says() -> None:
    found = broken(type("Silent", (Exact,), {"gives_clearance": False}))
    assert list(found.values()) == [
        "gives_clearance is false, but a clear point has a finite penetration: return −inf there"
    ]


def test_a_memory_of_the_last_answer_is_found() -> None:
    class Lazy(Exact):
        """Answers points that it was asked before as then."""

        def query(self, points: Array, radii: Array) -> Any:
            if len(getattr(self, "last", ())) != len(points):
                self.last = super().query(points, radii).penetration
            return super().query(points, radii)._replace(penetration=self.last)

    assert "the answer to a point is another one" in " ".join(broken(Lazy).values())


def test_what_is_written_to_the_points_is_found() -> None:
    class Careless(Exact):
        """Moves the points that it is given."""

        def query(self, points: Array, radii: Array) -> Any:
            hits = super().query(points, radii)
            points += 1e-3
            return hits

    assert "changes the points or radii" in " ".join(broken(Careless).values())


def test_a_search_from_the_top_is_a_remark() -> None:
    class Slow(Exact):
        """Looks at each metre of the hole for each point."""

        def query(self, points: Array, radii: Array) -> Any:
            axis = self.hole.at(np.arange(0.0, self.hole.md[1], 0.25))[0]
            for point in points:
                np.linalg.norm(axis - point, axis=1).argmin()
            return super().query(points, radii)

    remarks = [found for found in examine(Slow) if found.says]
    assert [found.remark for found in remarks] == [True]
    assert "keep the place of each point, or search a tree" in remarks[0].says


def test_a_setting_that_its_own_examples_refuse() -> None:
    class Picky(Exact):
        """Refuses one of its own examples."""

        def __init__(self, case: Case, options: Any) -> None:
            if options.facets > 5:
                raise InputError("at most 5", key="facets", value=options.facets)
            super().__init__(case, options)

    assert list(broken(Picky).values()) == [
        "its own setting {'facets': 6.0} is refused: facets = 6.0: expected at most 5"
    ]


def test_whatever_a_method_raises_is_a_finding_of_every_demand() -> None:
    def fail(_: Contacts) -> None:
        raise ZeroDivisionError("of mine")

    found = list(examine(spoiled(fail)))
    assert {each.says for each in found if "raises" in each.says} == {"it raises ZeroDivisionError: of mine"}
    assert sum(not each.kept for each in found) >= len(DEMANDS) - 1


def test_a_package_that_is_missing_is_no_finding() -> None:
    class Missing(Exact):
        """Of a package that is not installed."""

        def __init__(self, case: Case, options: Any) -> None:
            raise InputError("package embreex, which is not installed", key="contact", value="foreign")

    with pytest.raises(InputError, match="not installed"):
        next(examine(Missing))


def test_a_hole_of_nine_kilometres_may_be_refused_in_words() -> None:
    class Short(Exact):
        """Takes holes of a kilometre."""

        def __init__(self, case: Case, options: Any) -> None:
            if (deepest := case.wellbore.intervals[-1].to_md) > 1000:
                raise InputError("at most 1000 m", key="wellbore", value=deepest)
            super().__init__(case, options)

    told = [found for found in examine(Short) if found.says]
    assert all(found.kept for found in told)
    assert "it refuses a hole of nine kilometres: wellbore = 9000.0: expected at most 1000 m" in told[0].says


def test_a_remark_keeps_the_contract() -> None:
    assert Finding("search", "slow", remark=True).kept
    assert not Finding("search", "wrong").kept
