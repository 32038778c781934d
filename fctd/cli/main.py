"""The command line, also ``python -m fctd``: the application and how a command ends."""

import sys
from contextlib import suppress

import typer

from fctd.case.errors import InputError
from fctd.case.text import degrade_output
from fctd.cli.calibrate import calibrate_command
from fctd.cli.chart import chart_command
from fctd.cli.check import check_command
from fctd.cli.compile import announcing, compile_command
from fctd.cli.equilibrium import equilibrium_command
from fctd.cli.init import init_command
from fctd.cli.interrupts import as_interrupts
from fctd.cli.manners import HELP, Command, application
from fctd.cli.monitor import monitor_command
from fctd.cli.options import (
    BAD_INPUT,
    INTERRUPTED,
    messages,
)
from fctd.cli.predict import predict_command
from fctd.cli.refine import refine_command
from fctd.cli.refusals import naming_options
from fctd.cli.schema import schema_command
from fctd.cli.simulate import simulate_command

# Arguments of ``fctd.calibrate`` and ``fctd.predict``, and their options.
CALIBRATION = {name: f"--{name}" for name in ("fit", "prior", "starts", "seed", "samples")}

app = typer.Typer(
    no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False, context_settings=HELP,
)  # fmt: skip

app.callback()(application)

app.command("init", cls=Command)(init_command)
app.command("check", cls=Command)(naming_options(check_command))
app.command("schema", cls=Command)(schema_command)
app.command("simulate", cls=Command)(naming_options(simulate_command))
app.command("equilibrium", cls=Command)(naming_options(equilibrium_command))
app.command("chart", cls=Command)(naming_options(chart_command, {"bit_depth": "--depths"}))
app.command("refine", cls=Command)(naming_options(refine_command, {"bit_depth": "--bit-depth"}))
app.command("calibrate", cls=Command)(naming_options(calibrate_command, CALIBRATION))
app.command("predict", cls=Command)(naming_options(predict_command, CALIBRATION))
app.command("monitor", cls=Command)(
    naming_options(monitor_command, {"step": "--step", "readings": "--false-alarm-in", "fit": "--fit"})
)
app.command("compile", cls=Command)(compile_command)


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
            messages.print(str(error), style="bold", soft_wrap=True)
        sys.exit(BAD_INPUT)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
