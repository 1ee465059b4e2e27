"""Keywords, units, and what an actuator is as a Python object."""

import json
import os
import pickle
import subprocess

import numpy as np
import pytest
import zipact
from zipact.keywords import Keywords


def test_keywords_are_those_of_the_library():
    assert list(Keywords.__annotations__) == [key.replace(".", "__") for key in zipact.KEYS]
    for key in zipact.KEYS.values():
        if key.kind == "word":
            assert Keywords.__annotations__[key.name.replace(".", "__")].__args__ == tuple(key.choices)


def test_keys_are_those_of_the_command():
    """Names, units, ranges, defaults and words."""
    listed = subprocess.run([os.environ["ZIPACT_COMMAND"], "keys", "--json"], check=True, capture_output=True, text=True)
    for ours, theirs in zip(zipact.KEYS.values(), json.loads(listed.stdout), strict=True):
        assert ours.name == theirs["key"] and ours.unit == theirs.get("unit", ours.unit)
        if isinstance(theirs.get("min"), (int, float)):
            assert (ours.min, ours.max) == (theirs["min"], theirs["max"])
        assert list(ours.choices) == [choice["word"] for choice in theirs.get("choices", [])]
        if isinstance(theirs["default"], (int, float)) and ours.kind != "bool":
            assert zipact.Actuator()[ours.name] == theirs["default"], ours.name


@pytest.mark.parametrize("mass", ["20 g", "0.02 kg", "2e-2", 0.02, np.float64(0.02), np.array(0.02)])
def test_values_take_units(mass):
    assert zipact.Actuator(load__mass=mass)["load.mass"] == 0.02


def test_every_kind_of_value():
    actuator = zipact.Actuator(
        mesh__nodes=np.int64(21), platform__electrode=False, ribbon__plane="stress", solver__time_step="auto"
    )
    values = [actuator[key] for key in ("mesh.nodes", "platform__electrode", "ribbon.plane", "solver.time_step")]
    assert values == [21, False, "stress", "auto"]
    assert [type(value) for value in values] == [int, bool, str, str]


def test_dotted_keys_do_as_well():
    assert zipact.Actuator(**{"load.mass": "20 g"}) == zipact.Actuator(load__mass=0.02)


def test_preset_and_kind_as_in_the_command():
    assert zipact.Actuator(preset="paper-code", mesh__nodes=21)["mass_spring.shear_coefficient"] == 6434
    assert zipact.Actuator(actuator__kind="ribbon")["load.share"] == 1


def test_messages_are_those_of_the_library():
    with pytest.raises(zipact.InputError, match=r"^load.mas: unknown key; did you mean load.mass\?$"):
        zipact.Actuator(load__mas=1)
    with pytest.raises(zipact.InputError, match='^load.mass = "3 V": not a mass; give a value in g from 0 g to'):
        zipact.Actuator(load__mass="3 V")
    with pytest.raises(ValueError, match="^load.mass = -1 kg: out of range; 0 to 1000 kg$"):
        zipact.Actuator(load__mass=-1)
    with pytest.raises(zipact.InputError, match="^platform.length = 0.1 m: at most 0.9 of ribbon.length"):
        zipact.Actuator(platform__length=0.1)


def test_replace_keeps_the_rest_and_the_original():
    first = zipact.Actuator(load__mass="20 g", mesh__nodes=21)
    second = first.replace(load__mass="30 g")
    assert (first["load.mass"], second["load.mass"], second["mesh.nodes"]) == (0.02, 0.03, 21)


def test_sweep_is_the_product_of_lists():
    rows = zipact.Actuator().sweep(load__mass=["8 g", "20 g"], drive__voltage=np.array([5e3, 6e3, 7e3]))
    assert [(row["load.mass"], row["drive.voltage"]) for row in rows[:4]] == [
        (8e-3, 5e3),
        (8e-3, 6e3),
        (8e-3, 7e3),
        (20e-3, 5e3),
    ]
    assert len(rows) == 6


