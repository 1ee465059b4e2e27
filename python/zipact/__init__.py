"""Simulates electrostatic zipping actuators.

    import zipact

    actuator = zipact.Actuator(load__mass="8 g", drive__voltage=10e3)
    result = actuator.run()             # or run("equilibrium"), "stationary", "modes", ...
    result["zip_time_s"], result.series["stroke_m"]
    result.plot()

A Network is several actuators between bodies. Keys are those of `zipact keys`, with two underscores in place of the dot;
`zipact.KEYS` lists them. Numbers are SI, texts may have a unit.
"""

from ._zipact import Error, InputError, MachineError, NumericsError
from ._zipact import version as __version__
from .actuator import KEYS, Actuator, Key
from .batch import Batch, BatchError, run_batch
from .network import Network, read_scenario
from .result import FieldMap, Result, Shapes, Table
from .simulation import SIGNALS, Shape, Signal, Simulation

__all__ = [
    "KEYS",
    "SIGNALS",
    "Actuator",
    "Batch",
    "BatchError",
    "Error",
    "FieldMap",
    "InputError",
    "Key",
    "MachineError",
    "Network",
    "NumericsError",
    "Result",
    "Shape",
    "Shapes",
    "Signal",
    "Simulation",
    "Table",
    "read_scenario",
    "run_batch",
]
