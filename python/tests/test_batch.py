"""Runs on all cores."""

import os
import pickle
import subprocess
import threading

import numpy as np
import pytest
import zipact
from zipact.actuator import column_name

VOLTAGES = np.linspace(3e3, 9e3, 13)

LONG = zipact.Actuator(
    solver__integrator="explicit", contact__model="sequential", drive__voltage=3e3, solver__end_time=1e3
)  # minutes


def sweep(**keys):
    return zipact.Actuator(mesh__nodes=21, **keys).sweep(drive__voltage=VOLTAGES)


def test_same_bits_as_one_by_one():
    motion = dict(solver__integrator="implicit", contact__model="unilateral", solver__end_time="20 ms")
    actuators = sweep(**motion)
    batch = zipact.run_batch(actuators, workers=4)
    assert [result.actuator for result in batch] == actuators
    for result, actuator in zip(batch, actuators, strict=True):
        alone = actuator.run()
        np.testing.assert_array_equal(result.series.values_2d, alone.series.values_2d)
        np.testing.assert_array_equal(result.shapes.y, alone.shapes.y)


def test_numbers_as_arrays():
    batch = zipact.run_batch(sweep(), "isometric")
    assert batch["force_N"].shape == VOLTAGES.shape and (np.diff(batch["force_N"]) > 0).all()
    assert isinstance(batch[2:4], zipact.Batch) and len(batch[2:4]) == 2
    with pytest.raises(zipact.InputError, match="not a number of study isometric"):
        batch["zip_time_s"]


def test_dataframe_has_the_keys_that_differ():
    pytest.importorskip("pandas")
    frame = zipact.run_batch(sweep(), "isometric").to_dataframe()
    np.testing.assert_array_equal(frame["drive.voltage"], VOLTAGES)
    assert list(frame.columns[:3]) == ["drive.voltage", "outcome", "force_N"]


def test_saves_the_table_of_the_command(tmp_path):
    keys = dict(mesh__nodes=21, output__errors=False, study="stationary")
    batch = zipact.run_batch(zipact.Actuator(**keys).sweep(load__mass=["8 g", "12 g"], drive__voltage=[1e3, 2e3]))
    batch.save(tmp_path / "mine")
    lists = ["load.mass=[8 g, 12 g]", "drive.voltage=[1 kV, 2 kV]", "mesh.nodes=21", "output.errors=false"]
    settings = [word for text in lists for word in ("--set", text)]
    subprocess.run([os.environ["ZIPACT_COMMAND"], "stationary", *settings, "--quiet", "-o", tmp_path / "command"], check=True)
    assert (tmp_path / "mine" / "table.csv").read_text() == (tmp_path / "command" / "table.csv").read_text()
    assert (tmp_path / "mine" / "run-3" / "scenario.yaml").exists()
    assert zipact.read_scenario(tmp_path / "mine" / "run-1" / "scenario.yaml") == batch.actuators[1]


def test_table_is_the_same_each_time(tmp_path):
    """Times of the machine are numbers of a result, and not in its files."""
    batch = zipact.run_batch(zipact.Actuator(mesh__nodes=9, solver__end_time="1 ms").sweep(load__mass=["8 g", "12 g"]), "actuate")
    batch.save(tmp_path)
    heading = (tmp_path / "table.csv").read_text().splitlines()[0].split(",")
    assert batch[0].timings and batch[0].timings.isdisjoint(heading) and "stroke_m" in heading


def test_headings_of_all_keys(tmp_path):
    keys = [key for key in zipact.KEYS.values() if key.kind in ("real", "real or auto") and key.unit != "1" and "_K." not in key.name]
    settings = [word for key in keys for word in ("--set", f"{key.name}=[{key.default}]")]
    command = [os.environ["ZIPACT_COMMAND"], "stationary", *settings, "--set", "mesh.nodes=11"]
    subprocess.run([*command, "--no-plots", "--quiet", "-o", tmp_path], check=True)
    heading = (tmp_path / "table.csv").read_text().splitlines()[0].split(",")
    assert heading[: heading.index("outcome")] == [column_name(key.name, key.unit) for key in keys]
    assert len(keys) > 60


def test_saves_errors(tmp_path):
    batch = zipact.run_batch(with_one_lost(tmp_path), return_exceptions=True)
    batch.save(tmp_path / "batch")
    rows = (tmp_path / "batch" / "table.csv").read_text().splitlines()
    assert rows[2].split(",")[-3:] == ["nan"] * 3 and ",error," in rows[2]
    assert not (tmp_path / "batch" / "run-1").exists()


