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
    with pytest.raises(zipact.InputError, match="takes one value for each key; use sweep and run_batch"):
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


def test_derivatives_have_the_names_of_the_scenario():
    network = hand(sensitivity__by="members.left.ribbon.thickness, bodies.hand.mass, gravity")
    network.members["left"]["ribbon.thickness"] = "90 um"
    result = network.run()
    names = ["members.left.ribbon.thickness", "bodies.hand.mass", "gravity"]
    assert list(result.sensitivity["source_energy_J"]) == list(result.sensitivity["members.left.opening_m"]) == names
    at, by = result["bodies.hand.y_m"], result.sensitivity["bodies.hand.y_m"]["members.left.ribbon.thickness"]
    network.members["left"]["ribbon.thickness"] = 90.01e-6
    assert network.run()["bodies.hand.y_m"] - at == pytest.approx(by * 1e-8, rel=1e-2)
    assert pickle.loads(pickle.dumps(result)).sensitivity["bodies.hand.y_m"] == result.sensitivity["bodies.hand.y_m"]


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
        inside = joint(solver__end_time="5 ms", mesh__nodes=11).run().plot()
        assert [text.get_text() for text in inside.get_legend().get_texts()] == ["forearm, angle", "left, opening", "right, opening"]
    if study == "stationary":
        assert [len(line.get_xdata()) for line in axes.lines[:4]] == [22] * 4  # two whole ribbons of each member
    pyplot.close("all")


# -- by steps

WORDS = {"voltage": "V", "load": "N", "a.voltage": "V", "b.voltage": "V", "c.setpoint": "1", "thumb.force_y": "N", "finger.force_y": "N", "wrist.force_y": "N"}


def fingers(**keys):
    """examples/ports.yaml: three fingers, one on the common channel, one on its own, one held at a setpoint."""
    return zipact.read_scenario(os.path.join(EXAMPLES, "ports.yaml")).replace(mesh__nodes=11, **keys)


def without_means(simulation):
    """All signals but those that are means since the reading before."""
    return np.delete(simulation.read(), [list(simulation.signals).index(name) for name in ("current", "power")])


@pytest.mark.parametrize("network", [example(), joint()], ids=["up and down", "in the plane"])
def test_steps_are_the_study(network):
    network = network.replace(solver={"time_step": "100 us", "end_time": "4 ms"}, mesh__nodes=11)
    result, simulation = network.run("actuate"), zipact.Simulation(network)
    simulation.step(4e-3)
    means = [list(result.series).index(name) for name in ("current_A", "power_W")]
    np.testing.assert_array_equal(without_means(simulation), np.delete(result.series.values_2d[-1], means))
    for name, column in zip(simulation.signals, result.series, strict=True):
        if "." in name:
            assert simulation[name] == result.series[column][-1] and column.startswith(name + "_")
            assert simulation.signals[name].unit == result.series.units[column]
    np.testing.assert_array_equal(simulation.shape().x, result.shapes.x[-1])
    np.testing.assert_array_equal(simulation.shape().gap, result.shapes.gap[-1])


def test_inputs_by_name():
    simulation = zipact.Simulation(fingers())
    assert simulation.inputs == {name: unit for name, unit in WORDS.items() if name in ("voltage", "b.voltage", "c.setpoint") or "force" in name}
    at = simulation["wrist.y"]
    simulation.set_input("voltage", 2e3)
    simulation.set_input("b.voltage", 3e3, rate=1e5)
    simulation.set_input("wrist.force_y", "100 mN")
    simulation.step("10 ms")
    assert simulation["a.voltage"] == 2e3 and simulation["b.voltage"] == pytest.approx(4e3, rel=1e-12)  # 0 measured
    assert simulation["wrist.y"] > at + 1e-4 and simulation["load_work"] > 0
    free = zipact.Simulation(fingers())
    free.step("10 ms")
    assert free["wrist.y"] < simulation["wrist.y"]


def test_an_input_is_the_waveform():
    """A channel by hand gives the bits of its key."""
    keyed = zipact.Simulation(fingers(members__b__drive={"waveform": "step", "voltage": 4e3, "delay": 0}))
    by_hand = zipact.Simulation(fingers(members__b__drive={"waveform": "step", "voltage": 5e3, "delay": 0}))
    by_hand.set_input("b.voltage", 4e3)
    for simulation in (keyed, by_hand):
        simulation.step("5 ms")
    np.testing.assert_array_equal(without_means(keyed), without_means(by_hand))


def test_a_controller_of_channels():
    simulation, by_hand = zipact.Simulation(fingers()), zipact.Simulation(fingers())
    simulation.control(lambda now: {"voltage": 1e3 + 1e5 * now.time, "wrist.force_y": 0.01}, 1e-3, 3e-3)
    for _ in range(3):
        by_hand.set_input("voltage", 1e3 + 1e5 * by_hand.time)
        by_hand.set_input("wrist.force_y", 0.01)
        by_hand.step(1e-3)
    np.testing.assert_array_equal(without_means(simulation), without_means(by_hand))


