"""Sweeps from Python: ``run_sweep`` computes the samples, ``run_uncertainty`` says what they tell."""

from __future__ import annotations

import os
import time
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Literal

from fctd import plots
from fctd.answers.display import Picture, answering, html_of, picture
from fctd.case.errors import InputError
from fctd.case.text import counted, file_name
from fctd.case.units import LENGTH, argument
from fctd.results.unit_systems import System
from fctd.sweep import uncertainty
from fctd.sweep.chunk import NO_ROWS, as_table
from fctd.sweep.cluster import ClusterChoice
from fctd.sweep.dataset import Dataset, alone, begin_dataset, identity_of, open_dataset
from fctd.sweep.design import sample_of, samples_of
from fctd.sweep.run import PART, SampleProgress, prepare, sweep
from fctd.sweep.spec import SweepSpec, read_sweep
from fctd.sweep.template import template_of

if TYPE_CHECKING:
    import pandas as pd

SweepFile = str | os.PathLike[str] | Mapping[str, Any]
HERE: Final = 0  # workers: none beside this process


class Uncertainty(uncertainty.Uncertainty):
    def plot(
        self, of: Literal["bands", "tornado"] | None = None, units: System = "si", operation: str | None = None
    ) -> Picture:
        """Bands of the loads over depth, or the influence of each parameter on the loads of an operation.

        of : by default bands where there are several depths.  operation : of the tornado, by default the first.
        """
        several = len(set(self.percentiles.get("bit_depth_m", []))) > 1
        if of == "bands" or (of is None and several):
            return picture(lambda: plots.bands_figure(self, units))
        return picture(lambda: plots.tornado_figure(self, operation, units))

    def __repr__(self) -> str:
        samples = counted(int(self.rows["sample"].nunique()), "sample")
        return f"Uncertainty({self.spec.name!r}, {samples}: {', '.join(self.columns)})"

    def _repr_html_(self) -> str:
        return html_of(repr(self), self.percentiles)


assess = answering(Uncertainty, uncertainty.assess)


@dataclass(frozen=True, repr=False)
class Swept:
    """A sweep whose samples have rows.

    dataset : in its folder; rows, samples : of it, as in ``docs/sweep.md``; statuses : how many rows have which.
    """

    spec: SweepSpec
    dataset: Dataset

    @property
    def samples(self) -> pd.DataFrame:
        """A row for each sample, a column for each key."""
        return self.dataset.samples

    @cached_property
    def rows(self) -> pd.DataFrame:
        """The rows of all samples [SI], with the values of the sample beside them."""
        return self.dataset.rows()

    @property
    def statuses(self) -> dict[str, int]:
        """How many rows have which status."""
        return self.dataset.statuses()

    @cached_property
    def uncertainty(self) -> Uncertainty:
        """What the samples tell at the last depth (``run_uncertainty``)."""
        return assess(self.dataset, self.spec)

    def plot(self, units: System = "si") -> Picture:
        """The picture of ``Uncertainty.plot``."""
        return self.uncertainty.plot(units=units)

    def __repr__(self) -> str:
        counts = ", ".join(f"{count} {status}" for status, count in self.statuses.items())
        return f"Swept({self.spec.name!r}, {counted(len(self.samples), 'sample')}, rows: {counts})"

    def _repr_html_(self) -> str:
        return html_of(repr(self), self.rows)


def run_sweep(
    sweep_file: SweepFile,
    out: str | os.PathLike[str] | None = None,
    workers: int | None = None,
    progress: SampleProgress | None = None,
) -> Swept:
    """Compute the samples of a sweep that have no rows yet.

    sweep_file : its path, or a dict of its tables, whose ``case`` is a path, the tables of a case, or a ``Case``.
    out : folder of the dataset, by default NAME-sweep.  workers : processes, by default one for each core; a script
    then calls this below ``if __name__ == "__main__":``, since each of them imports it.  0 computes in this process
    alone, which starts no other, and where nothing ends a sample that hangs.  progress : called with the samples that
    are done, their number, and how many have no answer.  Raises InputError for a sweep or folder that cannot be used.
    """
    spec = read_sweep(sweep_file)
    folder = Path(file_name(spec.name, "-sweep") if out is None else out)
    if workers == HERE:
        _compute_here(spec, folder, progress)
    else:
        sweep(spec, folder, ClusterChoice(workers), progress)
    return Swept(spec, open_dataset(folder))


def run_uncertainty(
    swept: Swept | SweepFile, folder: str | os.PathLike[str] | None = None, bit_depth: float | str | None = None
) -> Uncertainty:
    """What the samples of a sweep say: percentiles, probabilities, and which parameter matters (``assess``).

    swept : of ``run_sweep``; or the sweep file or its tables, with the folder of its dataset, by default NAME-sweep.
    bit_depth [m], or a text with its unit : of the indices, by default the last.  Raises InputError for a folder of
    another sweep, one whose samples have not all been computed, and another depth.
    """
    depth = None if bit_depth is None else argument(bit_depth, LENGTH, "bit_depth")
    if not isinstance(swept, Swept):
        spec = read_sweep(swept)
        swept = Swept(spec, dataset_of(spec, None if folder is None else Path(folder), "folder"))
    return assess(swept.dataset, swept.spec, depth)


def dataset_of(spec: SweepSpec, folder: Path | None, key: str) -> Dataset:
    """The dataset of a sweep in a folder, by default NAME-sweep; InputError, which names the key, for another one's."""
    dataset = open_dataset(Path(file_name(spec.name, "-sweep")) if folder is None else folder)
    if dataset.about.get("identity") != identity_of(template_of(spec, sample_of(samples_of(spec), 0))):
        raise InputError(
            "the folder of this sweep (its file, case or survey is another)", key=key, value=dataset.folder
        )
    return dataset


def _compute_here(spec: SweepSpec, folder: Path, progress: SampleProgress | None) -> None:
    """The samples one after the other in this process; those that are done stay where it is interrupted."""
    runner, samples = prepare(spec)
    with alone(folder):
        dataset = begin_dataset(folder, runner.template, samples)
        missing, lacking, tables, written = dataset.missing, 0, list[Any](), time.perf_counter()
        try:
            for number in missing:
                rows = runner.rows_of(sample_of(samples, number))
                lacking += rows[0]["status"] in NO_ROWS
                tables.append(as_table(rows))
                if progress is not None:
                    progress(len(dataset.done) + len(tables), len(samples), lacking)
                if time.perf_counter() - written > PART:
                    dataset.write(tables)
                    tables, written = [], time.perf_counter()
        finally:
            if tables:
                dataset.write(tables)
