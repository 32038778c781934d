"""What happens on the page: records make curves."""

from pathlib import Path

from fctd.app.runs_view import records


def test_a_run_without_records_is_an_empty_figure(tmp_path: Path) -> None:
    from fctd.app.callbacks import time_figure

    figure = time_figure(records(tmp_path, str(tmp_path / "none"), "field"), "field")
    assert [trace["name"] for trace in figure["data"]] == ["hook load", "torque"]
    assert "klbf" in figure["layout"]["yaxis"]["title"]["text"]
