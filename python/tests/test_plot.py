"""Every study draws itself."""

import os

import pytest
import zipact

pyplot = pytest.importorskip("matplotlib.pyplot")
from test_studies import CASES, DATA  # noqa: E402


@pytest.fixture(autouse=True)
def close_figures():
    yield
    pyplot.close("all")


@pytest.mark.parametrize("study", CASES)
def test_draws(study, tmp_path):
    result = zipact.Actuator(mesh__nodes=21, **CASES[study]).run(study)
    axes = result.plot()
    assert axes.lines and result.study in axes.get_title() and "/" in axes.get_ylabel()
    axes.figure.savefig(tmp_path / "picture.svg")
    assert os.path.getsize(tmp_path / "picture.svg") > 5000


@pytest.mark.nightly
def test_draws_several_kinds():
    scenario = os.path.join(DATA, "..", "calibrate-bench.yaml")
    axes = zipact.read_scenario(scenario).replace(mesh__nodes=15).run("calibrate").plot()
    kinds = [text.get_text() for text in axes.get_legend().get_texts()]
    assert kinds == ["stroke", "pull in voltage", "release voltage", "frequency"]
    assert [len(line.get_xdata()) for line in axes.lines[:4]] == [7, 4, 4, 3]


def test_draws_one_kind_with_standard_deviations():
    """The fit as without them, not residuals of a kind called "m"."""
    one = zipact.Actuator(mesh__nodes=21, **CASES["calibrate"], calibrate__sigma="stroke = 20 um").run("calibrate").plot()
    assert [text.get_text() for text in one.get_legend().get_texts()] == ["model", "measured"]
    assert one.get_ylabel().startswith("stroke / ")


def test_zip_time_is_drawn_where_it_is():
    """In the unit of the axis."""
    result = zipact.Actuator(mesh__nodes=11, liquid__model="none", solver__end_time="100 ms").run("actuate")
    axes = result.plot()
    lines = [line.get_xdata() for line in axes.lines if len(line.get_xdata()) == 2]
    assert axes.get_xlabel().endswith("/ ms") and [1e3 * result["zip_time_s"]] * 2 in [list(x) for x in lines]


def test_draws_into_given_axes():
    _, axes = pyplot.subplots()
    assert zipact.Actuator(mesh__nodes=21).run("stationary").plot(axes) is axes


def test_draws_shapes_and_field():
    result = zipact.Actuator(mesh__nodes=21).run("profile")
    assert result.field.plot().collections
    assert len(result.shapes.plot().lines) == 2
