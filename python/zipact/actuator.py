"""Actuators, defined by keywords."""

import itertools
import json
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple, Unpack

import numpy as np

from . import _zipact
from .keywords import Keywords  # made from keys.def when the wheel is built
from .result import Result

Progress = Callable[[str, float], Any]
"""Called some times a second with the stage and its progress, 0 to 1; if it returns true, the call stops."""


class Key(NamedTuple):
    """The properties of a key."""

    name: str
    kind: str
    """real, real or auto, int, bool, word, text"""
    unit: str
    """SI; "1" for numbers without a unit and for words"""
    default: str
    min: float
    max: float
    help: str
    choices: dict[str, str]
    """words that a key of kind word takes, and their meanings"""


class Keys(dict[str, Key]):
    """Every key by its name, "load.mass". Those of all segments, members, bodies, joints and springs are listed once, with K
    in the place of a number; KEYS["segment_2.length"], KEYS["member_3.ribbon.thickness"] and
    KEYS["members.left.ribbon.thickness"] are found as well, though not by `in` or get."""

    def __missing__(self, name: str) -> Key:
        row, numbers = re.subn(r"^(member|body|joint|spring)_(?:[1-9][0-9]{0,2}|10[01][0-9]|102[0-4])[.]", r"\1_K.", name)
        if numbers == 0:
            row, numbers = re.subn(r"^(lower[.])?segment_(?:[1-9]|[1-5][0-9]|6[0-4])[.]", r"\1segment_K.", name)
        group, _, rest = name.partition(".")
        if group in GROUPS.values():
            row, numbers = f"{next(one for one in GROUPS if GROUPS[one] == group)}_K.{rest.partition('.')[2]}", 1
        if numbers == 0 or row not in self:
            raise KeyError(name)
        return self[row]._replace(name=name)


GROUPS = {"body": "bodies", "joint": "joints", "member": "members", "spring": "springs"}  # of a network
KEYS = Keys({row[0]: Key(*row[:7], dict(row[7])) for row in _zipact.keys()})

SEVERAL_FILES = ("data.file", "plan.candidates")
FILES = (*SEVERAL_FILES, "drive.file", "setpoint.file", "initial.file", "base.file")  # kept as absolute paths, as in a scenario


def key_name(keyword: str) -> str:
    """load__mass => load.mass"""
    if not isinstance(keyword, str):
        raise _zipact.InputError(f"{keyword!r}: not the name of a key")
    return keyword.replace("__", ".")


def is_key(name: str) -> bool:
    try:
        return KEYS[name].name == name and not re.match("(lower[.])?[a-z]+_K[.]|(bodies|joints|members|springs)[.]", name)
    except KeyError:
        return False


def given_keys(groups: Mapping[str, Any] | None, keywords: Mapping[str, Any]) -> dict[str, Any]:
    """{"load": {"mass": "20 g"}}, {"load.mass": "20 g"} and load__mass="20 g" => {"load.mass": "20 g"}; keywords come last."""
    given: dict[str, Any] = {}
    for name, value in [*(groups or {}).items(), *keywords.items()]:
        key = key_name(name)
        if isinstance(value, Mapping) and value and not is_key(key):
            given.update((f"{key}.{inner}", of) for inner, of in given_keys(value, {}).items())
        else:
            given[key] = value
    return given


def combinations(groups: Mapping[str, Any] | None, lists: Mapping[str, Iterable[Any]]) -> list[dict[str, Any]]:
    """Each combination of the values of some keys; the last key varies fastest."""
    given = given_keys(groups, lists)
    for name, values in given.items():
        if isinstance(values, str) or not isinstance(values, Iterable):
            raise _zipact.InputError(f"{name}: sweep takes a list of values")
    return [dict(zip(given, row, strict=True)) for row in itertools.product(*given.values())]


def column_name(name: str, unit: str) -> str:
    """("load.mass", "kg") => "load.mass_kg", ("ribbon.density", "kg/m3") => "ribbon.density_kg_per_m3", as the command writes it"""
    return name if unit == "1" else f"{name}_{unit.replace('/', '_per_').replace(' ', '_')}"