def test_draws():
    pyplot = pytest.importorskip("matplotlib.pyplot")
    actuators = zipact.Actuator(mesh__nodes=21).sweep(load__mass=["8 g", "20 g"], drive__voltage=VOLTAGES)
    batch = zipact.run_batch(actuators, "isometric")
    axes = batch.plot()
    assert axes.get_xlabel() == "drive.voltage / kV" and axes.get_ylabel() == "force / mN"
    assert [line.get_label() for line in axes.lines] == ["8 g", "20 g"]
    np.testing.assert_allclose(axes.lines[1].get_xdata(), 1e-3 * VOLTAGES, rtol=1e-15)  # 0 measured
    np.testing.assert_allclose(axes.lines[1].get_ydata(), 1e3 * batch["force_N"][len(VOLTAGES) :], rtol=1e-15)  # 0 measured
    assert len(batch.plot("opening_m", x="load.mass").lines) == len(VOLTAGES)
    with pytest.raises(zipact.InputError, match="the actuators differ in load.mass, drive.voltage"):
        batch.plot(x="mesh.nodes")
    pyplot.close("all")


def test_workers_overlap():
    """Two runs are under way at once: each waits, in its progress function, for the other."""
    meeting = threading.Barrier(2, timeout=60)
    both_here = dict(progress=lambda stage, fraction: meeting.wait() is not None)
    runs = [threading.Thread(target=LONG.run, kwargs=both_here) for _ in range(2)]
    for run in runs:
        run.start()
    for run in runs:
        run.join()
    assert not meeting.broken


def with_one_lost(tmp_path):
    """Three actuators, of which study calibrate refuses the second: it has no file."""
    fine = zipact.Actuator(mesh__nodes=11, study="stationary")
    return [fine, zipact.Actuator(study="calibrate", data__file=tmp_path / "none.csv"), fine.replace(load__mass="20 g")]


def test_one_refused_keeps_the_others(tmp_path):
    """One refused actuator lost the results of all."""
    actuators = with_one_lost(tmp_path)
    with pytest.raises(zipact.BatchError, match="1 of 3 runs raised an exception; the first, run 1: .*none.csv") as raised:
        zipact.run_batch(actuators, workers=2)
    assert isinstance(raised.value, zipact.Error) and isinstance(raised.value.__cause__, zipact.InputError)
    batch = raised.value.batch
    assert list(batch.errors) == [1] and isinstance(batch[1], zipact.InputError)
    assert batch[0]["stroke_m"] == actuators[0].run()["stroke_m"] < batch[2]["stroke_m"]
    np.testing.assert_array_equal(np.isnan(batch["stroke_m"]), [False, True, False])
    again = pickle.loads(pickle.dumps(raised.value))
    assert str(again) == str(raised.value) and again.batch[2]["stroke_m"] == batch[2]["stroke_m"]


def test_exceptions_can_be_returned(tmp_path):
    batch = zipact.run_batch(with_one_lost(tmp_path), return_exceptions=True)
    assert len(batch) == 3 and "none.csv" in str(batch.errors[1]) and batch[1:].errors.keys() == {0}
    assert repr(batch) == "<Batch of 3 results, 1 of them errors>"
    only = batch[1:2]
    assert np.isnan(only["stroke_m"]).all()
    with pytest.raises(zipact.InputError, match="not a number of study stationary"):
        batch["zip_time_s"]


def test_errors_in_the_dataframe(tmp_path):
    pytest.importorskip("pandas")
    frame = zipact.run_batch(with_one_lost(tmp_path), return_exceptions=True).to_dataframe()
    assert list(frame["outcome"]) == ["converged", "error", "converged"] and "none.csv" in frame["error"][1]
    assert list(frame["load.mass"]) == [0.008, 0.008, 0.02] and np.isnan(frame["stroke_m"][1])


def test_error_of_a_long_batch_does_not_stop_it(tmp_path):
    """It does not end what is under way, nor what is still to come."""
    lost = with_one_lost(tmp_path)[1]
    seen = []
    batch = zipact.run_batch(
        [lost, *sweep(study="stationary")], workers=1, return_exceptions=True, progress=lambda *at: seen.append(at)
    )
    assert seen == [(done, len(VOLTAGES) + 1) for done in range(1, len(VOLTAGES) + 2)]
    assert batch.errors.keys() == {0} and all(result.good for result in batch[1:])


def test_exception_of_progress_stops_all():
    def progress(done, of):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        zipact.run_batch([zipact.Actuator(mesh__nodes=11, study="stationary"), LONG], workers=2, progress=progress)


def test_progress_can_stop_the_rest():
    seen = []
    batch = zipact.run_batch(
        [zipact.Actuator(load__mass="9 g", solver__end_time="1 us"), LONG, LONG],
        workers=2,
        progress=lambda done, of: seen.append((done, of)) or True,
    )
    assert [result.outcome for result in batch] == ["end_time", "interrupted", "interrupted"] and seen[0] == (1, 3)


def test_nothing_to_run():
    assert len(zipact.run_batch([])) == 0
