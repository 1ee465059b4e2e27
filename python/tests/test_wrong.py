"""What is wrong ends in an exception with the library's message, never in a crash: hundreds of attempts."""

import numpy as np
import pytest
import zipact
from zipact import _zipact

NO_NUMBERS = [None, [], [1, 2], (), {}, object(), b"1 g", 1j, np.ones(3), np.array("x"), True]
NO_FINITE_NUMBERS = [float("nan"), float("inf"), -float("inf"), 10**400]
NO_DECIMALS = ["", " ", "g", "1 0 g", "0x10", "nan", "1e999", "1\0", "\ud800", "1 g" * 1000, "8 g; rm", "ü", "2 µg µg"]
ODD_VALUES = NO_NUMBERS + NO_FINITE_NUMBERS + NO_DECIMALS


class Liar:
    """A number that is none."""

    def __float__(self):
        raise RuntimeError("no")

    def __str__(self):
        return "a liar"


def wrong_value(key):
    if key.kind in ("real", "real or auto", "int"):
        return [key.max * 2 + 1, key.min - 1, "1 parsec5", "many"]
    return {"bool": [7, "perhaps"], "word": [0, "no such word"], "text": [7, "x" * 256, "\n"]}[key.kind]


WRONG_DRIVES = [
    3,
    (),
    ([0, 1],),
    ([0, 1], [1]),
    ([1, 0], [1, 2]),
    ([-1, 1], [1, 2]),
    ([0, float("nan")], [1, 2]),
    ([0, 1], [1, 1e300]),
    ([0, 1], [None, 1]),
    ([0, 1], ["a", "b"]),
    (np.eye(2), np.eye(2)),
]


def wrong_actuators():
    for key in zipact.KEYS.values():
        yield from ({key.name: value} for value in wrong_value(key))
        yield {key.name + "x": 1}
    for value in [*ODD_VALUES, Liar()]:
        yield {"load.mass": value}
        if value is not True:
            yield {"electro.edges": value}
    for value in ODD_VALUES:
        yield {"study": value}
        yield {"mesh.nodes": value if value is not True else 2.5}
    yield from ({"drive": drive} for drive in WRONG_DRIVES)
    yield {"drive": ([0, 1], [1, 2]), "drive.waveform": "ramp"}
    yield {"drive": ([0, 1], [1, 2]), "initial.state": "checkpoint", "initial.file": "some.zps"}
    yield {"": 1}
    yield {"load": 1}
    yield {"\ud800": 1}
    yield {"platform.length": 1}


def short(value):
    return ascii(value)[:50]


@pytest.mark.parametrize("keys", list(wrong_actuators()), ids=short)
def test_wrong_actuator(keys):
    with pytest.raises(zipact.InputError) as caught:
        actuator = zipact.Actuator(**keys)
        if "drive" in keys:
            actuator.run()
    assert len(str(caught.value)) > 10


def test_wrong_rows_of_a_drive_are_counted_from_one():
    with pytest.raises(zipact.InputError, match="^drive: row 3: "):
        zipact.Actuator(drive=([0, 1, 0.5], [0, 1, 2])).run()


def test_arrays_do_not_go_on_from_a_checkpoint():
    with pytest.raises(zipact.InputError, match="^initial.state = checkpoint: requires drive.table or drive.file instead of arrays"):
        zipact.Actuator(drive=([0, 1], [1, 2]), initial__state="checkpoint", initial__file="some.zps").run()


@pytest.fixture
def simulation():
    made = zipact.Simulation(zipact.Actuator(mesh__nodes=21))
    made.step(1e-4)
    return made


@pytest.mark.parametrize("dt", [-1, -1e-3, 0, 0.0, 1e300, "-1 ms", "1 kg", "1 ms s", *ODD_VALUES], ids=short)
def test_wrong_step(simulation, dt):
    with pytest.raises(zipact.InputError, match="^dt"):
        simulation.step(dt)
    assert simulation.time == 1e-4


@pytest.mark.parametrize("voltage", [-1, 1e7, "5 kg", *ODD_VALUES[1:]], ids=short)  # None: as it was
def test_wrong_voltage(simulation, voltage):
    with pytest.raises(zipact.InputError, match=r"^(drive\.)?voltage"):
        simulation.step(1e-3, voltage)
    assert simulation.time == 1e-4


def test_wrong_arguments_of_step(simulation):
    with pytest.raises(zipact.InputError, match="^dt: missing"):
        simulation.step()
    for arguments, keywords in (
        ((1e-3, 1, 2), {}),
        ((1e-3,), {"dt": 1}),
        ((1e-3,), {"volts": 1}),
        ((1e-3, 1), {"voltage": 2}),
    ):
        with pytest.raises(TypeError, match="step takes dt and voltage"):
            simulation.step(*arguments, **keywords)


SIGNALS = len(zipact.SIGNALS)
WRONG_OUTS = [
    3,
    "x",
    b"x" * 8 * SIGNALS,
    [0.0] * SIGNALS,
    np.zeros(3),
    np.zeros(SIGNALS, "f4"),
    np.zeros(SIGNALS, object),
    np.zeros((SIGNALS, 1)),
    np.zeros(2 * SIGNALS)[::2],
    np.broadcast_to(0.0, SIGNALS),
]


@pytest.mark.parametrize("out", WRONG_OUTS, ids=short)
def test_wrong_out(simulation, out):
    with pytest.raises(zipact.InputError, match="^out"):
        simulation.read(out)


