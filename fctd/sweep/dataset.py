"""The folder of a sweep: its samples, and the rows of their results in parts that are written whole or not at all.

``sweep.json`` says what was swept, ``samples.parquet`` has a row for each sample, ``rows/part-NNNNN.parquet`` the rows
of some samples.  A part is written beside and renamed, so that what a killed sweep leaves is
complete as far as it goes; only one sweep at a time works on a folder.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from fctd.case.errors import InputError
from fctd.mechanics.compile_cache import hash_of_sources
from fctd.store.lock import NAME as LOCK
from fctd.store.lock import FolderLock, HeldError
from fctd.store.log import Log
from fctd.store.origin import changes, versions, versions_alone
from fctd.store.parquet import read_frame, read_table
from fctd.store.whole_file import whole_file
from fctd.sweep.template import Template

if TYPE_CHECKING:
    import pandas as pd
    import pyarrow as pa

ABOUT, SAMPLES, ROWS = "sweep.json", "samples.parquet", "rows"
OURS: Final = (ABOUT, SAMPLES, ROWS, LOCK)


class Dataset:
    """The dataset of a sweep in a folder; ``done`` has the numbers of its samples that have rows."""

    def __init__(self, folder: Path, about: dict[str, Any], samples: pd.DataFrame) -> None:
        self.folder, self.about, self.samples = folder, about, samples
        self._log = Log(folder / ROWS, "part-", ".parquet", digits=5)
        self.done = {number for table in self._tables(["sample"]) for number in table["sample"].to_pylist()}

    @property
    def parts(self) -> list[Path]:
        """The files of rows."""
        return list(self._log.files.values())

    @property
    def missing(self) -> list[int]:
        """Numbers of the samples that have no rows yet, in their order."""
        return [k for k in range(len(self.samples)) if k not in self.done]

    def write(self, tables: Sequence[pa.Table]) -> Path:
        """Add rows as a part, with the values of their samples beside them; raises InputError where it cannot."""
        import numpy as np
        import pyarrow as pa
        import pyarrow.parquet as pq

        table = pa.concat_tables(tables, promote_options="permissive")
        numbers = table["sample"].to_numpy()
        table = table.take(pa.array(np.argsort(numbers, kind="stable")))
        numbers = table["sample"].to_numpy()
        values = self.samples.drop(columns="sample").iloc[numbers]
        # The column of a key goes before one of that name in the results: "friction" has the same values in both.
        columns = {"sample": table["sample"]} | {str(name): pa.array(values[name]) for name in values.columns}
        columns |= {name: table[name] for name in table.column_names if name not in columns}
        path = self._log.path(self._log.following)
        with whole_file(path, lasting=True) as scratch, scratch.open("wb") as sink:
            pq.write_table(pa.table(columns), sink, compression="zstd")
        self.done.update(numbers.tolist())
        return path

    def statuses(self) -> dict[str, int]:
        """How many rows have which status; raises InputError for a part that cannot be read."""
        return dict(Counter(status for table in self._tables(["status"]) for status in table["status"].to_pylist()))

    def _tables(self, columns: list[str] | None = None) -> Iterator[pa.Table]:
        """The rows of every part, of all or of some columns."""
        for path in self.parts:
            try:
                with path.open("rb") as source:
                    yield read_table(source, columns).replace_schema_metadata(None)
            except (OSError, ValueError) as error:
                raise InputError(f"a part that fctd sweep wrote ({error})", value=path) from error

    def rows(self) -> pd.DataFrame:
        """All rows, in the order of the samples; raises InputError for a part that cannot be read."""
        import pyarrow as pa

        tables = list(self._tables())
        if not tables:
            raise InputError("the rows of at least one sample: fctd sweep makes them", value=self.folder / ROWS)
        table: pd.DataFrame = pa.concat_tables(tables, promote_options="permissive").to_pandas(use_threads=False)
        return table.sort_values("sample", kind="stable", ignore_index=True)

    def keep_run(self, run: dict[str, Any]) -> None:
        """Add what is known of a run of the sweep to ``sweep.json``."""
        self.about["runs"] = [*self.about.get("runs", []), run]
        _write_about(self.folder, self.about)


def identity_of(template: Template) -> str:
    """A hash of all that the rows of a sweep depend on: its file without [uncertainty], case and survey."""
    spec = template.spec.model_dump(mode="json", exclude={"uncertainty", "case", "file"})
    tables = {name: of for name, of in template.raw.items() if name != "units"}
    raw = json.dumps([spec, tables], sort_keys=True, default=str)
    return hashlib.sha256(raw.encode() + template.base.wellbore.trajectory.tobytes()).hexdigest()


def open_dataset(folder: Path) -> Dataset:
    """The dataset of a folder; raises InputError where there is none."""
    try:
        about = json.loads((folder / ABOUT).read_text(encoding="utf-8"))
        with (folder / SAMPLES).open("rb") as source:
            samples = read_frame(source)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"a folder that fctd sweep has written ({reason})", value=folder) from error
    return Dataset(folder, about, samples)


def begin_dataset(folder: Path, template: Template, samples: pd.DataFrame) -> Dataset:
    """The dataset of a sweep: what is there of it, or a new one.

    Raises InputError where the folder has other files, another sweep, or one of another version of the program.
    """
    identity = identity_of(template)
    if (folder / ABOUT).exists():
        found = open_dataset(folder)
        if found.about.get("identity") != identity:
            expected = "another folder, or that of the same sweep (this one has another sweep file, case or survey)"
            raise InputError(expected, key="--out", value=folder)
        before = versions_alone(found.about["versions"], found.about.get("sources", ""))
        other = "; ".join(changes(before, versions_alone(versions(), hash_of_sources())))
        if other:
            raise InputError(f"another folder: since its rows were computed, {other}", key="--out", value=folder)
        return found
    about = {
        "name": template.spec.name,
        "identity": identity,
        "samples": len(samples),
        "units": template.units,
        "sweep": template.spec.model_dump(mode="json"),
        "case": template.base.model_dump(mode="json"),
        "versions": versions(),
        "sources": hash_of_sources(),
    }
    (folder / ROWS).mkdir(parents=True, exist_ok=True)
    with whole_file(folder / SAMPLES, lasting=True) as scratch, scratch.open("wb") as sink:
        samples.to_parquet(sink, index=False)
    _write_about(folder, about)  # last: it says that the folder is a dataset
    return Dataset(folder, about, samples)


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Inside, no other sweep works on the folder, which is made where it is missing.

    Raises InputError where another one does, where the folder has other files, and where it cannot be made.
    """
    try:
        # What begins with a dot may be a file that a killed sweep was writing.
        if folder.exists() and any(name not in OURS and name[0] != "." for name in os.listdir(folder)):
            raise InputError("a folder for a sweep alone (this one has other files)", key="--out", value=folder)
        folder.mkdir(parents=True, exist_ok=True)
        lock = FolderLock.take(folder)
    except OSError as error:
        raise InputError(f"a folder that can be written ({error.strerror})", key="--out", value=folder) from error
    except HeldError as held:
        here = f"a folder that no other sweep works on (process {held.holder.process} does)"
        raise InputError(here, key="--out", value=folder) from None
    try:
        yield
    finally:
        (folder / LOCK).unlink(missing_ok=True)
        lock.release()


def _write_about(folder: Path, about: dict[str, Any]) -> None:
    with whole_file(folder / ABOUT, lasting=True) as scratch:
        scratch.write_text(json.dumps(about, indent=1), encoding="utf-8")
