"""Stepping by hand: control loops, learning."""

import difflib
import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np

from . import _zipact
from .actuator import Actuator, column_name
from .network import Network


class Signal(NamedTuple):
    """A quantity that a simulation reports."""

    name: str
    unit: str
    help: str


SIGNALS: dict[str, Signal] = {row[0]: Signal(*row) for row in _zipact.signals()}
"""Every signal of an actuator by its name, in the order of Simulation.read()."""


class Shape(NamedTuple):
    """Shape of the insulator faces of the ribbons: x to the right, from the position of the clip in the straight actuator,
    y upwards, from the upper platform (kind ribbon: from the clamp)."""

    zipped: int
    """pairs 0 .. zipped are closed; the clip is pair 0"""
    x: np.ndarray
    """[nodes, ribbons] m; ribbon 0 is the upper one; of several members the nodes of one after the other"""
    y: np.ndarray
    """[nodes, ribbons] m"""
    gap: np.ndarray | None
    """[nodes] m; None for kind ribbon"""
    line_force: np.ndarray | None
    """[nodes] N/m, attraction per length; None for kind ribbon"""
    insulator_field: np.ndarray | None
    """[nodes] V/m; None for kind ribbon; nan without insulators"""
    stress: np.ndarray
    """[nodes, ribbons] Pa, largest stress of the metal in the section"""


def signals_of(columns: tuple[tuple[str, str, str], ...]) -> dict[str, Signal]:
    """Of an actuator, then of members and bodies: the column hand.y_m is the signal hand.y."""
    names = [*SIGNALS, *(name.removesuffix(column_name("", unit)) for name, unit, _ in columns[len(SIGNALS) :])]
    return {name: Signal(name, unit, help) for name, (_, unit, help) in zip(names, columns, strict=True)}


def nearest(name: str, known: Iterable[str]) -> str:
    """What to write in the place of a name that is not known."""
    close = difflib.get_close_matches(str(name), known, 1, 0.5)
    return f"did you mean {close[0]}?" if close else f"the signals are {', '.join(known)}"


class Simulation(_zipact.Simulation):
    """An actuator or a network in time, from rest (initial.state) at t = 0 on.

        simulation = zipact.Simulation(zipact.Actuator(load__mass="8 g"))
        while simulation.time < 0.2:
            simulation.step(1e-3, voltage=controller(simulation["stroke"]))

    Of a network, signals are also those of each member and body, and inputs those of each channel and body:

            simulation.set_input("left.voltage", controller(simulation["hand.y"]))
            simulation.step(1e-3)

    It can be pickled and copied. One thread at a time may use it.
    """

    __slots__ = ("actuator", "inputs", "signals")
    actuator: Actuator | Network
    """a network as it was when the simulation began"""
    signals: dict[str, Signal]
    """every signal by its name, in the order of read(): SIGNALS, then those of each member and body"""
    inputs: dict[str, str]
    """SI unit of each input that set_input takes; "1" for one without a unit"""

    def __new__(cls, actuator: Actuator | Network) -> "Simulation":
        if not isinstance(actuator, (Actuator, Network)):
            raise _zipact.InputError(f"Simulation: takes an Actuator or a Network, not {type(actuator).__name__}")
        actuator = actuator.copy() if isinstance(actuator, Network) else actuator
        self = super().__new__(cls, actuator._definition)
        self.actuator = actuator
        self.signals = signals_of(self.columns())
        self.inputs = dict(self.input_units())
        return self

    def __getitem__(self, signal: str) -> float:
        """Current value of a signal, SI: simulation["stroke"], simulation["hand.y"]."""
        if signal not in self.signals:
            raise _zipact.InputError(f"{signal}: unknown signal; {nearest(signal, self.signals)}")
        return self.get(signal)

    def read(self, out: np.ndarray | None = None) -> np.ndarray:
        """Current values of all `signals`, in their order, SI; into `out` if given. The signal current is the mean since the
        previous reading."""
        if out is None:
            out = np.empty(len(self.signals))
        try:
            self.read_into(out)
        except _zipact.InputError:
            raise
        except (BufferError, TypeError, ValueError) as error:
            raise _zipact.InputError(f"out: {error}") from None
        return out

    def control(
        self, controller: Callable[["Simulation"], float | Mapping[str, float]], period: float, end_time: float
    ) -> None:
        """Run until `end_time` (s) with a controller: every `period` (s), starting now, controller(simulation) returns the
        voltage of the next period, V, or a dict of inputs: {"left.voltage": 3e3, "right.voltage": 0}."""
        if not (math.isfinite(period) and period > 0):
            raise _zipact.InputError(f"period = {period} s: must be finite and above 0 s")
        if not (math.isfinite(end_time) and end_time >= self.time):
            raise _zipact.InputError(f"end_time = {end_time} s: must be finite and at least the current time, {self.time} s")
        since = self.time
        for k in range(int((end_time - since) / period)):
            self._step_with(since + (k + 1) * period - self.time, controller(self))
        if self.time < end_time - 1e-9 * period:
            self._step_with(end_time - self.time, controller(self))

    def _step_with(self, dt: float, answer: float | Mapping[str, float]) -> None:
        """A step with what a controller answered."""
        if not isinstance(answer, Mapping):
            return self.step(dt, voltage=answer)
        for name, value in answer.items():
            self.set_input(name, value)
        self.step(dt)

    def shape(self) -> Shape:
        """Copy of the current shape."""
        zipped, x, y, gap, line_force, insulator_field, stress = super().shape()
        flat = [None if view is None else np.array(view)[0] for view in (gap, line_force, insulator_field)]
        return Shape(zipped, np.array(x), np.array(y), *flat, np.array(stress))

    def __reduce__(self) -> tuple[Any, ...]:
        return Simulation, (self.actuator,), self.save()

    def __setstate__(self, state: bytes) -> None:
        self.restore(state)

    def __repr__(self) -> str:
        return f"<Simulation at {1e3 * self.time:g} ms, {self.get('voltage'):g} V>"
