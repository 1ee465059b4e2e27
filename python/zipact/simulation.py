"""Stepping by hand: control loops, learning."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from . import _zipact
from .actuator import Actuator


class Signal(NamedTuple):
    """A quantity that a simulation reports."""

    name: str
    unit: str
    help: str


SIGNALS: dict[str, Signal] = {row[0]: Signal(*row) for row in _zipact.signals()}
"""Every signal by its name, in the order of Simulation.read()."""


class Shape(NamedTuple):
    """Shape of the insulator faces of the ribbons: x to the right, from the position of the clip in the straight actuator,
    y upwards, from the upper platform (kind ribbon: from the clamp)."""

    zipped: int
    """pairs 0 .. zipped are closed; the clip is pair 0"""
    x: np.ndarray
    """[nodes, ribbons] m; ribbon 0 is the upper one"""
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


class Simulation(_zipact.Simulation):
    """An actuator in time, from rest (initial.state) at t = 0 on.

        simulation = zipact.Simulation(zipact.Actuator(load__mass="8 g"))
        while simulation.time < 0.2:
            simulation.step(1e-3, voltage=controller(simulation["stroke"]))

    It can be pickled and copied. One thread at a time may use it.
    """

    __slots__ = ("actuator",)
    actuator: Actuator

    def __new__(cls, actuator: Actuator) -> "Simulation":
        if not isinstance(actuator, Actuator):
            raise _zipact.InputError(f"Simulation: takes an Actuator, not {type(actuator).__name__}")
        self = super().__new__(cls, actuator._definition)
        self.actuator = actuator
        return self

    def __getitem__(self, signal: str) -> float:
        """Current value of a signal, SI: simulation["stroke"]."""
        if signal not in SIGNALS:
            raise _zipact.InputError(f"{signal}: unknown signal; the signals are {', '.join(SIGNALS)}")
        return self.get(signal)

    def read(self, out: np.ndarray | None = None) -> np.ndarray:
        """Current values of all SIGNALS, in their order, SI; into `out` if given. The signal current is the mean since the
        previous reading."""
        if out is None:
            out = np.empty(len(SIGNALS))
        try:
            self.read_into(out)
        except (BufferError, TypeError, ValueError) as error:
            raise _zipact.InputError(f"out: {error}") from None
        return out

    def control(self, controller: Callable[["Simulation"], float], period: float, end_time: float) -> None:
        """Run until `end_time` (s) with a controller: every `period` (s), starting now, controller(simulation) returns the
        voltage of the next period, V."""
        if not (math.isfinite(period) and period > 0):
            raise _zipact.InputError(f"period = {period} s: must be finite and above 0 s")
        if not (math.isfinite(end_time) and end_time >= self.time):
            raise _zipact.InputError(f"end_time = {end_time} s: must be finite and at least the current time, {self.time} s")
        step, since = self.step, self.time
        for k in range(int((end_time - since) / period)):
            step(since + (k + 1) * period - self.time, voltage=controller(self))
        if self.time < end_time - 1e-9 * period:
            step(end_time - self.time, voltage=controller(self))

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
