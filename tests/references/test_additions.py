"""One class and one line of a registry add a contact method or an engine; what it does not name it refuses."""

import textwrap
from pathlib import Path

import pytest

import fctd
from references import contact, engines
from references.engines import Window
from tests.references.engines.turning import turning
from tests.references.listing import listed

METHOD = """
    from fctd.case.errors import Table
    from references.contact.own import ArcOptions, Arcs

    class Options(Table):
        pass

    class Toy(Arcs):
        name, distribution, does, Options = "toy", "numpy", "asks the engine", Options

        def __init__(self, case, options):
            super().__init__(case, ArcOptions())
    """
ENGINE = """
    from references.engines.own import Fctd

    class Toy(Fctd):
        name, distribution, does = "toy", "numpy", "moves it"
        honours = HONOURS
    """


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder whose modules can be imported."""
    monkeypatch.syspath_prepend(tmp_path)
    return tmp_path


@pytest.mark.slow  # it compiles what nothing else here needs
def test_a_contact_method_is_one_class_and_one_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (folder / "toy_method.py").write_text(textwrap.dedent(METHOD))
    monkeypatch.setitem(contact.METHODS, "toy", "toy_method:Toy")
    case = turning()
    own, toy = (fctd.simulate(case, contact=contact.build(name, case)) for name in ("arcs", "toy"))
    assert toy.status == "completed"
    assert toy.history.equals(own.history)
    assert "asks the engine" in listed()
    bare = turning(contact={"enabled": False})
    with pytest.raises(fctd.InputError, match=r"contact\.enabled = false: expected true, since .* leaves out"):
        fctd.simulate(bare, contact=contact.build("toy", bare))


def test_an_engine_is_one_class_and_one_line(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It refuses what it does not name: everything, as long as it names nothing."""
    for module, honours in (("timid_engine", "()"), ("toy_engine", '("wall", "incline")')):
        (folder / f"{module}.py").write_text(textwrap.dedent(ENGINE).replace("HONOURS", honours))
    window, case = Window(5.0, 1.0), turning()
    monkeypatch.setitem(engines.ENGINES, "toy", "timid_engine:Toy")
    with pytest.raises(fctd.InputError, match=r"contact\.enabled = true: expected false, since engine toy leaves out"):
        engines.build("toy").run(case, window)
    monkeypatch.setitem(engines.ENGINES, "toy", "toy_engine:Toy")
    assert "moves it" in listed()
    own, toy = (engines.build(name).run(case, window) for name in ("fctd", "toy"))
    assert toy.status == "valid"
    assert toy.history.equals(own.history)
    damped = turning(solver={"loss_factor": 0.1})
    with pytest.raises(fctd.InputError, match=r"solver\.loss_factor = 0\.1: expected 0, since engine toy leaves out"):
        engines.build("toy").run(damped, window)
