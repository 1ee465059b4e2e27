"""Batches that run elsewhere: in threads and processes of the caller, by Dask, under MPI."""

import concurrent.futures
import multiprocessing
import shutil
import subprocess
import sys

import numpy as np
import pytest
import zipact
from test_batch import LONG


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
    with pytest.raises(zipact.InputError, match="executor: takes an executor of concurrent.futures"):
        zipact.run_batch(loads(), executor=3)
    with concurrent.futures.ThreadPoolExecutor(1) as pool, pytest.raises(zipact.InputError, match="workers: not allowed with an executor"):
        zipact.run_batch(loads(), executor=pool, workers=2)
