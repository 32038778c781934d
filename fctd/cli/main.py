"""The command line, also ``python -m fctd``: the application and how a command ends."""

import sys
from contextlib import suppress
from functools import cache
from importlib import import_module
from typing import Any

import typer
from typer.core import TyperGroup
from typer.main import get_command_from_info
from typer.models import CommandInfo

from fctd.case.errors import InputError
from fctd.case.text import degrade_output
from fctd.cli.announcing import announcing
from fctd.cli.base_command import HELP, Command, application
from fctd.cli.interrupts import as_interrupts
from fctd.cli.option_names import naming_options
from fctd.cli.options import (
    BAD_INPUT,
    INTERRUPTED,
    messages,
)

# Arguments of ``fctd.calibrate`` and ``fctd.predict``, and their options.
CALIBRATION = {name: f"--{name}" for name in ("fit", "prior", "starts", "seed", "samples")}


def _options(*arguments: str) -> dict[str, str]:
    """Arguments of a function of the library, and the options of their names."""
    return {argument: f"--{argument.replace('_', '-')}" for argument in arguments}


# The commands in the groups of the help, each in the module of its name, and options of which messages of the library
# name the argument.
GROUPS: dict[str, dict[str, dict[str, str]]] = {
    "Begin": {"init": {}, "check": {}, "pipes": {}, "schema": {}},
    "Steady strings": {
        "chart": {"bit_depth": "--depths"},
        "compare": {"bit_depth": "--depths"},
        "equilibrium": {},
        "limits": {"bit_depths": "--depths", "stuck_at": "--stuck-at", "flow": "--flow"},
        "refine": {"bit_depth": "--bit-depth"},
    },
    "Stuck pipe and worn casing": {
        "freepoint": {"bit_depth": "--bit-depth"}
        | _options("pull", "stretch", "torque", "turns", "first_hookload", "first_torque"),
        "jar": {"bit_depth": "--bit-depth"} | _options("jar", "stuck_at", "up", "down", "hookload"),
        "wear": {"bit_depths": "--depths", "duration": "--hours"}
        | _options("penetration", "rpm", "wear_factor", "operation", "step"),
    },
    "Mud": {
        "hydraulics": {"bit_depths": "--depths", "flow": "--flow", "eccentricity": "--eccentricity"},
        "surge": {
            "bit_depths": "--depths",
            "speeds": "--speed",
            "end": "--end",
            "eccentricity": "--eccentricity",
        },
    },
    "Strings in time": {"simulate": {}, "status": {}},
    "Measured wells": {
        "calibrate": CALIBRATION,
        "predict": CALIBRATION,
        "monitor": {"step": "--step", "readings": "--false-alarm-in", "fit": "--fit"},
    },
    "Many samples": {"sweep": {}, "uncertainty": {"bit_depth": "--bit-depth"}},
    "Look": {
        "report": {"bit_depths": "--depths"},
        "view": {"bit_depth": "--depths", "exaggeration": "--sideways"},
        "app": {},
    },
    "Upkeep": {"compile": {}},
}
COMMANDS = {name: options for commands in GROUPS.values() for name, options in commands.items()}


class Commands(TyperGroup):
    """The group of all commands; it imports the one that is asked for, since a chart needs no calibration."""

    def __init__(self, **settings: Any) -> None:
        super().__init__(**settings)
        names: Any = dict.fromkeys(COMMANDS)
        self.commands = names  # the message of an unknown command compares them

    def list_commands(self, ctx: Any) -> list[str]:
        """Names in the order of the help."""
        return list(COMMANDS)

    def get_command(self, ctx: Any, cmd_name: str) -> Any:
        """A command by its name, or None."""
        return _command(cmd_name) if cmd_name in COMMANDS else None


@cache
def _command(name: str) -> Any:
    function = getattr(import_module(f"fctd.cli.{name}"), f"{name}_command")
    group = next(group for group, commands in GROUPS.items() if name in commands)
    info = CommandInfo(
        name, cls=Command, callback=naming_options(function, COMMANDS[name]), rich_help_panel=group
    )  # fmt: skip
    return get_command_from_info(info, pretty_exceptions_short=False, rich_markup_mode="rich")


app = typer.Typer(
    cls=Commands, no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, context_settings=HELP,
)  # fmt: skip

app.callback()(application)


def main() -> None:
    """Entry point."""
    run(app)


def run(commands: typer.Typer) -> None:
    """Run a command line; bad input, or a file that cannot be written, gives one line and no traceback."""
    degrade_output()
    try:
        with as_interrupts(), announcing():
            commands()
    except (InputError, OSError) as error:  # OSError: a full disk, a closed terminal
        with suppress(OSError):
            messages.print(_told(error), style="bold", soft_wrap=True)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)


def _told(error: InputError | OSError) -> str:
    """The error as a line; the system does not say that it is the current folder which it cannot find."""
    if isinstance(error, FileNotFoundError) and error.filename is None:
        return "the current folder is no longer there: go to another one, and begin again"
    return str(error)
