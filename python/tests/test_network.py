"""Networks: dicts of bodies, members and springs, which give the command's numbers."""

import copy
import json
import os
import pickle
import subprocess

import numpy as np
import pytest
import zipact

EXAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "examples")
SHORT = dict(mesh__nodes=11, solver__end_time="10 ms")


def example():
    """examples/network.yaml, by hand."""
    network = zipact.Network(study="actuate", drive__voltage="10 kV", solver={"end_time": 0.4, "stop_when_zipped": False})
    network.bodies.update(bar={"mass": "4 g"}, left_hand={"mass": 6e-3}, right_hand={"mass": "8 g"})
    network.members["lift_1"] = {"upper": "frame", "lower": "bar"}
    network.members["lift_2"] = {"upper": "frame", "lower": "bar", "ribbon": {"thickness": np.float64(60e-6)}}
    network.members["left"] = {"upper": "bar", "lower": "left_hand"}
    network.members["right"] = {"upper": "bar", "lower": "right_hand", "drive.voltage": "8 kV"}
    network.springs["rope"] = {"between": ["frame", "bar"], "stiffness": "2 N/m", "rest": "15 mm", "kind": "pull"}
    return network


def hand(**keys):
    network = zipact.Network(**SHORT, **keys)
    network.bodies["hand"] = {"mass": "20 g"}
    network.members["left"] = {"upper": "frame", "lower": "hand"}
    return network


def joint(**keys):
    """examples/joint.yaml, by hand."""
    network = zipact.Network(study="actuate", damping__drag="0.02 N s2/m2", solver__stop_when_zipped=False, output__shapes=200)
    network["mesh.nodes"], network["output.animation"] = 31, True
    network.bodies["forearm"] = {"moves": "plane", "mass": "12 g", "inertia": "2000 g mm2", "at": [0, "-8 mm"]}
    network.joints["pivot"] = {"type": "pin", "between": ["frame", "forearm"], "at": [0, "6 mm"]}
    follow = {"kind": "pi", "signal": "angle", "proportional": "80 kV/rad", "integral": "2000 kV/rad/s"}
    moves = {"waveform": "square", "value": "2 degree", "offset": "-2 degree", "frequency": "1 Hz", "rise_time": "100 ms"}
    for name, x in {"left": "-60 mm", "right": "60 mm"}.items():
        network.members[name] = {"upper": "frame", "lower": "forearm", "upper_at": [x, 0], "lower_at": [x, 0],
                                 "drive.voltage": "8 kV", "control": follow, "setpoint": moves}
    return network.replace(keys)


def assert_same(one, other):
    assert one.outcome == other.outcome and list(one.series) == list(other.series)
    np.testing.assert_array_equal(one.series.values_2d, other.series.values_2d)
    np.testing.assert_array_equal(*([of[name] for name in of if name not in of.timings] for of in (one, other)))


@pytest.mark.parametrize("study", ["actuate", "stationary", "modes"])
def test_same_bits_as_the_file(study):
    read = zipact.read_scenario(os.path.join(EXAMPLES, "network.yaml"))
    assert isinstance(read, zipact.Network)
    assert_same(read.run(study, **SHORT), example().run(study, **SHORT))


def test_joints():
    read = zipact.read_scenario(os.path.join(EXAMPLES, "joint.yaml"))
    ours = joint().run(**SHORT)
    assert_same(read.run(**SHORT), ours)
    assert ours.bodies["forearm"]["angle_rad"] == ours.series["forearm.angle_rad"][-1] != 0
    assert list(read.joints) == ["pivot"] and read["joints.pivot.type"] == "pin"
    slid = joint(**{"joints.pivot.type": "slide"})
    assert slid.joints["pivot"]["type"] == "slide" and slid != joint()


def test_same_bits_as_the_command(tmp_path):
    network = example().replace(SHORT)
    path = tmp_path / "network.yaml"
    path.write_text(network.scenario())
    subprocess.run([os.environ["ZIPACT_COMMAND"], "run", path, "-o", tmp_path, "--no-plots", "--quiet"], check=True)
    theirs, ours = json.loads((tmp_path / "summary.json").read_text()), network.run()
    assert theirs["bodies"] == ours.bodies and theirs["members"]["left"]["opening_m"] == ours.members["left"]["opening_m"]
    ours.save(tmp_path / "ours")
    assert (tmp_path / "ours" / "table.csv").read_bytes() == (tmp_path / "table.csv").read_bytes()
    assert_same(zipact.read_scenario(tmp_path / "ours" / "scenario.yaml").run(), ours)