def test_a_simulation_keeps_its_network():
    network = hand(drive__voltage="6 kV")
    simulation = zipact.Simulation(network)
    network.members["left"]["ribbon.thickness"] = "90 um"
    simulation.step("2 ms")
    for twin in (pickle.loads(pickle.dumps(simulation)), copy.copy(simulation)):
        assert twin.actuator == hand(drive__voltage="6 kV") and twin["hand.y"] == simulation["hand.y"]
        twin.step("1 ms")
        assert twin.time == 3e-3 and simulation.time == 2e-3
    out = np.empty(len(simulation.signals))
    assert simulation.read(out) is out and out[-1] == simulation["hand.y"]
    assert simulation.read(np.empty(len(zipact.SIGNALS)))[0] == 2e-3


def test_signals_of_a_stack():
    stack = zipact.Simulation(zipact.Actuator(stack__series=3, mesh__nodes=11, load__mass="6 g"))
    openings = [stack[f"member_{k}_opening"] for k in (1, 2, 3)]
    assert sum(openings) == pytest.approx(stack["opening"], rel=1e-12) and openings[0] > openings[2]
    assert stack.shape().x.shape == (33, 2) and stack.shape().stress.shape == (33, 2)
    assert list(zipact.Simulation(zipact.Actuator(mesh__nodes=11)).signals) == list(zipact.SIGNALS)


@pytest.mark.parametrize(
    "act, words",
    [
        (lambda s: s.set_input("b.volt", 1.0), "b.volt: unknown input; did you mean b.voltage?"),
        (lambda s: s.set_input("a.voltage", 1.0), "a.voltage: unknown input; did you mean b.voltage?"),
        (lambda s: s.set_input("load", 1.0), "load: the network has no such input; name the member or the body"),
        (lambda s: s.set_input("wrist.force_y", 1e5), "wrist.force_y = 100000 is out of range; -10000 to 10000"),
        (lambda s: s.set_input("b.voltage", -1.0), "drive.voltage = -1 V: must be at least 0 V"),
        (lambda s: s.set_input("b.voltage", "3 mm"), 'b.voltage = "3 mm": not a voltage'),
        (lambda s: s.set_input("c.setpoint", "3 mm"), "c.setpoint: takes a number"),
        (lambda s: s.set_input("wrist.force_y", None), "wrist.force_y: takes a number"),
        (lambda s: s.step(1e-3, voltage=1e3), "voltage: a controller sets that of a channel"),
        (lambda s: s["wrist.z"], "wrist.z: unknown signal; did you mean wrist.y?"),
        (lambda s: s.read(np.empty(3)), "out: takes an array of"),
        (lambda s: s.control(lambda _: {"nobody": 1.0}, 1e-3, 2e-3), "nobody: unknown input"),
        (lambda s: zipact.Simulation("wrist"), "Simulation: takes an Actuator or a Network, not str"),
    ],
)
def test_wrong_steps(act, words):
    with pytest.raises(zipact.InputError) as caught:
        act(zipact.Simulation(fingers()))
    assert str(caught.value).startswith(words)


# -- many


def test_many_networks(tmp_path):
    """The same table as the command's for a sweep, and the same bits as single runs."""
    network = example().replace(SHORT)
    lists = {"members.left.ribbon.thickness": ["50 um", "60 um"], "drive.voltage": ["8 kV", "9 kV"]}
    networks = network.sweep(lists)
    batch = zipact.run_batch(networks, workers=2)
    networks[0].members["left"]["ribbon.thickness"] = "90 um"
    assert set(batch.varied) == set(lists) and batch.units["members.left.ribbon.thickness"] == "m"
    for one, found in zip(network.sweep(lists), batch, strict=True):
        assert one == found.actuator
        assert_same(found, one.run())
    path = tmp_path / "network.yaml"
    path.write_text(network.replace(lists).scenario())
    subprocess.run([os.environ["ZIPACT_COMMAND"], "run", path, "-o", tmp_path, "--no-plots", "--quiet"], check=True)
    batch.save(tmp_path / "ours")
    theirs, ours = ((folder / "table.csv").read_text().splitlines() for folder in (tmp_path, tmp_path / "ours"))
    columns = [line[0].split(",") for line in (theirs, ours)]
    assert sorted(columns[0]) == sorted(columns[1])
    rows = [sorted(tuple(row.split(",")[of.index(name)] for name in columns[1]) for row in text[1:]) for text, of in zip((theirs, ours), columns)]
    assert [[float(a) for a in row if a not in ("end_time", "")] for row in rows[0]] == [[float(a) for a in row if a not in ("end_time", "", "nan")] for row in rows[1]]


