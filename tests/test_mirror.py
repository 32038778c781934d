"""Tests mirror the rooms: each module has a namesake, and each test file of a room names a module of it."""

from pathlib import Path

TESTS = Path(__file__).parent
ENGINE = TESTS.parent / "fctd"
ROOMS = [path.name for path in sorted(ENGINE.iterdir()) if (path / "__init__.py").is_file()]

# Test files of a room that belong to no one module, and why.
OF_THE_ROOM = {
    "cli/test_golden.py": "the screens and refusals of every command",
    "cli/test_wrong_inputs.py": "the commands refuse or doubt them, whichever module finds them",
    "cli/test_text.py": "every command prints texts from outside as they stand",
    "cli/test_second_hour.py": "inputs of all commands, whichever module answers them",
    "mechanics/test_mechanics.py": "the stepper against closed forms of beams, shafts and waves",
}


def modules(room: str) -> set[str]:
    """Names of a room's modules and packages."""
    return {path.stem for path in (ENGINE / room).iterdir()} - {"__init__", "__pycache__"}


def test_every_module_has_a_namesake() -> None:
    assert {"case", "cli", "mechanics", "model", "results", "simulation", "steady"} <= set(ROOMS)
    expected = {f"{room}/test_{module}.py" for room in ROOMS for module in modules(room)}
    assert {name for name in expected if not (TESTS / name).is_file()} == set()


def test_every_test_file_of_a_room_names_a_module() -> None:
    """Long ones are split by subject: test_MODULE_SUBJECT.py."""
    strays = set()
    for room in ROOMS:
        for path in (TESTS / room).glob("test_*.py"):
            words = path.stem.split("_")[1:]
            if not modules(room) & {"_".join(words[:k]) for k in range(1, len(words) + 1)}:
                strays.add(f"{room}/{path.name}")
    assert strays == set(OF_THE_ROOM)