def plain_value(name: str, value: Any) -> Any:
    """A value for the extension: paths become texts."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if name in FILES and isinstance(value, str) and value:
        paths = value.split(";") if name in SEVERAL_FILES else [value]
        value = "; ".join(os.path.abspath(path.strip(" ")) for path in paths)
    return value


def doubles(what: str, values: Any) -> np.ndarray:
    """A one-dimensional array of float64."""
    try:
        array = np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise _zipact.InputError(f"{what}: {error}") from None
    if array.ndim != 1:
        raise _zipact.InputError(f"{what}: takes a one-dimensional array, not one of shape {array.shape}")
    return array


def drive_arrays(drive: Any) -> tuple[np.ndarray, np.ndarray]:
    try:
        time, voltage = drive
    except (TypeError, ValueError):
        raise _zipact.InputError("drive: takes two arrays, times and voltages") from None
    return doubles("drive: times", time), doubles("drive: voltages", voltage)


class Actuator(Mapping[str, Any]):
    """An actuator and its study: a value for every key, checked and immutable.

    Actuator(load__mass="20 g", drive__voltage=8e3): keywords are keys with two underscores in place of the dot. (Keys
    contain single underscores, as mass_spring.axial.) A dict takes the keys themselves, in groups or not:
    Actuator({"load.mass": "20 g", "drive": {"voltage": "8 kV"}}), as in a YAML or JSON file. Numbers are SI; texts are
    read as in a scenario. Other keys have the defaults of `preset`, kind and materials, as in the command.

    drive=(times, voltages), arrays in s and V, replaces drive.waveform in study actuate and in Simulation.

    As a mapping it lists every key, and of members of a stack those that are given; other members' keys can be read, too:
    actuator["load.mass"] is a float in SI, an int, a bool, or a str. Printing it shows the keys that differ from the
    defaults.
    """

    __slots__ = ("_definition", "_drive", "_given")

    def __init__(
        self, groups: Mapping[str, Any] | None = None, *, drive: Any = None, **keys: Unpack[Keywords]
    ) -> None:
        if isinstance(drive, Mapping):  # a group of keys, not arrays
            groups, drive = {**(groups or {}), "drive": drive}, None
        given = {name: plain_value(name, value) for name, value in given_keys(groups, keys).items()}
        self._given = given
        self._drive = None if drive is None else drive_arrays(drive)
        if self._drive is None:
            self._definition = _zipact.Definition(given)
        else:
            self._definition = _zipact.Definition({"drive.waveform": "table", **given}, self._drive)

    def replace(self, groups: Mapping[str, Any] | None = None, **keys: Any) -> "Actuator":
        """The same actuator with other values of some keys; drive=None removes the arrays that drive it."""
        arrays = self._drive
        if not isinstance(keys.get("drive"), Mapping):
            arrays = keys.pop("drive", arrays)
        return Actuator({**self._given, **given_keys(groups, keys)}, drive=arrays)

    def sweep(self, groups: Mapping[str, Any] | None = None, **lists: Iterable[Any]) -> list["Actuator"]:
        """One actuator for each combination of values; the last key varies fastest."""
        return [self.replace(case) for case in combinations(groups, lists)]

    def run(self, study: str | None = None, *, progress: Progress | None = None) -> Result:
        """Run a study, by default that of key `study`. Other threads run meanwhile; Ctrl-C stops the call."""
        if study is not None and study != self["study"]:
            return self.replace(study=study).run(progress=progress)
        return Result(self._definition.run(progress), self)

    def drive_from(self, path: str) -> "Actuator":
        """The same actuator, driven by a CSV file instead of arrays; writes this file. The actuator itself if there are no
        arrays."""
        if self._drive is None:
            return self
        rows = np.column_stack(self._drive)
        np.savetxt(path, rows, fmt="%.17g", delimiter=",", header="time_s,voltage_V", comments="")
        return Actuator({**self._given, "drive.waveform": "table", "drive.file": path})

    def scenario(self) -> str:
        """All keys as a scenario in YAML, for which the command gives the same result. It does not contain the arrays of
        drive."""
        lines = []
        for name, value in self.items():
            text = json.dumps(value) if KEYS[name].kind == "text" else str(value).lower()
            lines.append(f"{name}: {value if KEYS[name].kind == 'word' else text}\n")
        return "".join(lines)

    def __getitem__(self, key: str) -> Any:
        return self._definition.get(key_name(key))

    def __iter__(self) -> Iterator[str]:
        return iter(self._definition.keys())

    def __len__(self) -> int:
        return len(self._definition.keys())

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and is_key(key_name(key))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Actuator):
            return NotImplemented
        same_drive = np.array_equal(self._drive or (), other._drive or ())
        return same_drive and list(self.items()) == list(other.items())

    def __hash__(self) -> int:
        return hash(tuple(self.values()))

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (self._given, self._drive)

    def __repr__(self) -> str:
        shown = {name: self._given.get(name, value) for name, value in differences(self._definition).items()}
        given = [f"{name.replace('.', '__')}={plain_number(value)!r}" for name, value in shown.items()]
        return f"Actuator({', '.join(given + ['drive=...'] * (self._drive is not None))})"


def plain_number(value: Any) -> Any:
    """numpy's values as Python's own."""
    return value.tolist() if isinstance(value, (np.generic, np.ndarray)) else value


def values_of(definition: _zipact.Definition) -> dict[str, Any]:
    return {name: definition.get(name) for name in definition.keys()}


def differences(definition: _zipact.Definition) -> dict[str, Any]:
    """The keys whose values differ from the defaults. Words come first, because they set defaults of other keys: a preset,
    the kind, a material."""
    values, defaults = values_of(definition), values_of(DEFAULT)
    words = {name: value for name, value in values.items() if KEYS[name].kind == "word" and value != defaults.get(name, value)}
    try:
        defaults = values_of(_zipact.Definition(words))
    except _zipact.InputError:  # a word that requires another key: ignore its defaults
        words = {}
    return words | {name: value for name, value in values.items() if value != defaults.get(name)}


DEFAULT = _zipact.Definition({})


def _rebuild(given: dict[str, Any], drive: tuple[np.ndarray, np.ndarray] | None) -> Actuator:
    return Actuator(given, drive=drive)


def actuator_of(definition: _zipact.Definition) -> Actuator:
    """An actuator with the keys that differ from the defaults; with all keys if these do not give the same definition."""
    values = values_of(definition)
    try:
        actuator = Actuator(differences(definition))
    except _zipact.InputError:
        return Actuator(values)
    return actuator if dict(actuator) == values else Actuator(values)
