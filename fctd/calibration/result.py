"""The result of a calibration: values of the unknowns, residuals of the readings, rows left out."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import pandas as pd

from fctd.calibration.days import Scattered
from fctd.calibration.factors import friction_table
from fctd.calibration.fit import Fit, Loss
from fctd.calibration.forward import Forward
from fctd.calibration.identify import Undetermined
from fctd.calibration.intervals import Intervals, find_intervals, leave_one_out
from fctd.calibration.predict import Posterior
from fctd.calibration.unknowns import Unknown, with_values
from fctd.case.load import Case
from fctd.case.text import counted
from fctd.hydraulics.channel import has_flow_curve


@dataclass(frozen=True, repr=False)
class Calibration:
    """A calibrated case.

    base : the case before; fit : of the unknowns; left_out : reasons of the rows that were not fitted, by id; loss : of
    the readings; undetermined : unknowns that the rows do not tell apart, where they were to be fitted all the same;
    predicted : of rows of deeper hole sections (``predict_rows``), where the first section alone was fitted.
    scattered : the fit with scatter between days, whose values and readings ``fit`` has; None for one without.
    misread : rows that may be misread, by id, and why (``misread``).  scores : of days left out, where friction that is
    linear in depth was tried: the fit is the one with the larger score.
    """

    base: Case
    forward: Forward
    fit: Fit
    left_out: Mapping[str, str]
    loss: Loss
    undetermined: tuple[Undetermined, ...] = ()
    predicted: pd.DataFrame | None = None
    scattered: Scattered | None = None
    misread: Mapping[str, str] = field(default_factory=dict)
    scores: Mapping[str, float] = field(default_factory=dict)

    @property
    def unknowns(self) -> tuple[Unknown, ...]:
        """The unknowns."""
        return self.forward.unknowns

    @property
    def values(self) -> dict[str, float]:
        """The value of each unknown [SI]."""
        return dict(zip(self.forward.names, self.fit.best.tolist(), strict=True))

    @property
    def case(self) -> Case:
        """The case with the values."""
        return with_values(self.base, self.values)

    @property
    def strings(self) -> dict[str, Case]:
        """The case of each string of the rows with the values."""
        return {name: with_values(case, self.values) for name, case in self.forward.strings.items()}

    @cached_property
    def residuals(self) -> pd.DataFrame:
        """A row for each measured load: id, string, operation, bit_depth_m, load, low, high and fitted (SI), residual.

        residual : distance of the fitted reading from the range [SI], 0 within it; in_noise : over the noise; fitted is
        NaN where the string has no loads.  used : whether it was fitted.  day and pumps as the row has them; speed_m_s,
        rpm, flow_m3_s and weight_on_bit_N : what the string does, with the recorded flow where there is one; lift_N :
        what mud that flows takes off the load along the string.
        """
        forward, rows = self.forward, []
        for i, reading in enumerate(forward.readings):
            row, (low, high) = forward.rows[reading.row], reading.range
            if np.isnan(low):
                continue
            fitted = self.fit.evaluation.value[i]
            off = np.maximum(fitted - high, 0.0) + np.minimum(fitted - low, 0.0)
            rows.append(
                {
                    "id": row.id, "string": row.string, "operation": row.operation, "bit_depth_m": row.bit_depth,
                    "load": reading.load, "low": low, "high": high, "fitted": fitted, "residual": off,
                    "in_noise": off / reading.noise, "used": reading.row in self.fit.used, "day": row.day,
                    "pumps": row.pumps, **row.does(forward.strings[row.string]),
                    "lift_N": self.fit.evaluation.lifts[reading.row],
                }
            )  # fmt: skip
        return pd.DataFrame(rows)

    @property
    def misfit(self) -> float:
        """Mean square of the residuals over the noise by degree of freedom: about 1; NaN without one."""
        table = self.residuals[self.residuals["used"]]
        free = len(table) - sum(unknown.prior is None for unknown in self.unknowns)
        return float((table["in_noise"] ** 2).sum() / free) if free > 0 else float("nan")

    @property
    def absorbed(self) -> str:
        """That the fit takes the lift of flowing mud for something else, in a sentence; "" where it does not."""
        used = [self.forward.rows[k] for k in self.fit.used]
        pumped = [row for row in used if row.pumps == "on" or row.flow > 0]
        silent = [row for row in pumped if not has_flow_curve(self.strings[row.string])]
        if not silent:
            return ""
        return (
            f"{counted(len(silent), 'row')} of {len(used)} were read with pumps on, and the case does not say how its "
            "mud flows (mud.fann, mud.rheology or mud.viscosity): what the flow takes off the hook load is fitted as "
            "friction, block weight or bias"
        )

    @property
    def doubts(self) -> dict[str, str]:
        """Status and message of the fitted rows whose string is not ``converged``, by id."""
        found = self.fit.evaluation.doubts
        return {self.forward.rows[k].id: found[k] for k in self.fit.used if k in found}

    @cached_property
    def intervals(self) -> Intervals:
        """The 95 % intervals of the unknowns, which take some fits where there is no scatter."""
        if self.scattered is not None:
            return self.scattered.intervals
        return find_intervals(self.forward, self.fit, self.loss)

    @cached_property
    def leave_one_out(self) -> pd.DataFrame:
        """The fit without each row, and what it predicts for that row (``intervals.leave_one_out``).

        With scatter, without each day: the rows of a day are left out together (``Scattered.leave_one_out``).
        """
        if self.scattered is not None:
            return self.scattered.leave_one_out(self.forward)
        return leave_one_out(self.forward, self.fit, self.loss)

    @cached_property
    def table(self) -> pd.DataFrame:
        """A row for each unknown: name, unit, value, low and high of its 95 % interval, how it was found, at_bound.

        With scatter, also its standard deviations.
        """
        found, columns = self.intervals, []
        for k, unknown in enumerate(self.unknowns):
            bound = unknown.name in found.at_bound or unknown.name in self.active
            columns.append(
                (unknown.name, unknown.unit, self.fit.best[k], found.low[k], found.high[k], found.how[k], bound)
            )
        table = pd.DataFrame(columns, columns=["name", "unit", "value", "low", "high", "how", "at_bound"])
        if self.scattered is None:
            return table
        return pd.concat([table, pd.DataFrame(self.scattered.deviations).assign(at_bound=False)], ignore_index=True)

    @cached_property
    def factors(self) -> pd.DataFrame:
        """Friction factors by hole and motion, each with its interval and its rows (``friction_table``)."""
        return friction_table(self.forward, self.fit, self.intervals)

    @cached_property
    def correlations(self) -> pd.DataFrame:
        """Correlations of the unknowns, (k, k)."""
        names = list(self.forward.names)
        return pd.DataFrame(self.intervals.correlation, index=names, columns=names)

    @property
    def posterior(self) -> Posterior:
        """What predictions need: values, covariance, setup, and the width of the ranges that each source records."""
        widths: dict[str, dict[str, list[float]]] = {}
        for reading in self.forward.readings:
            low, high = reading.range
            if reading.row in self.fit.used and not np.isnan(low):
                source = self.forward.rows[reading.row].source
                widths.setdefault(source, {}).setdefault(reading.load, []).append(high - low)
        spread = {
            source: {load: float(np.sqrt(np.mean(np.square(w)) / 12)) for load, w in loads.items()}
            for source, loads in widths.items()
        }
        mixture = None if self.scattered is None else self.scattered.fit.mixture.main()
        return Posterior(self.unknowns, self.fit.best, self.intervals.covariance, self.forward.setup, spread, mixture)

    @property
    def active(self) -> dict[str, str]:
        """The unknowns whose value is at a bound: "lowest" or "highest"."""
        found = {}
        for unknown, value in zip(self.unknowns, self.fit.best, strict=True):
            near = 1e-6 * (unknown.high - unknown.low)
            if value <= unknown.low + near or value >= unknown.high - near:
                found[unknown.name] = "lowest" if value <= unknown.low + near else "highest"
        return found
