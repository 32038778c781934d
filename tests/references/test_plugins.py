"""Plugins: a folder with ``dist-info`` on the path brings methods and an engine; without it nothing is left of them."""

import os
import subprocess
import sys
import textwrap
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow(10)  # each command starts an interpreter of its own

ROOT = Path(__file__).parents[2]
METHOD = """
    from fctd.case.errors import Table
    from references.contact.own import ArcOptions, Arcs

    class Options(Table):
        pass

    class Toy(Arcs):
        name, distribution, does, Options = "toy", "toy-contact", "asks the arcs", Options

        def __init__(self, case, options):
            super().__init__(case, ArcOptions())
    """
ENGINE = """
    from references.engines.own import Fctd

    class Toy(Fctd):
        name, distribution, does = "toy_engine", "toy-contact", "moves as FCTD"
    """
POINTS = """
    [fctd_references.contact_methods]
    toy = toy_contact.method:Toy
    arcs = toy_contact.method:Toy
    broken = toy_contact.missing:Toy
    bare = toy_contact.method:Options

    [fctd_references.engines]
    toy_engine = toy_contact.engine:Toy
    """


@pytest.fixture
def plugin(tmp_path: Path) -> Path:
    """A folder as an installer leaves it, of a distribution with two methods, a broken one and an engine."""
    about, package = tmp_path / "toy_contact-1.2.dist-info", tmp_path / "toy_contact"
    for folder in (about, package):
        folder.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: toy-contact\nVersion: 1.2\n")
    (about / "entry_points.txt").write_text(textwrap.dedent(POINTS))
    for name, text in (("__init__", ""), ("method", METHOD), ("engine", ENGINE)):
        (package / f"{name}.py").write_text(textwrap.dedent(text))
    return tmp_path


def python(*arguments: str, path: Path | None = None) -> str:
    """What Python prints, with a folder on its path."""
    extra = [str(path)] if path else []
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(ROOT), *extra]), "COLUMNS": "200"}
    done = subprocess.run([sys.executable, *arguments], cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_a_plugin_is_listed_built_and_run_and_leaves_nothing_behind(plugin: Path) -> None:
    listed = " ".join(python("-m", "references", "list", path=plugin).split())
    for expected in ("asks the arcs", "moves as FCTD", "toy-contact", "1.2", "ModuleNotFoundError"):
        assert expected in listed
    assert "arcs = toy_contact.method:Toy is left out: the name arcs is taken" in listed
    assert "closest point on circular arcs" in listed  # the built-in one
    program = """
        import fctd
        from references import contact, engines
        short = {"operations[0].duration": "4 s", "operations[0].ramp_time": "1 s"}
        case = fctd.load_case("validation/cases/curved_chain.toml", short)
        toy, own = (contact.build(name, case) for name in ("toy", "arcs"))
        places = own.hole.off_axis(own.hole.md, 0 * own.hole.md, 0 * own.hole.md + 0.12)
        assert (toy.query(places, 0 * own.hole.md + 0.05)[0] == own.query(places, 0 * own.hole.md + 0.05)[0]).all()
        print(engines.build("toy_engine").run(case, engines.Window(2.0, 0.3)).status)
        for name in ("broken", "bare", "toyy"):
            try:
                contact.build(name, case)
            except fctd.InputError as error:
                print(error)
        """
    printed = python("-c", textwrap.dedent(program), path=plugin)
    assert "toy-contact 1.2, broken = toy_contact.missing:Toy raises ModuleNotFoundError" in printed
    assert 'contact = "bare": expected a class with distribution, does, Options' in printed
    assert "toy" in printed.splitlines()[-1]
    assert "toy" not in python("-m", "references", "list")


def test_code_and_version_of_a_plugin_are_inputs_of_a_study_of_rivals(plugin: Path) -> None:
    program = "from validation.harness import fingerprint; print(fingerprint.rivals())"
    first = python("-c", program, path=plugin)
    assert "'plugin contact method toy': 'toy-contact 1.2, toy = toy_contact.method:Toy" in first
    (plugin / "toy_contact" / "method.py").write_text(textwrap.dedent(METHOD) + "# changed\n")
    assert python("-c", program, path=plugin) != first
    assert "toy" not in python("-c", program)
