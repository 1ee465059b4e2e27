"""Every study: the command's numbers to the last bit, as arrays."""

import csv
import json
import os
import signal
import subprocess
import threading
import time
import warnings

import numpy as np
import pytest
import zipact

COMMAND = os.environ["ZIPACT_COMMAND"]
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "data")
MOTION = dict(solver__integrator="implicit", contact__model="unilateral")
CASES = {
    "stationary": {},
    "equilibrium": {},
    "isometric": dict(isometric__separation="3 mm"),
    "modes": {},
    "profile": dict(electro__model="field", isometric__separation="2 mm"),
    "actuate": MOTION,
    "calibrate": dict(
        preset="paper-fe",
        ribbon__young_modulus="150 GPa",
        data__file=os.path.join(DATA, "finite-element-strokes.csv"),
        calibrate__fit="ribbon.young_modulus",
        calibrate__x="load_g",
        calibrate__y="stroke_mm",
    ),
}


def command(actuator, study, folder):
    scenario = folder / "in.yaml"
    scenario.write_text(actuator.replace(study=study).scenario())
    done = subprocess.run([COMMAND, "run", scenario, "-o", folder / "out", "--json", "--quiet"], capture_output=True)
    with open(folder / "out" / "table.csv", newline="") as file:
        return json.loads(done.stdout), list(csv.reader(file))


@pytest.mark.parametrize("study", CASES)
def test_same_bits_as_the_command(study, tmp_path):
    actuator = zipact.Actuator(mesh__nodes=21, **CASES[study])
    summary, (names, *rows) = command(actuator, study, tmp_path)
    result = actuator.run(study)
    assert (result.outcome, result.message) == (summary["outcome"], summary["message"])
    assert list(result.notes) == summary["notes"]
    assert list(result.series) == names
    there = np.array([[float(cell) if cell else np.nan for cell in row] for row in rows])
    np.testing.assert_array_equal(result.series.values_2d, there)
    told = {name: summary[name] for name in result if name in summary and name not in result.timings}
    assert len(told) >= 2 or study == "modes"
    for name, value in told.items():
        np.testing.assert_equal(result[name], np.nan if value is None else value)


def test_arrays_are_views_with_units():
    result = zipact.Actuator(mesh__nodes=21).run("equilibrium")
    opening = result.series["opening_m"]
    assert opening.base is not None and not opening.flags.owndata and not opening.flags.writeable
    assert result.series.units["opening_m"] == "m" and result.units["pull_in_voltage_V"] == "V"
    del result
    assert opening[0] == pytest.approx(0.0207, rel=0.01)  # lives on without its result


def test_shapes_and_field():
    result = zipact.Actuator(mesh__nodes=21).run("profile")
    nx, ny = result.field.x.shape
    assert result.field.strength.shape == result.field.permittivity.shape == (nx - 1, ny - 1)
    film = zipact.Actuator(mesh__nodes=21, drive__voltage=3e3).run("equilibrium").shapes
    assert film.x.shape == film.y.shape == (len(film.time), 21, 2)
    assert film.gap.shape == film.line_force.shape == (len(film.time), 21)
    np.testing.assert_allclose(film.y[:, :, 0] - film.y[:, :, 1], film.gap, atol=1e-12)
    single = zipact.Actuator(mesh__nodes=21, actuator__kind="ribbon").run("stationary").shapes
    assert single.x.shape == (1, 21, 1) and single.gap is None


def test_save_writes_what_the_command_writes(tmp_path):
    zipact.Actuator(mesh__nodes=21).run("modes").save(tmp_path / "new" / "folder")
    assert {"scenario.yaml", "summary.json", "table.csv", "results.h5"} <= set(os.listdir(tmp_path / "new" / "folder"))


def test_arrays_drive_a_run(tmp_path):
    times, voltages = np.array([0, 5e-3, 5e-3, 10e-3]), np.array([0, 4e3, 1e3, 1e3])
    plain = zipact.Actuator(mesh__nodes=21, solver__end_time="10 ms", **MOTION)
    result = plain.replace(drive=(times, voltages)).run()
    text = "0 ms = 0 kV, 5 ms = 4 kV, 5 ms = 1 kV, 10 ms = 1 kV"
    same = plain.replace(drive__waveform="table", drive__table=text).run()
    np.testing.assert_array_equal(result.series.values_2d, same.series.values_2d)
    assert result.series["voltage_V"].max() > 3e3
    result.save(tmp_path)
    again = zipact.read_scenario(tmp_path / "scenario.yaml")[0].run()
    np.testing.assert_array_equal(result.series.values_2d, again.series.values_2d)


def test_dataframe_has_units():
    pytest.importorskip("pandas")
    frame = zipact.Actuator(mesh__nodes=21).run("modes").to_dataframe()
    assert frame["frequency_Hz"].is_monotonic_increasing and frame.attrs["units"]["frequency_Hz"] == "Hz"


def long_run():
    """Minutes of computing."""
    return zipact.Actuator(
        solver__integrator="explicit", contact__model="sequential", drive__voltage=3e3, solver__end_time=1e3
    )


def test_progress_can_stop():
    seen = []
    result = long_run().run(progress=lambda stage, fraction: seen.append((stage, fraction)) or len(seen) == 3)
    assert result.outcome == "interrupted" and not result.good and len(seen) == 3
    assert seen[-1][0] == "simulating" and 0 <= seen[0][1] <= seen[-1][1] <= 1


def test_exception_of_progress_comes_through():
    def progress(stage, fraction):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        long_run().run(progress=progress)


def test_control_c_stops_and_other_threads_go_on():
    ticks = []

    def interrupt():
        for _ in range(20):
            time.sleep(0.01)
            ticks.append(1)
        signal.raise_signal(signal.SIGINT)

    thread = threading.Thread(target=interrupt)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        thread.start()
        long_run().run()
    thread.join()
    assert len(ticks) == 20 and time.monotonic() - start < 30


def test_no_warning_on_import_or_run():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        zipact.Actuator(mesh__nodes=21).run("stationary")
