"""Networks of actuators between bodies, defined by dicts."""

import copy
import json
import os
import re
from collections import UserDict
from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from typing import Any, Unpack

from . import _zipact
from .actuator import (
    GROUPS,
    Actuator,
    Progress,
    actuator_of,
    combinations,
    differences,
    given_keys,
    key_name,
    plain_number,
    plain_value,
    values_of,
)
from .keywords import Keywords  # made from keys.def when the wheel is built
from .result import Result

NUMBERED = re.compile(r"(member|body|joint|spring)_(\d+)\.(.+)")  # a key as a Definition has it
NAMES = ("upper", "lower", "first", "second", "port")  # keys whose values are names


class Given(UserDict[str, Any]):
    """Keys with their values as they were given: {"ribbon.thickness": "60 um"}. Keys are also set by groups,
    {"ribbon": {"thickness": "60 um"}}, and with two underscores in place of the dot."""

    def __getitem__(self, key: str) -> Any:
        return self.data[key_name(key)]

    def __setitem__(self, key: str, value: Any) -> None:
        for name, of in given_keys({key: value}, {}).items():
            self.data[name] = plain_number(plain_value(name, of))

    def __delitem__(self, key: str) -> None:
        del self.data[key_name(key)]

    def __contains__(self, key: object) -> bool:
        return isinstance(key, str) and key_name(key) in self.data


class Named(UserDict[str, Given]):
    """Bodies, joints, members or springs by their names, each a dict of its keys."""

    def __setitem__(self, name: str, keys: Mapping[str, Any]) -> None:
        self.data[name] = Given(checked_dict(name, keys))


def checked_dict(name: str, keys: Any) -> Mapping[str, Any]:
    if not isinstance(name, str) or not isinstance(keys, Mapping):
        raise _zipact.InputError(f"{name}: takes a dict, and its name is a str")
    return keys


class Network(MutableMapping[str, Any]):
    """Several actuators between bodies.

        network = zipact.Network(drive__voltage="10 kV")            # keys of the top level, as those of Actuator
        network.bodies["hand"] = {"mass": "20 g"}
        network.members["left"] = {"upper": "frame", "lower": "hand", "ribbon.thickness": "60 um"}
        network.springs["rope"] = {"between": ["frame", "hand"], "stiffness": "2 N/m", "rest": "15 mm", "kind": "pull"}
        result = network.run("actuate", solver__end_time=0.4)
        result.members["left"]["zip_time_s"], result.series["hand.y_m"]

    Bodies also move in the plane, on joints:

        network.bodies["arm"] = {"moves": "plane", "mass": "12 g", "inertia": "2000 g mm2", "at": [0, "-8 mm"]}
        network.joints["pivot"] = {"type": "pin", "between": ["frame", "arm"], "at": [0, "6 mm"]}

    It has what was given, and can be changed. As a mapping it has the keys of the top level and those of all bodies,
    joints, members and springs, as network["members.left.ribbon.thickness"]. The library checks names and values when it runs.
    """

    def __init__(self, groups: Mapping[str, Any] | None = None, **keys: Unpack[Keywords]) -> None:
        self._top = Given()
        self._named = {group: Named() for group in GROUPS.values()}
        self.update(groups or {}, **keys)

    @property
    def bodies(self) -> Named:
        """The bodies by name. The frame, which is held, always exists."""
        return self._named["bodies"]

    @property
    def joints(self) -> Named:
        """What joins bodies that move in the plane, by name."""
        return self._named["joints"]

    @property
    def members(self) -> Named:
        """The actuators by name; keys that one does not have are those of the top level."""
        return self._named["members"]

    @property
    def springs(self) -> Named:
        """The springs between bodies, by name."""
        return self._named["springs"]

    def replace(self, groups: Mapping[str, Any] | None = None, **keys: Any) -> "Network":
        """The same network with other values of some keys."""
        other = self.copy()
        other.update(groups or {}, **keys)
        return other

    def copy(self) -> "Network":
        return copy.copy(self)

    def sweep(self, groups: Mapping[str, Any] | None = None, **lists: Iterable[Any]) -> list["Network"]:
        """One network for each combination of values; the last key varies fastest:
        network.sweep({"members.left.ribbon.thickness": ["50 um", "60 um"]}, drive__voltage=[6e3, 8e3])"""
        return [self.replace(case) for case in combinations(groups, lists)]

    def run(self, study: str | None = None, *, progress: Progress | None = None, **keys: Unpack[Keywords]) -> Result:
        """Run a study, by default that of key `study`, with other values of some keys."""
        case = self.replace(**keys, **({} if study is None else {"study": study}))
        return Result(case._definition.run(progress), case)

    def scenario(self) -> str:
        """The network as a scenario in YAML, for which the command gives the same result."""
        lines = []
        for group, named in self._named.items():  # first: the library numbers names as they come
            lines += [f"{group}:\n"] * bool(named) + [f"  {yaml(name)}: {yaml(keys)}\n" for name, keys in named.items()]
        return "".join(lines + [f"{yaml(key)}: {yaml(value)}\n" for key, value in self._top.items()])

    def drive_from(self, path: str) -> "Network":
        """The network itself: no arrays drive it."""
        return self

    def _read(self) -> tuple[_zipact.Definition, str]:
        """What the library reads in it, and that as the command writes it."""
        try:
            definitions, text = _zipact.read_scenario("network", self.scenario())
        except _zipact.InputError as error:
            raise _zipact.InputError(re.sub(r"^network[:\d]*: ", "", str(error))) from None
        if len(definitions) > 1:
            raise _zipact.InputError("a network takes one value for each key; use sweep and run_batch for the values of a list")
        return definitions[0], text

    @property
    def _definition(self) -> _zipact.Definition:
        return self._read()[0]

    def _values(self) -> dict[str, Any]:
        """Every key with its value, SI: of a single actuator's keys all, of those of its parts what is given."""
        definition, text = self._read()
        top, own = by_names(values_of(definition), named_keys(text))
        return top | own

    def _groups(self) -> dict[str, Any]:
        """All that was given, as Network takes it."""
        groups = {group: {name: keys.data for name, keys in named.items()} for group, named in self._named.items() if named}
        return self._top.data | groups

    def _place(self, key: str, make: bool = False) -> tuple[MutableMapping[str, Any], str]:
        """The dict that has a key, and its name there: members.left.ribbon.thickness is ribbon.thickness of members["left"]."""
        group, name, rest = [*key_name(key).split(".", 2), "", ""][:3]
        if group not in self._named:
            return self._top, key
        named = self._named[group]
        if not rest:
            return named, name
        if make and name not in named:
            named[name] = {}
        return named[name], rest

    def __getitem__(self, key: str) -> Any:
        place, name = self._place(key)
        return place[name]

    def __setitem__(self, key: str, value: Any) -> None:
        if key in self._named:
            self._named[key].update(checked_dict(key, value))
        else:
            place, name = self._place(key, make=True)
            place[name] = value

    def __delitem__(self, key: str) -> None:
        place, name = self._place(key)
        del place[name]

    def __iter__(self) -> Iterator[str]:
        yield from self._top
        for group, named in self._named.items():
            yield from (f"{group}.{name}.{key}" for name, keys in named.items() for key in keys)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __eq__(self, other: object) -> bool:
        return self._groups() == other._groups() if isinstance(other, Network) else NotImplemented

    def __reduce__(self) -> tuple[Any, ...]:
        return Network, (copy.deepcopy(self._groups()),)

    def __repr__(self) -> str:
        return f"Network({self._groups()!r})"


