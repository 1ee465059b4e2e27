"""Stepping by hand."""

import copy
import pickle
import signal
import threading

import numpy as np
import pytest
import zipact
from zipact import _zipact

EXPLICIT = dict(solver__integrator="explicit", contact__model="sequential")
IMPLICIT = dict(solver__integrator="implicit", contact__model="unilateral")
both = pytest.mark.parametrize("integrator", [EXPLICIT, IMPLICIT], ids=["explicit", "implicit"])


def make(**keys):
    return zipact.Simulation(zipact.Actuator(**{"mesh__nodes": 21, "drive__voltage": 4e3} | keys))


def without_current(row):
    """It and the power are means over what lies between two readings: no state has them."""
    return np.delete(row, [list(zipact.SIGNALS).index(name) for name in ("current", "power")])


def test_one_step_is_the_study():
    simulation = make(**IMPLICIT)
    simulation.step(5e-3)
    series = simulation.actuator.replace(solver__end_time=5e-3).run().series
    np.testing.assert_array_equal(without_current(simulation.read()), without_current(series.values_2d[-1]))
    assert simulation.time == 5e-3 and simulation.steps > 0


@pytest.mark.parametrize(
    "keys, named",
    [
        (dict(contact__model="sequential"), "contact.model = sequential"),
        (dict(actuator__kind="flange", solver__integrator="explicit", electro__gap_offset="1 mm"), "flange"),
        (dict(insulator__thickness=0), "short circuit"),
    ],
)
def test_study_does_not_matter(keys, named):
    """What motion needs is checked by Simulation; a state is one of the actuator, whatever its study is."""
    resting = zipact.Actuator(study="stationary", mesh__nodes=21, **keys)
    with pytest.raises(zipact.InputError, match=named):
        zipact.Simulation(resting)
    one, other = make(study="stationary"), make()
    one.step("1 ms")
    other.restore(one.save())
    np.testing.assert_array_equal(without_current(one.read()), without_current(other.read()))


@pytest.mark.parametrize("dt", [0.37e-6, 1e-6, 2.3e-6, 33.3e-6])
def test_many_short_explicit_steps_are_one_long(dt):
    """A shorter step of the integrator at the end of each would make what vibrates fastest diverge."""
    simulation = make(**EXPLICIT)
    for _ in range(int(2e-3 / dt)):
        simulation.step(dt)
    once = make(**EXPLICIT)
    once.step(simulation.time)
    assert simulation["stroke"] == pytest.approx(once["stroke"], rel=5e-8)  # 8.5e-9 measured
    assert simulation["kinetic_energy"] == pytest.approx(once["kinetic_energy"], rel=5e-5)  # 1.6e-5 measured


@both
def test_zips(integrator):
    simulation = make(liquid__model="none", **integrator)
    while not np.isfinite(simulation.zip_time):
        simulation.step("1 ms", voltage="10 kV")
    assert 0.04 < simulation.zip_time <= simulation.time < 0.1
    assert np.isnan(simulation.closed_from) or simulation.closed_from >= simulation.zip_time
    simulation.step("50 ms")
    assert simulation["contraction"] > 0.99 and simulation.zip_time <= simulation.closed_from < simulation.time


@both
def test_state_goes_back_and_on_to_the_same_bits(integrator):
    simulation = make(**integrator)
    simulation.step(2e-3, 8e3)
    state = simulation.save()
    simulation.step(3e-3, 9e3)
    there = without_current(simulation.read())
    simulation.restore(state)
    assert simulation.time == 2e-3 and simulation["voltage"] == 8e3
    for other in (simulation, make(**integrator)):
        other.restore(state)
        other.step(3e-3, 9e3)
        np.testing.assert_array_equal(without_current(other.read()), there)


def test_pickle_and_copy_go_on_alike():
    simulation = make()
    simulation.step(1e-3, 8e3)
    for twin in (pickle.loads(pickle.dumps(simulation)), copy.copy(simulation), copy.deepcopy(simulation)):
        twin.step(1e-3)
        assert twin.time == 2e-3 and twin["voltage"] == 8e3
    assert simulation.time == 1e-3


def test_voltage_holds_and_waveform_drives_until_one_is_given():
    simulation = make(drive__waveform="ramp", drive__voltage=8e3, drive__rise_time="10 ms")
    simulation.step(5e-3)
    assert simulation["voltage"] == pytest.approx(4e3, rel=1e-12)  # 0 measured
    simulation.step(1e-3, 2e3)
    simulation.step(1e-3)
    assert simulation["voltage"] == 2e3


