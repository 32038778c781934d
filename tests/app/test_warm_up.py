"""What is warm before the first request."""

import importlib
import pkgutil
import subprocess
import sys

import pytest

import fctd.steady
from fctd.app.warm_up import SMALL, warm_up
from fctd.case.load import Case


def test_it_runs() -> None:
    warm_up()
    assert Case.model_validate(SMALL).name == "warm-up"


ENTRIES = """
import importlib, sys
from fctd.app.warm_up import warm_up
from fctd.mechanics.compile_cache import KeptCode
warm_up()
# Compiled together with what calls them, and from Python called only where that fails, or in a run.
inside = {"eliminate", "add_pseudo_mass", "take_step", "find_shares", "find_stiffness"}
for name in sys.argv[1:]:
    for key, value in vars(importlib.import_module(name)).items():
        if key not in inside and isinstance(getattr(value, "_cache", None), KeptCode) and not value.signatures:
            print(name, key)
"""


@pytest.mark.slow
def test_every_function_of_a_steady_string_is_compiled_before_its_limits() -> None:
    rooms = [f"fctd.steady.{module.name}" for module in pkgutil.iter_modules(fctd.steady.__path__)]
    for room in rooms:
        importlib.import_module(room)
    command = [sys.executable, "-c", ENTRIES, *rooms, "fctd.model.string_rows", "fctd.results.buckling"]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == ""
