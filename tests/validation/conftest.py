"""A registry of toy studies, whose results go to a temporary folder."""

import io
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

import pandas as pd
import pytest
from rich.console import Console

from validation.harness import registry, runner, study
from validation.harness.fingerprint import Sources
from validation.harness.study import Check, Context, Outcome, Study

Register = Callable[..., None]


def outcome(value: float = 0.5) -> Outcome:
    """One table and one check, "error at most 1"."""
    table = pd.DataFrame({"depth_m": [0.0, 10.0], "force_N": [1.0, 2.0]})
    return Outcome(
        tables={"forces": table},
        checks=[Check("error", value, 1.0, "at_most", "mm", "closed form")],
        notes=["a toy"],
        display={"forces": "Forces by depth"},
    )


@pytest.fixture
def empty_registry() -> Iterator[None]:
    """An empty registry during the test; afterwards the studies are registered in their old order."""
    kept = dict(registry.STUDIES)
    registry.STUDIES.clear()
    yield
    registry.STUDIES.clear()
    registry.STUDIES.update(kept)


@pytest.fixture
def register(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, empty_registry: None) -> Register:
    """Put studies into an otherwise empty registry: ``register(name, run, needs=...)``."""
    monkeypatch.setattr(study, "RESULTS", tmp_path / "results")

    def add(
        name: str,
        run: Callable[[Context], Outcome] = lambda context: outcome(),
        *,
        reproduce: bool = True,
        needs: tuple[str, ...] = (),
        timed: bool = False,
    ) -> None:
        module = ModuleType(f"toy_{name}")
        module.STUDY = Study(name, f"Is {name} right?", run, reproduce, needs, timed)
        monkeypatch.setitem(sys.modules, module.__name__, module)
        registry.STUDIES[name] = module.__name__

    return add


@pytest.fixture(scope="session")
def sources() -> Sources:
    """The sources as they stand, read once: no test edits them."""
    return Sources()


@pytest.fixture
def run(tmp_path: Path, sources: Sources) -> Callable[..., tuple[int, str]]:
    """Run studies by name into ``tmp_path / "results"``; gives the exit code and what was printed."""

    def call(
        *names: str,
        expected: runner.Expected | None = None,
        data: Path | None = None,
        quick: bool = False,
        processes: int = 1,
    ) -> tuple[int, str]:
        text = io.StringIO()
        code = runner.run_all(
            names,
            quick=quick,
            processes=processes,
            data=data,
            expected=expected or {},
            results=tmp_path / "results",
            sources=sources,
            console=Console(file=text),
        )
        return code, text.getvalue()

    return call
