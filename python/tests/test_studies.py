"""Every study: the command's numbers to the last bit, as arrays."""

import copy
import csv
import json
import multiprocessing
import os
import pickle
import signal
import subprocess
import threading
import time
import warnings
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest
import zipact
from zipact import _zipact

COMMAND = os.environ["ZIPACT_COMMAND"]
DATA = os.path.join(os.path.dirname(__file__), "..", "..", "examples", "data")
MOTION = dict(solver__integrator="implicit", contact__model="unilateral")
CASES = {
    "stationary": {},
    "equilibrium": {},
    "limits": {},
    "isometric": dict(isometric__separation="3 mm"),
    "modes": {},
    "profile": dict(electro__model="field", isometric__separation="2 mm"),
    "actuate": MOTION,
    "cycle": dict(MOTION, drive__waveform="sine", drive__voltage="3 kV"),
    "calibrate": dict(
        preset="paper-fe",
        ribbon__young_modulus="150 GPa",
        data__file=os.path.join(DATA, "finite-element-strokes.csv"),
        calibrate__fit="ribbon.young_modulus",
        calibrate__x="load_g",
        calibrate__y="stroke_mm",
    ),
    "plan": dict(
        liquid__model="none",
        plan__candidates=os.path.join(DATA, "plan-strokes.csv"),
        plan__budget=3,
        calibrate__fit="ribbon.young_modulus",
        calibrate__sigma="stroke = 50 um",
        calibrate__y="stroke_mm",
    ),
}


def command(actuator, study, folder):
    scenario = folder / "in.yaml"
    scenario.write_text(actuator.replace(study=study).scenario())
    words = [COMMAND, "run", scenario, "-o", folder / "out", "--json", "--quiet", "--no-plots"]
    done = subprocess.run(words, capture_output=True)
    with open(folder / "out" / "table.csv", newline="") as file:
        return json.loads(done.stdout), list(csv.reader(file))


@pytest.mark.nightly
def test_several_kinds_of_measurement_in_one_fit():
    """The three keys that the files were made with are found within three standard errors."""
    files = "; ".join(os.path.join(DATA, f"bench-{what}.csv") for what in ("strokes", "limits", "frequencies"))
    keys = {"ribbon.young_modulus": 188e9, "medium.permittivity": 2.55, "insulator.permittivity": 4.2}
    fit = zipact.Actuator(liquid__model="none", mesh__nodes=31, data__file=files, calibrate__fit=", ".join(keys))
    result = fit.replace(calibrate__y="stroke_mm; pull_in_voltage_V; release_voltage_V; frequency_Hz").run("calibrate")
    for key, value in keys.items():
        assert abs(result[key] - value) < 3 * result[key + "_standard_error"]
    assert np.isfinite(result.series["measured_frequency_Hz"]).sum() == 3


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
    assert opening[0] == pytest.approx(0.0207, rel=0.005)  # lives on without its result; 0.002 measured


def test_shapes_and_field():
    result = zipact.Actuator(mesh__nodes=21).run("profile")
    nx, ny = result.field.x.shape
    assert result.field.strength.shape == result.field.permittivity.shape == (nx - 1, ny - 1)
    rests = zipact.Actuator(mesh__nodes=21, drive__voltage=3e3).run("equilibrium")
    film = rests.shapes
    assert film.x.shape == film.y.shape == (len(film.time), 21, 2)
    assert film.gap.shape == film.line_force.shape == film.insulator_field.shape == (len(film.time), 21)
    assert film.stress.shape == film.x.shape and film.stress.max() <= rests["max_stress_Pa"]
    np.testing.assert_allclose(film.insulator_field[:, 0], abs(film.voltage) / 260e-6, rtol=1e-12)
    np.testing.assert_allclose(film.y[:, :, 0] - film.y[:, :, 1], film.gap, atol=1e-12)
    single = zipact.Actuator(mesh__nodes=21, actuator__kind="ribbon").run("stationary").shapes
    assert single.x.shape == (1, 21, 1) and single.gap is None


