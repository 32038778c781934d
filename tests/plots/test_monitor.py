"""The picture of monitored friction."""

import pytest

from fctd.monitoring.monitor import monitor
from fctd.plots.monitor import monitor_figure
from tests.monitoring.made import readings, series, shared_chart, well


@pytest.fixture(autouse=True)
def _one_chart(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fctd.monitoring.monitor.Chart", shared_chart)


def test_panels_curves_bands_and_alarms() -> None:
    found = monitor(well(), readings())
    figure = monitor_figure(found, well(), "field")
    hook, torque, factor = figure.axes
    assert [ax.get_xlabel() for ax in figure.axes] == [
        "weight indicator, klbf", "drive torque, kft·lbf", "apparent friction factor",
    ]  # fmt: skip
    assert hook.yaxis_inverted()
    assert (len(hook.lines), len(torque.lines)) == (2 * 4, 4)  # readings and three curves of each kind
    assert len(factor.patches) == len(found.alarms) == 1
    texts = [text.get_text() for text in figure.texts]
    assert any(text.startswith("alarm: from 2") and " ft the apparent" in text for text in texts)


def test_a_series_without_a_factor_is_drawn() -> None:
    found = monitor(well(), series().iloc[:50])
    assert found.alarms == ()
    assert len(monitor_figure(found, well()).axes) == 3