def test_a_batch_of_networks_draws_and_tells_what_is_wrong():
    pytest.importorskip("pandas")
    good, bad = hand(study="stationary"), hand(study="stationary").replace(members__left__upper="nobody")
    batch = zipact.run_batch([good, bad, hand(study="stationary").replace(bodies__hand__mass="30 g")], return_exceptions=True)
    assert list(batch.errors) == [1] and str(batch.errors[1]).startswith("members.left.upper = nobody")
    assert batch.to_dataframe()["outcome"].tolist() == ["converged", "error", "converged"]
    whole = zipact.run_batch(good.sweep({"bodies.hand.mass": ["10 g", "20 g", "30 g"]}))
    axes = pytest.importorskip("matplotlib.pyplot") and whole.plot("bodies.hand.y_m")
    assert axes.get_xlabel() == "bodies.hand.mass / g" and list(axes.lines[0].get_xdata()) == [10, 20, 30]
    with pytest.raises(zipact.InputError, match="^members.left.ribbon.thickness: sweep takes a list"):
        good.sweep({"members.left.ribbon.thickness": "60 um"})
    with pytest.raises(zipact.InputError, match="takes actuators or networks, not dict"):
        zipact.run_batch([{}])
    assert zipact.KEYS["members.left.ribbon.thickness"].unit == "m" and "members.left.ribbon.thickness" not in zipact.Actuator()


# -- films


def test_a_film_has_the_shapes(tmp_path):
    pytest.importorskip("matplotlib")
    network = joint(solver__end_time="150 ms", mesh__nodes=11)
    network.springs["band"] = {"between": ["frame", "forearm"], "from_at": ["30 mm", 0], "to_at": ["30 mm", 0], "stiffness": 0.1, "rest": "8 mm"}
    result = network.run("actuate")
    film = result.animate(frames=5)
    assert 2 <= len(film.shown) <= 5 and film.shown[0] == 0 and film.shown[-1] == len(result.shapes.time) - 1
    lines = film.drawing.axes.lines
    for frame in film.shown:
        film._func(frame)
        for k, ribbon in enumerate((member, r) for member in range(2) for r in range(2)):
            nodes = slice(22 * ribbon[0], 22 * ribbon[0] + 22)  # both halves of a member
            np.testing.assert_array_equal(lines[k].get_xdata(), 1e3 * result.shapes.x[frame, nodes, ribbon[1]])
            np.testing.assert_array_equal(lines[k].get_ydata(), 1e3 * result.shapes.y[frame, nodes, ribbon[1]])
        assert film.drawing.axes.get_title().startswith(f"t = {1e3 * result.shapes.time[frame]:.1f} ms\n")
    # the platforms of members are where the ribbons end at them, and the pivot where it is given
    bars = {len(line.get_xdata()): line for line in lines if len(line.get_xdata()) == 1}
    assert len(bars) == 1 and bars[1].get_xdata()[0] == pytest.approx(0, abs=1e-3) and bars[1].get_ydata()[0] == pytest.approx(6, abs=1e-3)
    last, pairs = film.shown[-1], [np.array(line.get_data()).T for line in lines if len(line.get_xdata()) == 2]
    for k in range(2):
        for r in range(2):
            ends = 1e3 * np.stack([of[last, 22 * k + 10 : 22 * k + 12, r] for of in (result.shapes.x, result.shapes.y)], axis=-1)
            assert min(np.abs(pair - ends).max() for pair in pairs) < 3e-3, "a platform of the drawing"  # mm; bodies give way
    film.save(tmp_path / "film.gif", dpi=30)
    assert os.path.getsize(tmp_path / "film.gif") > 5000 and "<img" in result.animate(frames=2)._repr_html_()


@pytest.mark.parametrize("kind", ["tree", "series", "ribbon", "hinge", "whole"])
def test_films_of_other_kinds(kind):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    made = {
        "tree": lambda: zipact.read_scenario(os.path.join(EXAMPLES, "tree.yaml")).replace(SHORT),
        "series": lambda: zipact.Actuator(SHORT, stack__series=2),
        "ribbon": lambda: zipact.Actuator(SHORT, actuator__kind="ribbon"),
        "hinge": lambda: zipact.Actuator(SHORT, actuator__kind="hinge", hinge__stiffness=1e-3, liquid__model="none"),
        "whole": lambda: zipact.Actuator(SHORT, actuator__symmetry="none", platform__electrode=False, liquid__model="none"),
    }[kind]()
    result = made.run("actuate")
    film = result.animate()
    film._func(film.shown[-1])
    assert 1e3 * result.shapes.y[-1, 0, 0] in film.drawing.axes.lines[0].get_ydata()
    (left, right), (low, high) = film.drawing.axes.get_xlim(), film.drawing.axes.get_ylim()
    assert left < right and low <= 1e3 * result.shapes.y.min() and high >= 1e3 * result.shapes.y.max()
    pyplot.close("all")
    for wrong in (lambda: made.run("stationary").animate(), lambda: result.animate(frames=1)):
        with pytest.raises(zipact.InputError, match="animate takes|frames = 1"):
            wrong()
