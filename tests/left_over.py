"""What a killed process leaves beside a file or a folder of results."""

from pathlib import Path

from fctd.store.scratch import scratch_file


def left_beside(target: Path) -> Path:
    """The temporary file of a writer that was killed."""
    with scratch_file(target) as scratch:
        return scratch


def left_folders(folder: Path) -> tuple[Path, Path]:
    """Where a killed process left the new folder and the one before; neither is made."""
    scratch = left_beside(folder.with_name(f"{folder.name}.lock"))
    return scratch.with_suffix(".run"), scratch.with_suffix(".old")