@pytest.mark.parametrize("by", ["text", "arrays"])
def test_driven_by_a_table(by):
    table = dict(drive__waveform="table", drive__table="0 ms = 0 kV, 10 ms = 8 kV")
    simulation = make(**(table if by == "text" else dict(drive=([0, 0.01], [0, 8e3]))))
    simulation.step(5e-3)
    assert simulation["voltage"] == pytest.approx(4e3, rel=1e-12)  # 0 measured


def test_read_fills_what_it_is_given():
    simulation = make()
    simulation.step(1e-3)
    out = np.full(len(zipact.SIGNALS), -1.0)
    assert simulation.read(out) is out
    assert out[list(zipact.SIGNALS).index("stroke")] == simulation["stroke"]


def test_current_is_the_mean_since_the_reading_before():
    simulation = make(**IMPLICIT)
    place = {name: i for i, name in enumerate(zipact.SIGNALS)}
    simulation.step(20e-3, 6e3)
    before = simulation.read()
    simulation.step(5e-3)
    after = simulation.read()
    charged = after[place["charge"]] - before[place["charge"]]
    assert after[place["current"]] == pytest.approx(charged / 5e-3, rel=1e-12)  # 1.3e-16 measured


def test_shape_is_a_copy():
    simulation = make()
    shape = simulation.shape()
    kept = shape.y.copy()
    simulation.step(20e-3, 10e3)
    np.testing.assert_array_equal(shape.y, kept)
    assert shape.x.shape == (21, 2) and shape.gap.shape == shape.line_force.shape == (21,)
    assert shape.insulator_field.shape == (21,) and shape.stress.shape == (21, 2)
    assert shape.stress.max() == make()["max_stress"]
    assert shape.gap[-1] == pytest.approx(make()["opening"], rel=1e-12)  # 0 measured


def test_control_asks_every_period():
    times = []

    def controller(simulation):
        times.append(simulation.time)
        return 1e3 * len(times)

    controlled, by_hand = make(**IMPLICIT), make(**IMPLICIT)
    controlled.control(controller, 1e-3, 4.5e-3)
    np.testing.assert_allclose(times, [0, 1e-3, 2e-3, 3e-3, 4e-3], atol=1e-15)
    for k in range(5):
        by_hand.step(1e-3 if k < 4 else 0.5e-3, voltage=1e3 * (k + 1))
    assert controlled.time == pytest.approx(4.5e-3, abs=1e-15)
    assert controlled["opening"] == pytest.approx(by_hand["opening"], rel=1e-12)
    times.clear()
    make(**IMPLICIT).control(controller, 1e-3, 2e-3 * (1 + 1e-13))  # what rounding leaves is no period
    assert len(times) == 2
    for period, end in ((0, 1), (-1, 1), (np.nan, 1), (1e-3, np.inf), (1e-3, 0)):
        with pytest.raises(zipact.InputError):
            controlled.control(controller, period, end)


def test_step_takes_its_arguments_in_any_order():
    first, second = make(), make()
    first.step(1e-3, 5e3)
    second.step(voltage=5e3, dt=1e-3)
    np.testing.assert_array_equal(first.read(), second.read())


def test_other_threads_are_refused_while_it_steps():
    simulation = make(**EXPLICIT)
    refused, done = [], threading.Event()

    def meddle():
        while not done.is_set():
            for use in (lambda: simulation["stroke"], lambda: simulation.step(1e-6), simulation.save, simulation.read):
                try:
                    use()
                except zipact.InputError as error:
                    refused.append(str(error))

    thread = threading.Thread(target=meddle)
    thread.start()
    for _ in range(20):
        try:
            simulation.step(10e-3)
        except zipact.InputError as error:
            refused.append(str(error))
    done.set()
    thread.join()
    assert refused and all("is already in a step" in text for text in refused)


def test_control_c_leaves_a_state_to_go_on_from():
    simulation = make(**EXPLICIT)
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    with pytest.raises(KeyboardInterrupt):
        timer.start()
        simulation.step(1e3)
    reached = simulation.time
    assert 0 < reached < 1e3 and simulation["time"] == reached
    simulation.step(1e-3)
    assert simulation.time == reached + 1e-3


def test_goes_on_from_a_checkpoint_of_a_study(tmp_path):
    first = make(**IMPLICIT).actuator.replace(solver__end_time="5 ms")
    first.run().save(tmp_path)
    second = first.replace(initial__state="checkpoint", initial__file=tmp_path / "checkpoint.zps")
    simulation = zipact.Simulation(second)
    start = simulation.time
    assert 0 < start <= 5e-3
    simulation.step(10e-3 - start)
    whole = first.replace(solver__end_time="10 ms").run()
    assert simulation["stroke"] == whole["stroke_m"]
    with pytest.raises(zipact.InputError, match="load.mass"):
        zipact.Simulation(second.replace(load__mass="9 g"))


