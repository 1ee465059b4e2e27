"""Results of studies, as numpy arrays with units."""

import os
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from . import _zipact

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from .actuator import Actuator
    from .drawing import Animation
    from .network import Network


class Table(Mapping[str, np.ndarray]):
    """Columns by name: table["stroke_m"], one number per row; nan if a value does not exist. The arrays are read-only
    views of the memory of the library."""

    def __init__(self, columns: tuple[tuple[str, str, str], ...], values: np.ndarray) -> None:
        self.values_2d = values
        """all columns, [rows, columns]"""
        self.units = {name: unit for name, unit, _ in columns}
        """SI unit of each column; "1" for numbers without a unit"""
        self.help = {name: text for name, _, text in columns}
        """a line of help for each column"""
        self._place = {name: i for i, (name, _, _) in enumerate(columns)}

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._place:
            raise _zipact.InputError(f"{name}: unknown column; the columns are {', '.join(self._place)}")
        return self.values_2d[:, self._place[name]]

    def __iter__(self) -> Iterator[str]:
        return iter(self._place)

    def __len__(self) -> int:
        return len(self._place)

    def __contains__(self, name: object) -> bool:
        return name in self._place

    def to_dataframe(self) -> "pandas.DataFrame":
        """The table for pandas; units are in .attrs["units"]."""
        import pandas

        frame = pandas.DataFrame(self.values_2d, columns=list(self._place))
        frame.attrs["units"] = self.units
        return frame

    def __repr__(self) -> str:
        return f"<Table of {len(self.values_2d)} rows: {', '.join(self)}>"


class Shapes(NamedTuple):
    """Shapes over time; in study modes: the shape at rest, then one for each mode."""

    time: np.ndarray
    """[frames] s"""
    voltage: np.ndarray
    """[frames] V"""
    zipped: np.ndarray
    """[frames] pairs 0 .. zipped are closed; the clip is pair 0"""
    x: np.ndarray
    """[frames, nodes, ribbons] m, to the right, from the position of the clip in the straight actuator; ribbon 0 is the upper one"""
    y: np.ndarray
    """[frames, nodes, ribbons] m, upwards from the upper platform (kind ribbon: from the clamp)"""
    gap: np.ndarray | None
    """[frames, nodes] m; None for kind ribbon"""
    line_force: np.ndarray | None
    """[frames, nodes] N/m, attraction per length; None for kind ribbon"""
    insulator_field: np.ndarray | None
    """[frames, nodes] V/m; None for kind ribbon; nan without insulators"""
    stress: np.ndarray | None
    """[frames, nodes, ribbons] Pa, largest stress of the metal in the section; None in study profile"""
    members: int
    """of a series or a network, whose nodes follow one another, member by member; else 1"""

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw all shapes, early ones pale, late ones dark."""
        from . import plot

        return plot.shapes(self, ax)


class FieldMap(NamedTuple):
    """The electric field around the ribbons on a grid that follows them: i along the ribbons, j upwards."""

    x: np.ndarray
    """[nx, ny] m"""
    y: np.ndarray
    """[nx, ny] m"""
    potential: np.ndarray
    """[nx, ny] V"""
    strength: np.ndarray
    """[nx - 1, ny - 1] V/m, at the centre of a cell"""
    permittivity: np.ndarray
    """[nx - 1, ny - 1] relative permittivity; 0 in metal"""

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the strength of the field."""
        from . import plot

        return plot.field(self, ax)


def array(view: Any) -> Any:
    return None if view is None else np.asarray(view)


def shapes_of(parts: Mapping[str, Any]) -> Shapes:
    time, voltage, zipped = np.array(parts["heads"], dtype=float).T
    arrays = (array(parts[name]) for name in ("x", "y", "gap", "line_force", "insulator_field", "stress"))
    return Shapes(time, voltage, zipped.astype(int), *arrays, parts["members"])


T = TypeVar("T")


def grouped(values: Mapping[str, T], group: str) -> dict[str, dict[str, T]]:
    """{"bodies.hand.y_m": 0.0} => {"hand": {"y_m": 0.0}}"""
    found: dict[str, dict[str, T]] = {}
    for path, value in values.items():
        first, _, rest = path.partition(".")
        if first == group:
            name, _, number = rest.partition(".")
            found.setdefault(name, {})[number] = value
    return found


