"""How ``fctd simulate`` and ``fctd chart`` keep what they compute, and go on with it: options, refusals, limits."""

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import Annotated, Any

import typer

from fctd.case.errors import InputError
from fctd.case.load import Case
from fctd.case.systems import TIME
from fctd.case.text import printable
from fctd.cli.interrupts import deferred
from fctd.cli.options import messages
from fctd.cli.quantities import Given, QuantityOption, quantity, si
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.store.limits import Limits
from fctd.store.origin import changes, origin_of
from fctd.store.run_folder import RunFolder, about_of, chunks_of, progress_of, run_path

# Longest time between two checkpoints of a run, and between two chunks of a chart [s].
EVERY_RUN, EVERY_CHART = 60.0, 5.0

OptionalCase = Annotated[
    Path | None, typer.Argument(metavar="CASE", help="Case file (TOML); none with --resume.", show_default=False)
]
CheckpointEvery = Annotated[
    Given | None,
    quantity(
        QuantityOption("--checkpoint-every", TIME),
        "TIME",
        f"Longest time between two saves; default: '{EVERY_RUN:g} s' for a run, '{EVERY_CHART:g} s' for a chart.",
        show_default=False,
    ),
]
Resume = Annotated[
    Path | None,
    typer.Option("--resume", metavar="RESULT", help="Go on with the unfinished run of a result.", show_default=False),
]
Restart = Annotated[bool, typer.Option("--restart", help="Drop the unfinished run of the result, and begin anew.")]
AcceptChanges = Annotated[
    bool,
    typer.Option(
        "--accept-changes",
        help="With --resume: go on although files, versions or processor changed; case and survey stay as they were.",
    ),
]
TimeLimit = Annotated[
    Given | None,
    quantity(
        QuantityOption("--time-limit", TIME),
        "TIME",
        "Stop after this time, '2 h', and keep the run.",
        show_default=False,
    ),
]
MemoryLimit = Annotated[
    str | None,
    typer.Option(
        "--memory-limit", metavar="SIZE", help="Stop when the run has taken this much memory, '4 GB', and keep it.",
        show_default=False,
    ),
]  # fmt: skip
COPIED = "survey", "caliper"  # files that a run keeps a copy of
BYTES = {"kB": 1e3, "MB": 1e6, "GB": 1e9, "KiB": 2.0**10, "MiB": 2.0**20, "GiB": 2.0**30}


@dataclass(frozen=True)
class SaveOptions:
    """The options of this module as they were given."""

    checkpoint_every: CheckpointEvery = None
    resume: Resume = None
    restart: Restart = False
    accept_changes: AcceptChanges = False
    time_limit: TimeLimit = None
    memory_limit: MemoryLimit = None

    def check(self, alone: Mapping[str, Any]) -> None:
        """Raise InputError for a time that cannot be read, and where ``--resume`` stands beside options that begin a
        run, or others without it."""
        for given in (self.checkpoint_every, self.time_limit):
            si(given, "si")
        if self.resume is not None:
            for key, value in ({"--restart": self.restart or None} | dict(alone)).items():
                if value is not None:
                    expected = "nothing beside --resume, which goes on with the case and the options of the run"
                    raise InputError(expected, key=key, value=value)
        elif self.accept_changes:
            raise InputError("--resume beside it", key="--accept-changes", value=True)

    def interval(self, default: float) -> float:
        """Time between two checkpoints [s]."""
        return default if self.checkpoint_every is None else self.checkpoint_every.si("si")

    @property
    def limits(self) -> Limits:
        """The limits of time and memory, from now on."""
        return Limits(
            si(self.time_limit, "si"),
            None if self.memory_limit is None else read_bytes(self.memory_limit, "--memory-limit"),
        )


def read_bytes(text: str, key: str) -> float:
    """A size of memory, "4 GB" or "512 MiB" [bytes]; InputError names the option."""
    match = re.fullmatch(r"([0-9.]+)\s*([A-Za-z]+)", text.strip())
    try:
        size = float(match[1]) * BYTES[match[2]] if match else 0.0
    except (ValueError, KeyError):
        size = 0.0
    if not size > 0:
        raise InputError(f"a size above 0, such as '4 GB' (units: {', '.join(BYTES)})", key=key, value=text)
    return size


