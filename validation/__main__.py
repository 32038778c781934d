"""``python -m validation``: list the studies, or run some of them."""

from typing import Annotated

import typer
from grimp.exceptions import SourceSyntaxError
from rich.console import Console

from fctd.case.errors import InputError
from fctd.case.solver import PERTURBED
from fctd.case.text import degrade_output, printable_lines
from fctd.cli.interrupts import as_interrupts
from validation.claims import judgement, ledger
from validation.harness import fingerprint, runner, sensitivity, side_by_side, study, targets, variation
from validation.harness.registry import RIVALS, STUDIES
from validation.harness.variation import Variation

# No studies: they judge by what the studies have stored.
CLAIMS, SENSITIVE = "claims", "sensitive"

app = typer.Typer(add_completion=False, pretty_exceptions_enable=False)


@app.command()
def main(
    names: Annotated[
        list[str] | None, typer.Argument(metavar="[NAME]...", help="Studies to run, claims, sensitive.")
    ] = None,
    show: Annotated[bool, typer.Option("--list", help="List the studies and their questions.")] = False,
    every: Annotated[bool, typer.Option("--all", help="Run every study but those of rivals.")] = False,
    rivals: Annotated[bool, typer.Option("--rivals", help="Run the studies of rivals; see make rivals.")] = False,
    reproduce: Annotated[bool, typer.Option("--reproduce", help="Run what `make reproduce` runs.")] = False,
    quick: Annotated[bool, typer.Option("--quick", help="Shorten each study, and name the checks left out.")] = False,
    force: Annotated[bool, typer.Option("--force", help="Repeat also studies that are up to date.")] = False,
    perturbed: Annotated[
        int | None, typer.Option(metavar="SEED", min=0, envvar=PERTURBED, help="Noise of the size of rounding.")
    ] = None,
    draws: Annotated[int, typer.Option(metavar="M", min=1, help="With SEED and the M - 1 seeds after it.")] = 1,
    target: Annotated[
        str | None, typer.Option(metavar="NAME", help=f"As compiled for {', '.join(targets.NAMES)}.")
    ] = None,
) -> None:
    """Run studies; each stores its tables and its verdict in validation/results/NAME/.

    A result is kept, and its study not repeated, until its code, the files it read, a package or the processor changes;
    a quick result does not count for a full run, nor a full result for a quick run. An interrupted run continues with
    the studies that are not stored. --all and --reproduce run studies that time nothing side by side on all processors,
    and the others alone afterwards. At the end of --all and --reproduce, and by the name claims, the paper's claims are
    judged by the stored results.

    --perturbed and --target show what hangs on rounding. Their results lie apart, in validation/results/.perturbed/,
    and replace no plain one; their times are not judged. The name sensitive lists the numbers that move by more than a
    tenth of their tolerance.

    Exit code 0: each check as recorded in expected.toml or better, each verdict as recorded in claims.toml. 1: worse
    than recorded, another verdict, or a study failed; a verdict that changes with rounding, and sensitive.toml does not
    say why. 2: bad usage. 130: interrupted; finished studies are kept.
    """
    if show:
        for name in STUDIES:
            typer.echo(printable_lines(_line(name)))
        typer.echo(f"{CLAIMS:<20} Which claims of the paper hold, by how much, and within which limits?  [reproduce]")
        typer.echo(f"{SENSITIVE:<20} Which numbers hang on rounding, by how much, and why?")
        return
    names = names or []
    claims, sensitive = every or reproduce or CLAIMS in names, SENSITIVE in names
    try:
        asked = variations(perturbed, draws, target)
        if target is not None and (why := targets.lacking(target)):
            typer.echo(f"{target}: skipped: {why}")
            return
        is_here = len(asked) == 1 and asked[0].is_here
        # Before any study is imported: a later edit is repeated by the next run.
        sources = fingerprint.Sources() if is_here else None
        chosen = choose([name for name in names if name not in (CLAIMS, SENSITIVE)], every, reproduce, rivals)
        if not chosen and not claims and not sensitive:
            raise runner.UsageError("nothing to run: name a study, or use --all, --rivals, --reproduce or --list")
        expected, reasons = runner.read_expected(runner.EXPECTED), sensitivity.read_reasons(sensitivity.REASONS)
        runner.check_results(asked[0].folder(study.RESULTS))
    except (runner.UsageError, SourceSyntaxError) as error:
        typer.echo(printable_lines(f"error: {error}"), err=True)
        raise typer.Exit(2) from error
    console, code, results = Console(), 0, asked[0].folder(study.RESULTS)
    if (chosen or claims) and not is_here:
        flags = {"--all": every, "--rivals": rivals, "--reproduce": reproduce, "--quick": quick, "--force": force}
        given = [*(name for name in names if name != SENSITIVE), *(flag for flag, there in flags.items() if there)]
        code = variation.in_processes(asked, given)
    elif asked[0].label:
        typer.echo(f"{asked[0].label}:")
    try:
        if chosen and sources is not None:
            code = runner.run_all(
                chosen,
                quick=quick,
                force=force,
                processes=1 if names else side_by_side.workers(),
                data=study.data_folder(),
                expected=expected,
                results=results,
                sources=sources,
                console=console,
                variation=asked[0].label,
            )
    except InputError as error:  # of the results folder: what a study fails at is its own result
        typer.echo(printable_lines(f"error: {error}"), err=True)
        raise typer.Exit(2) from error
    if claims and is_here and code != runner.INTERRUPTED:
        timed = (
            [name for name in STUDIES if (of := runner.loaded(name)) is not None and of.timed] if asked[0].label else []
        )
        code = max(code, judgement.run(results, console, ledger.CLAIMS, timed))
    if sensitive and code != runner.INTERRUPTED:
        code = max(code, sensitivity.tell(sensitivity.moved(study.RESULTS, reasons), reasons, console))
    raise typer.Exit(code)


def variations(perturbed: int | None, draws: int, target: str | None) -> list[Variation]:
    """What is asked for: a plain run, or one for each seed."""
    if target is not None and target not in targets.NAMES:
        raise runner.UsageError(f"target = {target!r}: expected one of {', '.join(targets.NAMES)}")
    if perturbed is None:
        if draws > 1:
            raise runner.UsageError("--draws: expected --perturbed SEED, the seed of the first draw")
        return [Variation(None, target)]
    return [Variation(seed, target) for seed in range(perturbed, perturbed + draws)]


def choose(names: list[str], every: bool, reproduce: bool, rivals: bool) -> list[str]:
    """The studies asked for, in the order of the registry."""
    for name in names:
        runner.check_name(name)
    if reproduce:
        names = [*names, *(name for name in STUDIES if (found := runner.loaded(name)) is None or found.reproduce)]
    kinds = {True: rivals, False: every}
    return [name for name in STUDIES if kinds[name in RIVALS] or name in names]


def _line(name: str) -> str:
    """One study in the list."""
    try:
        found = runner.load(name)
    except Exception as error:
        # The list must show the others too.
        return f"{name:<20} cannot be loaded: {type(error).__name__}: {error}"
    marks = [
        *(["reproduce"] if found.reproduce else []),
        *(["rivals"] if name in RIVALS else []),
        *(f"needs {need}" for need in found.needs),
    ]
    return f"{name:<20} {found.question}" + (f"  [{', '.join(marks)}]" if marks else "")


if __name__ == "__main__":
    degrade_output()
    with as_interrupts():
        app(prog_name="python -m validation")