def yaml(value: Any) -> str:
    """A value, or a dict of values, in one line."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{yaml(key)}: {yaml(of)}" for key, of in value.items()) + "}"
    if isinstance(value, str) and re.fullmatch(r"[a-z][a-z0-9_.]*|-?[0-9.]+ [A-Za-z/]+", value):
        return value
    return json.dumps(value, ensure_ascii=False, default=str)


def named_keys(text: str) -> dict[str, str]:
    """The keys of bodies, joints, members and springs in a scenario that the library has written, and their values as texts."""
    found, group = {}, ""
    for line in text.splitlines():
        key, _, value = line.partition(":")
        if not line.startswith("  "):
            group = key
        elif group.partition(".")[0] in GROUPS.values():
            found[f"{group}.{key.strip()}"] = value.strip()
    return found


def by_names(values: Mapping[str, Any], texts: Mapping[str, str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Values of the top level, and of parts by their names, {"members.left.upper": "frame"}, as they are in `texts`."""
    top, own = {}, {}
    names = {group: list(dict.fromkeys(re.findall(rf"^{group}\.\w+", "\n".join(texts), re.M))) for group in GROUPS.values()}
    for key, value in values.items():
        numbered = NUMBERED.fullmatch(key)
        if numbered:
            kind, number, rest = numbered.groups()
            name = f"{names[GROUPS[kind]][int(number) - 1]}.{rest}" if int(number) <= len(names[GROUPS[kind]]) else key
            own[name] = texts.get(name, value) if rest in NAMES else value
        else:
            top[key] = value
    return top, own


def _network_of(definition: _zipact.Definition, texts: Mapping[str, str]) -> Network:
    """A network with the keys that differ from the defaults; with all keys if these do not give the same definition."""
    values = values_of(definition)
    top, own = by_names(values, texts)
    network = Network({key: value for key, value in differences(definition).items() if key in top} | own)
    return network if values_of(network._definition) == values else Network(top | own)


def read_scenario(path: str | os.PathLike[str]) -> Actuator | Network | list[Actuator] | list[Network]:
    """The actuator or the network of a scenario file; if it has several cases, a list of them in the order of the command."""
    definitions, text = _zipact.read_scenario(os.fspath(path))
    texts = named_keys(text)
    network = any(key.startswith("bodies.") for key in texts)
    found = [_network_of(definition, texts) if network else actuator_of(definition) for definition in definitions]
    return found[0] if len(found) == 1 else found