class Result(Mapping[str, float]):
    """The result of a study. As a mapping it contains the numbers: result["zip_time_s"]; nan if a number does not exist.
    It can be pickled and copied."""

    def __init__(self, found: _zipact.Result, actuator: "Actuator | Network") -> None:
        self._found = found
        self.actuator = actuator
        """the actuator or the network that was simulated"""
        self.study: str = found.study
        self.outcome: str = found.outcome
        """outcome, a word: zipped, reopened, end_time, converged, followed; or diverged, not_settled, ..."""
        self.good: bool = found.good
        """whether the run completed; false if the solver failed or the run was interrupted"""
        self.message: str = found.message
        """one sentence about the outcome"""
        self.notes: tuple[str, ...] = found.notes
        """sentences about breakdown, yield, and limits of the model and of the mesh"""
        self.units = {name: unit for name, unit, _, _ in found.scalars}
        """SI unit of each number; "1" for numbers without a unit, "count" for counts"""
        self._numbers = {name: value for name, _, value, _ in found.scalars}
        self.bodies, self.members = (grouped(self._numbers, group) for group in ("bodies", "members"))
        """numbers of each body and each member of a network: members["left"]["zip_time_s"]"""
        self.timings = {name for name, _, _, timing in found.scalars if timing}
        """names of numbers that depend on wall time: they differ from run to run"""
        self.sensitivity: dict[str, dict[str, float]] = {}
        """derivatives in SI units: sensitivity["stroke_m"]["ribbon.thickness"], with respect to the keys of sensitivity.by
        as the scenario calls them: "members.left.ribbon.thickness"; of parts sensitivity["members.left.opening_m"]"""
        for output, key, value in found.sensitivities(actuator.scenario()):
            self.sensitivity.setdefault(output, {})[key] = value
        self.series = None if found.series is None else Table(found.series[0], array(found.series[1]))
        """the study's table, or None"""
        self.shapes = None if found.shapes is None else shapes_of(found.shapes)
        """the ribbons' shapes, or None"""
        self.field = None if found.field is None else FieldMap(**{k: array(v) for k, v in found.field.items()})
        """the field around the ribbons (study profile), or None"""

    def __getitem__(self, name: str) -> float:
        if name not in self._numbers:
            raise _zipact.InputError(f"{name}: not a number of study {self.study}; its numbers are {', '.join(self)}")
        return self._numbers[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._numbers)

    def __len__(self) -> int:
        return len(self._numbers)

    def get(self, name: str, default: Any = None) -> Any:
        return self._numbers.get(name, default)

    def __contains__(self, name: object) -> bool:
        return name in self._numbers

    def to_dataframe(self) -> "pandas.DataFrame":
        """The study's table for pandas; units are in .attrs["units"]."""
        if self.series is None:
            raise _zipact.InputError(f"study {self.study} ended without a table: {self.message}")
        return self.series.to_dataframe()

    def plot(self, ax: "Axes | None" = None) -> "Axes":
        """Draw the main result of the study with matplotlib."""
        from . import plot

        return plot.result(self, ax)

    def animate(self, ax: "Axes | None" = None, frames: int = 80) -> "Animation":
        """A film of a run by matplotlib, evenly in time, of at most so many frames: of a network with its bodies, joints and
        springs. A notebook shows it; animate().save("zip.gif") writes it."""
        from .drawing import Animation

        return Animation(self, ax, frames)

    def save(self, directory: str | os.PathLike[str], templates: str | os.PathLike[str] = "") -> None:
        """Write the files of the command: scenario.yaml, summary.json, table.csv, results.h5, plots/, ...; and drive.csv
        if arrays drove the actuator. `templates`: folder of gnuplot templates of your own, which run as programs."""
        folder = os.fspath(directory)
        os.makedirs(folder, exist_ok=True)
        self._found.save(folder, self.actuator.drive_from(os.path.join(folder, "drive.csv")).scenario(), os.fspath(templates))

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickle, (self.actuator, self._found.pack())

    def __repr__(self) -> str:
        lines = [f"{self.study}: {self.outcome}; {self.message}"]
        for name, value in self.items():
            unit = self.units[name]
            lines.append(f"  {name:<28} {value:14.6g} {unit if unit not in ('1', 'count') else ''}".rstrip())
        return "\n".join(lines + [f"  note: {note}" for note in self.notes])


def _unpickle(actuator: "Actuator | Network", packed: Any) -> Result:
    if isinstance(packed, tuple):  # as zipact 0.1.0 did
        raise _zipact.InputError(f"result: pickled by zipact {packed[0][0]} in another form; run the study again")
    return Result(_zipact.unpack_result(packed), actuator)
