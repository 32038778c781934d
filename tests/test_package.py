"""The package as it is installed: compile cache, imports, versions."""

import importlib
import os
import pkgutil
import shutil
import subprocess
import sys
import tomllib
from importlib.resources import files
from pathlib import Path
from types import ModuleType

import pytest

import fctd

SOURCE = Path(fctd.__file__).parent


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """A folder with a copy of the compiled code alone, which is imported faster than the whole package."""
    root = tmp_path / "copy"
    shutil.copytree(SOURCE / "mechanics", root / "fctd" / "mechanics", ignore=shutil.ignore_patterns("__pycache__"))
    (root / "fctd" / "__init__.py").touch()
    return root


PLACE = """
import numba
from fctd.mechanics import dynamics
from fctd.mechanics.fingerprint import fingerprint
print(dynamics.advance.stats.cache_path)
print(fingerprint(dynamics.advance.py_func))
print(numba.config.CACHE_DIR)
"""


def place_of_code(root: Path, **environment: str) -> list[str]:
    """Where the package in ``root`` keeps compiled code, numba having been imported first: folder, key, and the folder
    of functions that numba stores."""
    clean = {key: value for key, value in os.environ.items() if key != "NUMBA_CACHE_DIR"}
    done = subprocess.run(
        [sys.executable, "-c", PLACE],
        cwd=root, env={**clean, "PYTHONPATH": str(root), **environment}, capture_output=True, text=True, check=True,
    )  # fmt: skip
    return done.stdout.splitlines()


@pytest.mark.slow
def test_compiled_code_follows_the_sources(copy: Path, tmp_path: Path) -> None:
    """numba does not see an edit in a function that a cached one calls; the key does, and so does numba's folder."""
    folder, key, others = place_of_code(copy)
    assert place_of_code(copy) == [folder, key, others]
    with (copy / "fctd" / "mechanics" / "joints.py").open("a") as file:
        file.write("\n# edited\n")
    edited = place_of_code(copy)
    assert edited[0] == folder
    assert edited[1] != key
    assert edited[2] != others
    assert Path(place_of_code(copy, NUMBA_CACHE_DIR=str(tmp_path / "mine"))[0]) == tmp_path / "mine"


WITHOUT_A_FOLDER = """
import os
from fctd.mechanics.compile_cache import STORE
STORE.read("function")
print(os.path.isdir(os.environ["NUMBA_CACHE_DIR"]))
"""


@pytest.mark.parametrize(
    "name", [*(pytest.param(name, marks=pytest.mark.slow) for name in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")), "HOME"]
)
def test_without_a_cache_folder_code_is_kept_for_one_run(name: str, copy: Path, tmp_path: Path) -> None:
    """As in a container whose user has no home."""
    here = tmp_path / "here"
    here.mkdir()
    (here / "file").write_text("no folder")
    clean = {k: v for k, v in os.environ.items() if k not in ("NUMBA_CACHE_DIR", "XDG_CACHE_HOME")}
    done = subprocess.run(
        [sys.executable, "-c", WITHOUT_A_FOLDER],
        env={**clean, "PYTHONPATH": str(copy), "TMPDIR": str(here), name: str(here / "file" / "cache")},
        cwd=copy, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "True"
    named = "XDG_CACHE_HOME" if name == "HOME" else name
    assert f"set {named} to a folder of your own" in done.stderr
    assert [path.name for path in here.iterdir()] == ["file"]


@pytest.mark.slow
def test_the_engine_needs_none_of_the_suite() -> None:
    """Importing the engine loads nothing of the other packages or of what only they need."""
    others = {
        "references", "validation", "reports", "benchmarks", "matplotlib", "plotly", "xlsxwriter", "jinja2",
        "reportlab", "pybullet", "fcl", "coal", "mujoco", "rtree", "trimesh", "skfem", "pytest",
    }  # fmt: skip
    program = f"import sys; from fctd import *; print(sorted({others} & sys.modules.keys()))"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_importing_it_changes_nothing_in_the_program_that_does() -> None:
    """Neither signals nor the garbage collector; a case is read without compiled code, and without the commands."""
    program = """
import gc, signal, sys
handlers = lambda: [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)]
before = handlers()
import fctd
fctd.load_case
assert handlers() == before and gc.isenabled()
print(sorted(name for name in sys.modules if name == "numba" or name.startswith(("fctd.cli", "fctd.steady"))))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_no_name_hides_a_module() -> None:
    """A package that offers a function under a module's name would hide the module from ``import package.name``."""
    for found in pkgutil.walk_packages(fctd.__path__, "fctd."):
        if found.name != "fctd.__main__":
            module = importlib.import_module(found.name)
            parent, _, name = found.name.rpartition(".")
            assert getattr(sys.modules[parent], name) is module, found.name


def test_packages_list_their_public_names() -> None:
    """Completion of ``fctd.`` and of what it holds, before anything is imported."""
    program = "import fctd; print(dir(fctd), dir(fctd.plots), dir(fctd.view), sep='; ')"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    listed = [sorted([*fctd.__all__, "plots", "view"]), sorted(fctd.plots.__all__), sorted(fctd.view.__all__)]
    assert done.stdout.strip() == "; ".join(map(str, listed))


@pytest.mark.parametrize("package", [fctd, fctd.plots, fctd.view])
def test_every_public_name_is_found_and_no_other(package: ModuleType) -> None:
    assert len(package.__all__) >= 8
    assert all(getattr(package, name).__class__ is not ModuleType for name in package.__all__)
    with pytest.raises(AttributeError, match=f"module '{package.__name__}' has no attribute 'nothing'"):
        _ = package.nothing


def test_no_public_function_has_the_name_of_a_room() -> None:
    """It would hide the room from whoever imports the package."""
    rooms = {path.parent.name for path in SOURCE.glob("*/__init__.py")}
    assert rooms & set(fctd.__all__) == set()


def test_type_checkers_read_the_annotations() -> None:
    assert "py.typed" in {path.name for path in files("fctd").iterdir()}
    built = tomllib.loads((SOURCE.parent / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["setuptools"]
    assert "py.typed" in built["package-data"]["fctd"]
