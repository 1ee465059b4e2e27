"""Runs on all cores."""

import concurrent.futures
import multiprocessing
import pickle
import shutil
import subprocess
import sys
import threading

import numpy as np
import pytest
import zipact

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
    with pytest.raises(zipact.InputError, match="no number of study isometric"):
        batch["zip_time_s"]


def test_dataframe_has_the_keys_that_differ():
    pytest.importorskip("pandas")
    frame = zipact.run_batch(sweep(), "isometric").to_dataframe()
    np.testing.assert_array_equal(frame["drive.voltage"], VOLTAGES)
    assert list(frame.columns[:3]) == ["drive.voltage", "outcome", "force_N"]


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
    with pytest.raises(zipact.InputError, match="no number of study stationary"):
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


# -- executors ------------------------------------------------------------------------------------------


def assert_same_as_here(batch, actuators):
    for result, alone in zip(batch, zipact.run_batch(actuators, "stationary"), strict=True):
        assert dict(result) == dict(alone)
        np.testing.assert_array_equal(result.series.values_2d, alone.series.values_2d)


def loads():
    return zipact.Actuator(mesh__nodes=11).sweep(load__mass=[0.002, 0.008, 0.02])


def test_threads_of_the_caller():
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        assert_same_as_here(zipact.run_batch(loads(), "stationary", executor=pool), loads())
        assert pool.submit(int).result() == 0  # it stays open


def test_processes():
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        assert_same_as_here(zipact.run_batch(loads(), "stationary", executor=pool), loads())


def test_client_of_dask():
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=1, threads_per_worker=2, dashboard_address=None) as client:
        assert_same_as_here(zipact.run_batch(loads(), "stationary", executor=client), loads())


MPI = """
import zipact
from mpi4py.futures import MPIPoolExecutor

if __name__ == "__main__":
    actuators = zipact.Actuator(mesh__nodes=11).sweep(load__mass=[0.002, 0.008, 0.02])
    with MPIPoolExecutor() as pool:
        print(*zipact.run_batch(actuators, "stationary", executor=pool)["stroke_m"])
"""


def test_pool_of_mpi4py(tmp_path):
    pytest.importorskip("mpi4py")
    mpirun = shutil.which("mpirun")
    if not mpirun:
        pytest.skip("no mpirun")
    (tmp_path / "pool.py").write_text(MPI)
    words = [mpirun, "--allow-run-as-root", "--oversubscribe", "-n", "2", sys.executable, "-m", "mpi4py.futures", tmp_path / "pool.py"]
    printed = subprocess.run(words, stdout=subprocess.PIPE, text=True, check=True).stdout
    assert [float(word) for word in printed.split()] == list(zipact.run_batch(loads(), "stationary")["stroke_m"])


class Losing:
    """An executor whose second worker is lost, and which runs nothing once it was asked to cancel."""

    def __init__(self):
        self.asked = 0

    def submit(self, function, *values):
        self.asked += 1
        run = concurrent.futures.Future()
        if self.asked == 2:
            run.set_exception(RuntimeError("its worker was lost"))
        else:
            run.set_result(function(*values))
        return run


def test_a_lost_worker_costs_its_run():
    batch = zipact.run_batch(loads(), "stationary", executor=Losing(), return_exceptions=True)
    assert list(batch.errors) == [1] and "lost" in str(batch[1])
    assert batch[0].good and batch[2].good


class Waiting:
    """An executor that runs the first and never begins the others."""

    def __init__(self):
        self.runs = []

    def submit(self, function, *values):
        run = concurrent.futures.Future()
        if not self.runs:
            run.set_result(function(*values))
        self.runs.append(run)
        return run


def test_progress_can_stop_an_executor():
    pool = Waiting()

    def progress(done, of):
        for run in pool.runs[1:]:
            if not run.cancelled() and run.cancel():
                run.set_running_or_notify_cancel()
        return True

    short = zipact.Actuator(mesh__nodes=11, study="stationary")
    batch = zipact.run_batch([short, LONG, LONG], executor=pool, progress=progress)
    assert [result.outcome for result in batch] == ["converged", "interrupted", "interrupted"]


def test_wrong_executors():
    with pytest.raises(zipact.InputError, match="executor: takes one of concurrent.futures"):
        zipact.run_batch(loads(), executor=3)
    with concurrent.futures.ThreadPoolExecutor(1) as pool, pytest.raises(zipact.InputError, match="workers: an executor has its own"):
        zipact.run_batch(loads(), executor=pool, workers=2)
