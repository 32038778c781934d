"""Names, units and layout of the report's figures; .ci/test_figures.py draws them all from the studies' tables."""

import itertools

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

from references import contact, rivals
from reports import figures
from reports.figures import style
from validation.harness.registry import STUDIES

from . import synthetic

ALL = [(study, figure) for study, those in figures.by_study().items() for figure in those]


def test_names_make_distinct_files():
    names = [(study, figure.name) for study, figure in ALL]
    assert len(set(names)) == len(names)
    assert figures.by_study().keys() <= STUDIES.keys()


def test_torque_is_drawn_in_kilonewton_metres():
    tables = synthetic.STUDIES["paper_well"]()
    (figure,) = [figure for figure in figures.by_study()["paper_well"] if figure.name == "torque"]
    drawn = figure.draw(tables).axes[0].get_lines()
    assert len(drawn) == 4
    paper = tables["trip_in"].query("variant == 'paper-well'")
    assert drawn[0].get_ydata()[-1] == pytest.approx(paper["sum_r_mu_fn_N_m"].iloc[-1] / 1e3)


def test_build_intervals_are_where_the_inclination_changes():
    md = np.array([1700.0, 1750.0, 2000.0, 2250.0, 2250.0, 2300.0, 2350.0, 2450.0, 2600.0])
    inclination = np.array([0.0, 0.0, 29.0, 58.0, 58.0, 58.0, 66.0, 90.0, 90.0])
    shuffled = np.random.default_rng(1).permutation(len(md))
    assert style.build_intervals(md[shuffled], inclination[shuffled]) == [(1750.0, 2250.0), (2300.0, 2450.0)]


def test_times_that_failed_the_gate_are_struck_through():
    """Each dot stays, and a dash lies over those of the engine that failed."""
    rows = [
        (state, 60, step, engine, time, "failed: lean" if engine == "loose" else "passed")
        for state in ("contact", "no contact")
        for step in ("own step", "equal step")
        for engine, time in (("sound", 1.0), ("loose", 100.0))
    ]
    columns = ["state", "segments", "step", "engine", "ms_per_simulated_s", "gate"]
    (figure,) = [figure for figure in figures.by_study()["speed"] if figure.name == "seconds"]
    drawn = figure.draw({"times": pd.DataFrame(rows, columns=columns)}).axes[0].get_lines()
    dots, dashes = ([line for line in drawn if (line.get_marker() == "_") == dash] for dash in (False, True))
    assert [np.isfinite(np.asarray(line.get_xdata(), float)).sum() for line in dots[:-1]] == [2, 2, 2, 2]
    assert [np.nanmax(np.asarray(line.get_xdata(), float)) for line in dashes] == [100, 100, 100, 100]
    assert all(np.isfinite(np.asarray(line.get_xdata(), float)).sum() == 1 for line in dashes)


def test_series_differ_in_lightness_from_their_neighbours():
    def lightness(colour):
        return np.dot([0.2126, 0.7152, 0.0722], mpl.colors.to_rgb(colour))

    light = [lightness(colour) for colour in style.COLOURS]
    assert min(abs(a - b) for a, b in itertools.pairwise(light)) > 0.03


def test_every_contact_method_has_a_colour_of_its_own():
    """Those of rivals too, and some of users."""
    count = len(contact.METHODS) + len(rivals.METHODS) + 3
    colours = np.array([mpl.colors.to_rgb(style.colour(k)) for k in range(count)])
    apart = np.linalg.norm(colours[:, None] - colours, axis=2)
    assert apart[~np.eye(len(colours), dtype=bool)].min() > 0.15
    assert style.dots(7)["color"] == style.line(7)["color"] == style.colour(7)


def test_the_first_row_is_on_top_and_zero_in_the_middle():
    ax = style.figure(2.0).subplots()
    style.rows_downwards(ax, ["first", "second"])
    assert ax.get_ylim() == (1.5, -0.5)
    assert style.around_zero(pd.Series([-2.0, np.nan, 1.0])) == (-3.0, 3.0)
