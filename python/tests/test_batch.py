"""Runs on all cores."""

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


def test_one_that_fails_stops_all(tmp_path):
    lost = zipact.Actuator(study="calibrate", data__file=tmp_path / "none.csv")
    with pytest.raises(zipact.InputError, match="none.csv"):
        zipact.run_batch([LONG, LONG, LONG, lost], workers=4)


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
