"""Actuators in series, unlike ones side by side, antagonists, and one whose clip is held."""

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
    assert rest["opening_m"] + rest["lower_opening_m"] == pytest.approx(0.02, rel=1e-12)  # 1.7e-16 measured
    assert rest["stiffness_N_per_m"] > 0


def test_an_antagonist_closes_and_opens_again():
    path = make("equilibrium", ANTAGONISTS, drive__voltage="5 kV").run()
    assert 0 < path["release_voltage_V"] < path["pull_in_voltage_V"] <= path["closing_voltage_V"] < 5e3
    openings = path.series["opening_m"] + path.series["lower_opening_m"]
    np.testing.assert_allclose(openings, 0.02, rtol=1e-12)  # 1.7e-16 measured


def test_limits_and_modes_of_antagonists():
    limits = make("limits", ANTAGONISTS, drive__voltage="5 kV").run()
    path = make("equilibrium", ANTAGONISTS, drive__voltage="5 kV").run()
    assert limits["pull_in_voltage_V"] == pytest.approx(path["pull_in_voltage_V"], rel=1e-12)  # 0 measured
    np.testing.assert_allclose(limits.series["opening_m"] + limits.series["lower_opening_m"], 0.02, rtol=1e-12)  # 1.7e-16 measured
    still, near = make("modes", ANTAGONISTS).run(), make("modes", ANTAGONISTS, modes__voltage=0.99 * path["pull_in_voltage_V"]).run()
    assert 0 < near["frequency_1_Hz"] < still["frequency_1_Hz"]


def test_unlike_members_share_their_load():
    keys = {"stack__parallel": 3, "load__mass": "12 g", "member_2__ribbon__thickness": "80 um"}
    rest = make("stationary", keys).run()
    forces = [rest[f"member_{k}_force_N"] for k in (1, 2, 3)]
    assert sum(forces) == pytest.approx(12e-3 * 9.81, rel=2e-10) and forces[1] > 2 * forces[0]  # 3e-11 measured
    assert make("modes", keys).run()["frequency_1_Hz"] > make("modes", keys, member_2__ribbon__thickness="50 um").run()["frequency_1_Hz"]


def test_a_held_clip_tilts_the_platform_to_the_other_side():
    keys = {"actuator__symmetry": "none", "platform__rotates": True, "platform__electrode": False}
    left, right = (make("stationary", keys, actuator__held_clip=clip).run() for clip in ("left", "right"))
    assert left["angle_rad"] == pytest.approx(-right["angle_rad"], rel=1e-12) and left["angle_rad"] != 0  # 0 measured
    assert left["opening_m"] == pytest.approx(right["opening_m"], rel=1e-12)  # 0 measured


def test_a_series_closes_step_by_step():
    path = make("equilibrium", SERIES, drive__voltage="8 kV").run()
    stable = path.series["stable"] == 1
    assert list(np.unique(path.series["closed_members"][stable])) == [0, 1, 2, 3]
    openings = sum(path.series[f"member_{k}_opening_m"] for k in (1, 2, 3))
    np.testing.assert_allclose(openings, path.series["opening_m"], rtol=1e-12)


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


def test_members_that_are_given_are_keys():
    """Beyond the keys of every actuator those of members that are given, where the command writes them."""
    stack = make("stationary", {"stack__series": 12, "member_12__ribbon__thickness": "60 um"})
    names = list(stack)
    assert len(stack) == len(names) == len(make("stationary", {"stack__series": 12})) + 1
    assert names[names.index("member_12.ribbon.thickness") + 1] == "gravity"
    assert stack["member_12.ribbon.thickness"] == 60e-6 and stack["member_3.ribbon.thickness"] == "auto"
    assert "member_3.ribbon.thickness" in stack and "member_K.ribbon.thickness" not in stack
    assert zipact.KEYS["member_12.ribbon.thickness"].unit == "m"
    batch = zipact.run_batch(stack.sweep(member_7__ribbon__thickness=["50 um", "70 um"]))
    assert batch.varied == ["member_7.ribbon.thickness"] and batch["opening_m"][0] > batch["opening_m"][1]


def test_words_of_members_print_and_read_back(tmp_path):
    stack = zipact.Actuator(stack__parallel=2, member_2__drive__waveform="ramp", member_2__drive__rise_time="1 ms")
    assert eval(repr(stack), vars(zipact)) == stack
    (tmp_path / "scenario.yaml").write_text(stack.scenario())
    assert zipact.read_scenario(tmp_path / "scenario.yaml") == stack
