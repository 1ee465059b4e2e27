"""Actuators in series and antagonists."""

import pickle

import numpy as np
import pytest
import zipact

ANTAGONISTS = dict(stack__series=2, stack__distance="20 mm", stack__voltage_ratio=0, load__mass="1 g")
SERIES = dict(stack__series=3, load__mass="6 g")
stacks = pytest.mark.parametrize("keys", [ANTAGONISTS, SERIES], ids=["antagonists", "series"])


def make(study, keys, **more):
    return zipact.Actuator(**{"study": study, "mesh__nodes": 21, "liquid__model": "none", "output__errors": False} | keys | more)


def test_antagonists_hold_their_load_between_them():
    rest = make("stationary", ANTAGONISTS).run()
    assert rest["opening_m"] + rest["lower_opening_m"] == pytest.approx(0.02, rel=1e-9)
    assert rest["stiffness_N_per_m"] > 0


def test_an_antagonist_closes_and_opens_again():
    path = make("equilibrium", ANTAGONISTS, drive__voltage="5 kV").run()
    assert 0 < path["release_voltage_V"] < path["pull_in_voltage_V"] <= path["closing_voltage_V"] < 5e3
    openings = path.series["opening_m"] + path.series["lower_opening_m"]
    np.testing.assert_allclose(openings, 0.02, rtol=1e-9)


def test_a_series_closes_step_by_step():
    path = make("equilibrium", SERIES, drive__voltage="8 kV").run()
    rises = path.series["branch"] == 0
    assert list(np.unique(path.series["closed_members"][rises])) == [0, 1, 2, 3]
    assert np.all(np.diff(path.series["opening_m"][rises]) < 1e-9)


def test_a_series_is_softer_than_one():
    one, three = make("modes", SERIES, stack__series=1).run(), make("modes", SERIES).run()
    assert three["frequency_1_Hz"] < one["frequency_1_Hz"]


@stacks
def test_states_go_on_to_the_same_bits(keys):
    simulation = zipact.Simulation(make("actuate", keys))
    simulation.step(2e-3, voltage=3e3)
    twin = pickle.loads(pickle.dumps(simulation))
    for one in (simulation, twin):
        one.step(2e-3, voltage=5e3)
    assert twin["opening"] == simulation["opening"] and twin["voltage"] == 5e3