@contextmanager
def begun_folder(target: Path, key: str, *, restart: bool) -> Iterator[RunFolder]:
    """The folder of a run that begins, locked; it goes where nothing has been kept.

    Raises InputError where another process computes the same result, and where there is an unfinished run, unless it
    is dropped by ``restart``.
    """
    folder, begun = None, False
    try:
        with deferred():  # a signal leaves no folder in which nothing has begun
            folder = RunFolder.take(target, key)
            about = None if restart else about_of(target)
            if about is not None and has_kept(target):
                expected = (
                    f"a result without an unfinished run ({how_far(target)}): `{way_on(target, about)}` goes on with "
                    "it, --restart drops it and begins anew"
                )
                raise InputError(expected, key=key, value=target)
            folder.clear()
            begun = True
        yield folder
    finally:  # what is refused stays
        if folder is not None:
            with deferred():
                folder.leave(remove=begun and not has_kept(target))


def has_kept(target: Path) -> bool:
    """Whether there is something to go on with."""
    return bool(chunks_of(run_path(target)).files)


def how_far(target: Path) -> str:
    """What an unfinished run has kept, in words."""
    progress = progress_of(target)
    return "" if progress is None else f"{progress.kept:.4g} of {progress.total:.4g} {progress.unit} are kept"


def way_on(target: Path, about: Mapping[str, Any]) -> str:
    """The command that goes on with a run."""
    return f"{about['program']} --resume {quote(printable(str(target)))}"


def say_how_to_go_on(target: Path) -> None:
    """Print how to go on with a run that is kept, and nothing where none is."""
    about = about_of(target)
    if about is not None and has_kept(target):
        messages.print(f"kept: {how_far(target)}; `{way_on(target, about)}` goes on", soft_wrap=True)


@contextmanager
def resumed_folder(target: Path, program: str, *, accept_changes: bool) -> Iterator[tuple[RunFolder, dict[str, Any]]]:
    """The folder of an unfinished run and its description, locked.

    Raises InputError where there is no such run, it belongs to another program, another process goes on with it, or
    files, versions or processor have changed.
    """
    about = about_of(target)
    if about is None:
        expected = "a result whose run has not ended (fctd status says how far a result is)"
        raise InputError(expected, key="--resume", value=target)
    if about["program"].split()[:3] != program.split()[:3]:
        raise InputError(f"a run of this program: `{way_on(target, about)}`", key="--resume", value=target)
    folder = RunFolder.take(target, "--resume")
    try:
        about = about_of(target)
        if about is None:  # another process has finished it meanwhile
            raise InputError("a result whose run has not ended", key="--resume", value=target)
        if not accept_changes:
            _refuse_changes(target, about)
        yield folder, about
    finally:
        folder.leave(remove=about_of(target) is None)


def _refuse_changes(target: Path, about: Mapping[str, Any]) -> None:
    files = {name: Path(path) for name, path in about["files"].items()}
    found = list(changes(about["origin"], origin_of(files, hash_of_sources())))
    if found:
        expected = (
            f"what the run began with: {'; '.join(found)}; put it back, go on with case and survey as they were by "
            "--accept-changes, or begin anew with --restart"
        )
        raise InputError(expected, key="--resume", value=target)


def description_of(
    case: Case, program: str, command: str, options: Mapping[str, Any], identity: str
) -> tuple[dict[str, Any], dict[str, bytes]]:
    """What ``RunFolder.describe`` takes of a run that begins: its description, and copies of survey and caliper."""
    files = files_of(case)
    kept = {name: files[name] for name in COPIED if name in files}
    copies = {f"{name}{path.suffix}": path.read_bytes() for name, path in kept.items()}
    about = {
        "command": command, "program": program, "case": case.model_dump(mode="json"), "options": dict(options),
        "files": {name: str(path) for name, path in files.items()}, "origin": origin_of(files, hash_of_sources()),
        "copies": list(copies), "identity": identity,
    }  # fmt: skip
    return about, copies


def files_of(case: Case) -> dict[str, Path]:
    """The files that a case was read from, absolute, by what they are."""
    caliper = case.wellbore.caliper
    files = {
        "case file": case.file, "survey": case.wellbore.survey, "caliper": None if caliper is None else caliper.log,
    }  # fmt: skip
    return {name: path.absolute() for name, path in files.items() if path is not None}


def case_of(folder: Path, about: Mapping[str, Any]) -> Case:
    """The case of a run as it began, with survey and caliper as they were then; folder : of the run."""
    case = Case.model_validate(about["case"])
    for copy in about["copies"]:
        hole = case.wellbore
        read = hole.caliper_from if Path(copy).stem == "caliper" else hole.read_from
        case = case.model_copy(update={"wellbore": read(folder / copy)})
    return case