@pytest.mark.parametrize("name", ["network", "ports"])
def test_what_is_read_reads_back(name, tmp_path):
    read = zipact.read_scenario(os.path.join(EXAMPLES, f"{name}.yaml"))
    path = tmp_path / "scenario.yaml"
    path.write_text(read.scenario())
    assert zipact.read_scenario(path) == read


def test_some_names_of_a_file_may_be_numbers(tmp_path):
    path = tmp_path / "scenario.yaml"
    named = "members: {a: {upper: frame, lower: 2}}\nbodies: {h: {mass: 2 g}}\n"
    path.write_text(named + "mesh.nodes: 11\nbody_2: {mass: 3 g}\nmember_2: {upper: 2, lower: h}\n")
    read = zipact.read_scenario(path)
    assert read.members["a"] == {"upper": "frame", "lower": "2"} and read["member_2.upper"] == 2
    assert list(read.run("stationary").members) == ["a", "member_2"]
    path.write_text("stack.parallel: 2\nmembers: {b: {ribbon.thickness: 50 um}, a: {ribbon.thickness: 60 um}}\n")
    assert isinstance(zipact.read_scenario(path), zipact.Actuator)


def test_cases_of_a_file(tmp_path):
    path = tmp_path / "scenario.yaml"
    network = hand(drive__voltage=[8e3, 9e3])
    network.members["left"] |= {"port": "supply", "drive.waveform": "ramp", "drive.rise_time": 1e-3}
    network.members["left"]["ribbon.thickness"] = ["50 um", "60 um"]
    path.write_text(network.scenario())
    cases = zipact.read_scenario(path)
    assert [case["members.left.ribbon.thickness"] for case in cases] == [50e-6, 50e-6, 60e-6, 60e-6]
    assert {(case.members["left"]["port"], case.members["left"]["upper"]) for case in cases} == {("supply", "frame")}
    assert cases[0].replace(drive__voltage=9e3, members__left__ribbon__thickness=60e-6) == cases[3]
    with pytest.raises(zipact.InputError, match="takes one value for each key"):
        network.run()


def test_dicts():
    network = example()
    assert list(network.members) == ["lift_1", "lift_2", "left", "right"] and len(network.bodies) == 3
    assert "rope" in network.springs and "left" not in network.bodies and "drive__voltage" in network
    assert network["drive.voltage"] == network["drive__voltage"] == "10 kV" and network["members.lift_2.ribbon.thickness"] == 60e-6
    right = network.members["right"]
    assert dict(right) == {"upper": "bar", "lower": "right_hand", "drive.voltage": "8 kV"}
    right["drive"] = {"voltage": 7e3, "delay": "1 ms"}
    assert right["drive__voltage"] == 7e3 and "drive.delay" in right
    del right["drive__delay"], right["drive.voltage"], network.springs["rope"], network["study"], network["members.left"]
    assert len(right) == 2 and not network.springs and "study" not in network and "left" not in network.members
    network["members.more.upper"] = "bar"
    assert network.members["more"] == {"upper": "bar"} and network["members.more"] == {"upper": "bar"}
    with pytest.raises(KeyError):
        network.members["nobody"]
    with pytest.raises(KeyError):
        network["members.nobody.upper"]


def test_all_of_a_network_at_once():
    groups = {"bodies": {"hand": {"mass": "20 g"}}, "members": {"left": {"upper": "frame", "lower": "hand"}}}
    network = hand()
    assert zipact.Network(groups, **SHORT) == network == zipact.Network(dict(network))
    assert dict(network) == {"mesh.nodes": 11, "solver.end_time": "10 ms", "bodies.hand.mass": "20 g", "members.left.upper": "frame", "members.left.lower": "hand"}
    assert len(network) == 5


def test_copied_printed_pickled():
    network = example()
    for twin in (network.copy(), copy.deepcopy(network), pickle.loads(pickle.dumps(network)), eval(repr(network), vars(zipact))):
        assert twin == network and twin.scenario() == network.scenario()
        twin.members["left"]["ribbon.thickness"] = 50e-6
        twin.springs["rope"]["between"][0] = "left_hand"
        assert twin != network
    assert network == example() and network != "a network"


def test_results():
    network = hand(drive__voltage="10 kV")
    result = network.run()
    network.members["left"]["ribbon.thickness"] = "50 um"
    assert "ribbon.thickness" not in result.actuator.members["left"]
    assert result.members["left"]["opening_m"] == result["members.left.opening_m"] == -result.bodies["hand"]["y_m"]
    assert result.series["hand.y_m"][-1] == result.bodies["hand"]["y_m"] and result.units["bodies.hand.y_m"] == "m"
    twin = pickle.loads(pickle.dumps(result))
    assert twin.bodies == result.bodies and list(twin.members["left"]) == list(result.members["left"])
    assert twin.actuator == result.actuator
    assert zipact.Actuator(mesh__nodes=11).run("stationary").members == {}