SHAPED = {
    "motion": ("actuate", dict(MOTION, solver__end_time="10 ms")),
    "map of the field": ("profile", dict(electro__model="field", drive__voltage="2 kV")),
    "one ribbon alone": ("stationary", dict(actuator__kind="ribbon")),
    "series": ("modes", dict(stack__series=2)),
}


def rows(array):
    """[frames, nodes, ribbons] as results.h5 has it: [frame][ribbon][node]."""
    return np.moveaxis(array, 2, 1)


@pytest.mark.parametrize("case", SHAPED)
def test_arrays_are_those_of_the_command(case, tmp_path):
    """Every array of a result, and its numbers, as another program reads them from the file of the command."""
    h5py = pytest.importorskip("h5py")
    study, keys = SHAPED[case]
    actuator = zipact.Actuator(mesh__nodes=11, output__shapes=5, **keys)
    command(actuator, study, tmp_path)
    result = actuator.run(study)
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        for name in result.series:
            np.testing.assert_array_equal(result.series[name], file["series"][name])
        there = {name: np.array(file["shapes"][name]) for name in file["shapes"]}
        ours = {name: value for name, value in result.shapes._asdict().items() if isinstance(value, np.ndarray)}
        assert ours.keys() == there.keys() and ("gap" in ours) == (case != "one ribbon alone")
        for name, value in ours.items():
            np.testing.assert_array_equal(rows(value) if value.ndim == 3 else value, there[name], name)
        assert (result.field is not None) == ("field" in file) == (case == "map of the field")
        for name, value in result.field._asdict().items() if result.field else ():
            np.testing.assert_array_equal(value, file["field"][name], name)
        for name, value in result.items():
            if name not in result.timings:
                np.testing.assert_equal(value, file["summary"][name][()], name)


def test_members_come_back_from_a_pickle(tmp_path):
    """A frame of a series has two polylines for each member."""
    result = zipact.Actuator(mesh__nodes=11, stack__series=2, stack__distance="20 mm").run("stationary")
    files = saved(pickle.loads(pickle.dumps(result)), tmp_path / "again")
    assert files == saved(result, tmp_path / "first") and b'NumberOfLines="4"' in files["shapes/shape_0000.vtp"]


def test_templates_of_ones_own(tmp_path):
    """A template in the folder that is given replaces the one that is built in."""
    with open(os.path.join(os.path.dirname(__file__), "..", "..", "plots", "shape.gp"), encoding="utf-8") as file:
        (tmp_path / "shape.gp").write_text(file.read().replace("Shape at rest", "How it hangs"))
    result = zipact.Actuator(mesh__nodes=11).run("stationary")
    for folder, templates, title in (("built in", "", "Shape at rest"), ("mine", tmp_path, "How it hangs")):
        result.save(tmp_path / folder, templates=templates)
        assert title in (tmp_path / folder / "plots" / "shape.svg").read_text()


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
    again = zipact.read_scenario(tmp_path / "scenario.yaml").run()
    np.testing.assert_array_equal(result.series.values_2d, again.series.values_2d)


def assert_same(one, other):
    """Two results are the same to the last bit."""
    assert (one.study, one.outcome, one.good, one.message) == (other.study, other.outcome, other.good, other.message)
    assert (one.notes, one.units, one.timings, one.actuator) == (other.notes, other.units, other.timings, other.actuator)
    assert list(one) == list(other)
    np.testing.assert_array_equal(list(one.values()), list(other.values()))
    assert (one.series.units, one.series.help) == (other.series.units, other.series.help)
    np.testing.assert_array_equal(one.series.values_2d, other.series.values_2d)
    for mine, theirs in ((one.shapes, other.shapes), (one.field, other.field)):
        assert (mine is None) == (theirs is None)
        for a, b in zip(mine or (), theirs or (), strict=True):
            np.testing.assert_equal(a, b)