@pytest.mark.parametrize("name", ["", "strok", "stroke_m", 3, None, "\ud800", "x\0"], ids=ascii)
def test_wrong_signal(simulation, name):
    with pytest.raises(zipact.InputError, match="unknown signal; (did you mean stroke|the signals are time, voltage, stroke)"):
        simulation[name]


def test_wrong_states(simulation):
    state = simulation.save()
    no_states = (None, "text", bytearray(state), b"", b"zipact1", bytes(len(state)))
    for wrong in (*no_states, state[:-1], state + b"x", state[::-1]):
        with pytest.raises(zipact.InputError, match="^state: "):
            simulation.restore(wrong)
    for place in range(0, len(state), 97):
        damaged = bytearray(state)
        damaged[place] ^= 0x40
        with pytest.raises(zipact.InputError, match="^state: "):
            simulation.restore(bytes(damaged))
    simulation.restore(state)


@pytest.mark.parametrize("keys", [dict(mesh__nodes=61), dict(load__mass="9 g"), dict(electro__model="field")], ids=str)
def test_state_of_another_actuator(simulation, keys):
    other = zipact.Simulation(simulation.actuator.replace(**keys))
    name = next(iter(keys)).replace("__", ".")
    with pytest.raises(zipact.InputError, match=f"^state: of another model: {name} is .* there, .* here"):
        other.restore(simulation.save())


def test_used_up_by_divergence():
    wild = dict(solver__integrator="explicit", contact__model="sequential", electro__breakdown_cap=False)
    simulation = zipact.Simulation(zipact.Actuator(mesh__nodes=21, electro__force_scale=1000, **wild))
    state = simulation.save()
    with pytest.raises(zipact.NumericsError, match="^diverged"):
        simulation.step(0.1, "1000 kV")
    with pytest.raises(zipact.NumericsError, match="has diverged; restore a state"):
        simulation.step(1e-3)
    simulation.read(), simulation.shape(), simulation.save()  # of no use, but no harm
    simulation.restore(state)
    simulation.step(1e-6, 0.0)


@pytest.mark.parametrize("thing", [None, 3, "actuator", zipact.Actuator, {}], ids=str)
def test_not_an_actuator(thing):
    with pytest.raises(zipact.InputError, match="takes an Actuator"):
        zipact.Simulation(thing)
    with pytest.raises(zipact.InputError, match="takes actuators or networks"):
        zipact.run_batch([thing])


@pytest.mark.parametrize("workers", [0, -1, 1.5, "2"])
def test_wrong_workers(workers):
    with pytest.raises(zipact.InputError, match="workers"):
        zipact.run_batch([zipact.Actuator()], workers=workers)


def test_motion_of_what_does_not_move():
    for study in ("stationary", "modes"):
        keys = dict(study="stationary", solver__integrator="implicit", contact__model="sequential")
        with pytest.raises(zipact.InputError, match="contact.model"):
            zipact.Simulation(zipact.Actuator(**keys | dict(study=study)))


@pytest.mark.parametrize("study", ["calibrate", "fly", "", 3])
def test_study_that_cannot_run(study):
    with pytest.raises(zipact.InputError):
        zipact.Actuator().run(study)


@pytest.mark.parametrize("path", ["none.yaml", ".", "", "\0", "\ud800"], ids=ascii)
def test_wrong_scenario(path):
    with pytest.raises(zipact.Error):
        zipact.read_scenario(path)


FAULTS = ["load.mass: 3 V", "load.mas: 1", "{", "study: [1]", "\0", "mesh.nodes: [1, 2]", "a: &a *a"]


@pytest.mark.parametrize("text", FAULTS, ids=short)
def test_scenario_with_faults(tmp_path, text):
    (tmp_path / "wrong.yaml").write_text(text)
    with pytest.raises(zipact.InputError, match="wrong.yaml"):
        zipact.read_scenario(tmp_path / "wrong.yaml")


@pytest.mark.parametrize("name", ["stroke", "", 3, None], ids=ascii)
def test_wrong_names_in_results(name):
    result = zipact.Actuator(mesh__nodes=21).run("stationary")
    with pytest.raises(zipact.InputError, match="its numbers are stroke_m"):
        result[name]
    with pytest.raises(zipact.InputError, match="the columns are station"):
        result.series[name]


def test_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("")
    result = zipact.Actuator(mesh__nodes=21).run("stationary")
    with pytest.raises((zipact.Error, OSError)):
        result.save(tmp_path / "file" / "folder")


def test_objects_cannot_be_made_half():
    for make in (
        _zipact.Result,
        _zipact.View,
        _zipact.Definition,
        _zipact.Simulation,
        lambda: _zipact.Definition({}, 3),
        lambda: _zipact.Definition([]),
        lambda: _zipact.Simulation({}),
        lambda: object.__new__(zipact.Simulation),
        lambda: zipact.Simulation.__new__(zipact.Simulation),
        lambda: _zipact.Simulation.__new__(dict),
    ):
        with pytest.raises(TypeError):
            make()


def test_results_are_read_only():
    result = zipact.Actuator(mesh__nodes=21).run("stationary")
    with pytest.raises(ValueError, match="read-only"):
        result.series["x_m"][0] = 1
    with pytest.raises(ValueError):
        result.series["x_m"].flags.writeable = True