def test_equal_hashed_pickled():
    first = zipact.Actuator(load__mass="20 g")
    driven = zipact.Actuator(load__mass="20 g", drive=([0, 1], [0, 5e3]))
    assert first == zipact.Actuator(load__mass=0.02) and hash(first) == hash(zipact.Actuator(load__mass=0.02))
    assert first != driven and first != zipact.Actuator() and first != "20 g"
    for actuator in (first, driven):
        assert pickle.loads(pickle.dumps(actuator)) == actuator


def test_scenario_reads_back(tmp_path):
    actuator = zipact.Actuator(preset="paper-fe", load__mass="20 g", calibrate__fit='a "b" \\c')
    path = tmp_path / "scenario.yaml"
    path.write_text(actuator.scenario())
    assert zipact.read_scenario(path) == actuator


def test_prints_what_differs_from_the_defaults(tmp_path):
    assert repr(zipact.Actuator(mesh__nodes=61, load__mass="20 g")) == "Actuator(load__mass='20 g')"
    assert repr(zipact.Actuator()) == repr(zipact.Actuator(load__mass=0.008)) == "Actuator()"
    many = [
        zipact.Actuator(load__mass=np.float64(0.02), mesh__nodes=np.int64(21), platform__electrode=False),
        zipact.Actuator(preset="paper-code", mesh__nodes=21),
        zipact.Actuator(actuator__kind="ribbon", load__share=0.5),
        zipact.Actuator(ribbon__material="copper", insulator__material="pet", ribbon__young_modulus=1.1e11),
        zipact.Actuator(drive__waveform="table", drive__table="0 s = 0 V, 1 ms = 5 kV"),
    ]
    for actuator in many:
        assert eval(repr(actuator), {"Actuator": zipact.Actuator}) == actuator
        path = tmp_path / "scenario.yaml"
        path.write_text(actuator.scenario())
        assert eval(repr(zipact.read_scenario(path)), {"Actuator": zipact.Actuator}) == actuator
    assert len(repr(many[3])) < 120


def test_dicts():
    groups = {"load": {"mass": "20 g"}, "drive.voltage": "8 kV", "lower": {"ribbon": {"thickness": 75e-6}}}
    keywords = zipact.Actuator(load__mass=0.02, drive__voltage=8e3, lower__ribbon__thickness="75 um")
    assert zipact.Actuator(groups) == keywords == zipact.Actuator(keywords)
    assert zipact.Actuator(groups, load__mass="30 g") == keywords.replace({"load": {"mass": 0.03}})
    assert zipact.Actuator(load={"mass": "20 g"}, drive={"voltage": 8e3}, lower={"ribbon.thickness": 75e-6}) == keywords
    assert zipact.Actuator().sweep({"load": {"mass": [0.02]}, "drive.voltage": [6e3, 8e3]}) == zipact.Actuator(
        load__mass=0.02
    ).sweep(drive__voltage=[6e3, 8e3])
    with pytest.raises(zipact.InputError, match="^load.mas: unknown key; did you mean load.mass"):
        zipact.Actuator({"load": {"mas": 1}})


def test_arrays_are_replaced():
    driven = zipact.Actuator(drive=([0, 1], [0, 5e3]))
    assert driven.replace(load__mass="20 g") == zipact.Actuator(load__mass="20 g", drive=([0, 1], [0, 5e3]))
    assert driven.replace(drive=None) == zipact.Actuator()
    assert driven.replace(drive=([0, 1], [0, 4e3])) != driven != driven.replace(drive={"voltage": 3e3})


def test_lists_of_a_scenario(tmp_path):
    path = tmp_path / "lists.yaml"
    path.write_text("load.mass: [8 g, 20 g]\ndrive.voltage: [5 kV, 6 kV]\n")
    assert zipact.read_scenario(path) == zipact.Actuator().sweep(load__mass=["8 g", "20 g"], drive__voltage=[5e3, 6e3])


def test_files_are_kept_absolute(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert zipact.Actuator(data__file="some.csv")["data.file"] == str(tmp_path / "some.csv")
    assert zipact.Actuator(data__file=tmp_path / "some.csv")["data.file"] == str(tmp_path / "some.csv")
    started = zipact.Actuator(initial__state="checkpoint", initial__file="some.zps")
    assert started["initial.file"] == str(tmp_path / "some.zps")