def test_a_mount_a_force_and_a_body_without_mass():
    network = hand()
    network.bodies["floor"] = {"at": [0, "-60 mm"], "moves": "none"}
    network.bodies["middle"] = {}
    network.bodies["hand"]["force"] = [0, "-20 mN"]
    network.members["down"] = {"upper": "floor", "lower": "middle", "angle": "180 degree"}
    network.springs["link"] = {"between": ["middle", "hand"], "stiffness": 20, "rest": "2 mm"}
    assert network.run("stationary").good
    assert network.run("stationary").bodies["hand"]["y_m"] < hand().run("stationary").bodies["hand"]["y_m"] - 1e-4


WRONG = {
    "members.left.ribon.thickness: unknown key; did you mean members.left.ribbon.thickness?": ("members.left.ribon.thickness", 1),
    'members.left.ribbon.thickness = "3 V": not a length': ("members.left.ribbon.thickness", "3 V"),
    'members.left.ribbon.thickness = "-1": taken as -1 m, which is out of range': ("members.left.ribbon.thickness", -1),
    'members.left.ribbon.thickness = "NaN": not a number': ("members.left.ribbon.thickness", float("nan")),
    'members.left.ribbon.thickness = "<object': ("members.left.ribbon.thickness", object()),
    "members.left.ribbon.thickness: value with a zero byte": ("members.left.ribbon.thickness", "1\0"),
    "scenario: not a text": ("members.left.ribbon.thickness", "\ud800"),
    "members.left.upper = nobody: there is no such body": ("members.left.upper", "nobody"),
    "members.left.upper: takes one name, not a list": ("members.left.upper", ["frame"]),
    "members.left.drive: a group of keys cannot have a value": ("members.left.drive", 3),
    "members.left.mass: unknown key; members.left has upper, lower": ("members.left.mass", 1),
    'members.Left: "Left" is no name': ("members.Left", {}),
    "members.hand: hand is a name in bodies already": ("members.hand", {}),
    "members.frame: frame is the body that always exists": ("members.frame", {}),
    "bodies.free: nothing holds it": ("bodies.free", {}),
    "bodies.hand.force: the first value, to the right, must be 0": ("bodies.hand.force", [1, 0]),
    "springs.rope.between: takes two values": ("springs.rope.between", ["frame"]),
    "springs.rope.between: nobody is not given in bodies": ("springs.rope", {"between": ["frame", "nobody"], "stiffness": 1}),
    "left: takes a dict": ("members.left", 3),
    "members: takes a dict": ("members", 3),
    "load.mas: unknown key; did you mean load.mass?": ("load.mas", 1),
    "load.mass: 1?x: unknown key": ("load.mass: 1\nx", 1),
    "drive: a list holds values only": ("drive", ([0, 1], [0, 1])),
    "3: not the name of a key": (3, 1),
    'study = "fly": not one of': ("study", "fly"),
}


@pytest.mark.parametrize("message", WRONG)
def test_what_is_wrong(message):
    network = hand()
    with pytest.raises(zipact.InputError) as caught:
        network[WRONG[message][0]] = WRONG[message][1]
        network.run()
    assert str(caught.value).startswith(message)


def test_what_is_missing():
    network = hand()
    del network.members["left"]
    with pytest.raises(zipact.InputError, match="^members: missing"):
        network.run()
    network.members["left"] = {"upper": "frame", "lower": "hand"}
    network.bodies.clear()
    with pytest.raises(zipact.InputError, match="^bodies: missing"):
        network.run()
    with pytest.raises(zipact.InputError, match="^3: takes a dict"):
        network.members[3] = {}


@pytest.mark.parametrize("study", ["actuate", "cycle", "stationary", "equilibrium", "limits", "isometric", "modes"])
def test_draws(study):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    network = hand(isometric__body="hand", drive={"voltage": "4 kV", "waveform": "sine"}, liquid__model="none")
    network.bodies["other"] = {"mass": "10 g"}
    network.members["right"] = {"upper": "hand", "lower": "other"}
    result = network.run(study)
    axes = result.plot()
    assert axes.lines and study in axes.get_title()
    if study in ("actuate", "cycle"):
        shown = [text.get_text() for text in axes.get_legend().get_texts()]
        assert shown == ["hand, height", "other, height", "left, opening", "right, opening"]
    if study == "stationary":
        assert [len(line.get_xdata()) for line in axes.lines] == [11] * 4  # two ribbons of each member
    pyplot.close("all")