def test_step_limit_and_divergence_are_numerics_errors():
    with pytest.raises(zipact.NumericsError, match="solver.max_steps"):
        make(solver__max_steps=3).step(1e-3)


@both
def test_inputs_with_a_rate(integrator):
    """A voltage could only jump. With a rate it is the ramp that the waveform is; a load does its work."""
    wave = make(drive__waveform="ramp", drive__voltage=8e3, drive__rise_time="4 ms", **integrator)
    hand = make(drive__voltage=8e3, **integrator)  # replaced before anything moves
    hand.set_input("voltage", 0.0, rate=8e3 / 4e-3)
    for simulation in (wave, hand):
        simulation.step(3e-3)
    for signal in ("voltage", "electric_work", "stroke"):
        assert hand[signal] == pytest.approx(wave[signal], rel=1e-12)  # 1.2e-14 measured
    opening = hand["opening"]
    hand.set_input("load", value=0.05)
    assert hand["load_work"] == 0
    twin = pickle.loads(pickle.dumps(hand))
    for simulation in (hand, twin):
        simulation.step(2e-3, voltage=1e3)  # ends the ramp
        simulation.step(1e-3)
        assert simulation["voltage"] == 1e3
        assert simulation["load_work"] == pytest.approx(0.05 * (simulation["opening"] - opening), rel=1e-12)  # 7.2e-16 measured
    np.testing.assert_array_equal(without_current(hand.read()), without_current(twin.read()))


def test_a_voltage_after_another_state_or_input_is_set():
    """A step with the voltage of the step before sets nothing, unless something else has changed it."""
    simulation = make()
    simulation.step(1e-4, 5e3)
    state = simulation.save()
    simulation.step(1e-4, 8e3)
    simulation.restore(state)
    assert simulation["voltage"] == 5e3
    simulation.step(1e-4, 8e3)
    assert simulation["voltage"] == 8e3
    simulation.set_input("voltage", 2e3)
    simulation.step(1e-4, 8e3)
    assert simulation["voltage"] == 8e3


def test_steps_of_all_calls_are_counted():
    simulation = make(solver__time_step="100 us")
    for calls in (1, 2, 3):
        simulation.step(1e-3)
        assert simulation.steps == 10 * calls


def test_frame_of_the_library():
    """One frame: the arrays of pairs of nodes have one row, the others one column per ribbon, and all are of this instant."""
    simulation = make()
    simulation.step(5e-3, 8e3)
    frame, shape = _zipact.Simulation.shape(simulation), simulation.shape()
    assert [np.asarray(view).shape for view in frame[1:]] == [(21, 2), (21, 2), (1, 21), (1, 21), (1, 21), (21, 2)]
    np.testing.assert_allclose(shape.y[:, 0] - shape.y[:, 1], shape.gap, rtol=0, atol=1e-15)
    assert shape.stress.max() == simulation["max_stress"] and shape.insulator_field.max() == simulation["insulator_field"]


def test_shape_is_the_last_of_the_study():
    keys = dict(mesh__nodes=11, drive__voltage=4e3, solver__time_step="100 us", solver__end_time="5 ms")
    shapes = zipact.Actuator(**keys).run("actuate").shapes
    simulation = zipact.Simulation(zipact.Actuator(**keys))
    simulation.step(5e-3)
    assert simulation.steps == 50 and shapes.time[-1] == simulation.time == 5e-3
    for name in ("zipped", "x", "y", "gap", "line_force", "insulator_field", "stress"):
        np.testing.assert_array_equal(getattr(simulation.shape(), name), getattr(shapes, name)[-1], name)


def test_diverged_simulation_is_used_up():
    wild = make(**EXPLICIT, electro__breakdown_cap=False, electro__force_scale=1000)
    state = wild.save()
    for words in ("diverged", "has diverged; restore a state"):
        with pytest.raises(zipact.NumericsError, match=words):
            wild.step(0.1, 1e6)
    wild.restore(state)
    wild.step(1e-6, 0.0)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("mass", 1.0), "mass: unknown input; use voltage or load"),
        (("load", 2e4), "load = 20000 N is out of range"),
        (("voltage", -1.0), "drive.voltage"),
        (("voltage", 1.0, float("nan")), "a rate of nan V/s is out of range"),
    ],
)
def test_wrong_inputs(arguments, words):
    with pytest.raises(zipact.InputError, match=words):
        make().set_input(*arguments)