def saved(result, folder):
    result.save(folder)
    files = [path for path in sorted(folder.rglob("*")) if path.is_file() and "plots" not in path.parts]
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


@pytest.mark.parametrize("study", CASES)
def test_result_pickles(study, tmp_path):
    """A Result could not be pickled. One that comes back is equal, and writes the same files."""
    result = zipact.Actuator(mesh__nodes=21, **CASES[study]).run(study)
    again = pickle.loads(pickle.dumps(result))
    assert_same(again, result)
    assert_same(copy.deepcopy(again), result)
    assert repr(again) == repr(result)
    if study in ("actuate", "profile"):  # of the others nothing else is written, and pictures take seconds
        files = saved(again, tmp_path / "again")
        assert files == saved(result, tmp_path / "first") and len(files) >= 5


def test_results_come_back_from_processes():
    actuators = zipact.Actuator(mesh__nodes=11).sweep(load__mass=["8 g", "20 g"])
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(2, mp_context=context) as pool:
        for actuator, result in zip(actuators, pool.map(zipact.Actuator.run, actuators, ["stationary"] * 2), strict=True):
            assert_same(result, actuator.run("stationary"))


def test_damaged_pickle_is_refused():
    packed = bytearray(zipact.Actuator(mesh__nodes=11, drive__voltage=3e3).run("profile").__reduce__()[1][1])
    for place in range(0, len(packed), 97):
        with pytest.raises(zipact.InputError, match="result: (not a result|cut short|damaged|of version)"):
            _zipact.unpack_result(bytes(packed[:place]))
        packed[place] ^= 1 << place % 8
        with pytest.raises(zipact.InputError, match="result: (not a result|cut short|damaged|of version)"):
            _zipact.unpack_result(bytes(packed))
        packed[place] ^= 1 << place % 8
    with pytest.raises(zipact.InputError, match="takes the bytes"):
        _zipact.unpack_result("text")


def test_pickled_field_draws_the_same_picture(tmp_path):
    """The rows of the ribbons' surfaces were missing in a pickle."""
    result = zipact.Actuator(mesh__nodes=11, drive__voltage=3e3).run("profile")
    result.save(tmp_path / "first")
    pickle.loads(pickle.dumps(result)).save(tmp_path / "again")
    data = [path.name for path in (tmp_path / "first" / "plots").glob("*.dat")]
    assert data
    for name in data:
        assert (tmp_path / "first" / "plots" / name).read_bytes() == (tmp_path / "again" / "plots" / name).read_bytes()


EARLIER = os.path.join(os.path.dirname(__file__), "..", "..", "tests", "data", "0.1.0")


@pytest.mark.parametrize("name, kind", [("result", "result: pickled by zipact 0.1.0"), ("simulation", "state: of version 9 of the format, by zipact 0.1.0")])
def test_pickles_of_an_earlier_version_say_so(name, kind):
    with open(os.path.join(EARLIER, name + ".pickle"), "rb") as file, pytest.raises(zipact.InputError, match=kind):
        pickle.load(file)


@pytest.mark.parametrize("study", ["stationary", "modes"])
def test_sensitivity_is_that_of_the_command(study, tmp_path):
    actuator = zipact.Actuator(mesh__nodes=21, sensitivity__by="ribbon.thickness, gravity")
    summary, _ = command(actuator, study, tmp_path)
    result = actuator.run(study)
    assert result.sensitivity == summary["sensitivity"] and len(result.sensitivity) >= 2
    assert pickle.loads(pickle.dumps(result)).sensitivity == result.sensitivity


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
    start = time.process_time()
    with pytest.raises(KeyboardInterrupt):
        thread.start()
        long_run().run()
    thread.join()
    assert len(ticks) == 20 and time.process_time() - start < 30


def test_no_warning_on_import_or_run():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        zipact.Actuator(mesh__nodes=21).run("stationary")
