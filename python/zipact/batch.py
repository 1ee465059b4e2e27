"""Many runs at once, on all cores."""

import csv
import functools
import os
import threading
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

import numpy as np

from ._zipact import Error, InputError
from .actuator import KEYS, Actuator, column_name
from .network import Network
from .result import Result

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes


class Batch(Sequence[Result]):
    """Results in the order of their actuators or networks. batch["zip_time_s"] is the array of this number in all runs, nan if a run
    does not have it. If a run raised an exception, it takes the place of the result."""

    def __init__(self, results: Iterable[Result | Exception], actuators: Iterable[Actuator | Network]) -> None:
        self.results = list(results)
        self.actuators = list(actuators)
        """the simulated actuators or networks"""

    @property
    def errors(self) -> dict[int, Exception]:
        """the exceptions of runs without a result, by index"""
        return {i: found for i, found in enumerate(self.results) if isinstance(found, Exception)}

    def __getitem__(self, item: Any) -> Any:
        if isinstance(item, slice):
            return Batch(self.results[item], self.actuators[item])
        if not isinstance(item, str):
            return self.results[item]
        found = [result for result in self.results if isinstance(result, Result)]
        if found and not any(item in result for result in found):
            found[0][item]  # raises an error that lists the numbers
        return np.array([result.get(item, np.nan) if isinstance(result, Result) else np.nan for result in self.results])

    def __len__(self) -> int:
        return len(self.results)

    @property
    def varied(self) -> list[str]:
        """the keys in which the actuators or networks differ"""
        keys = dict.fromkeys(key for values in self.values for key in values)
        return [key for key in keys if len({value_in(values, key) for values in self.values}) > 1]

    @functools.cached_property
    def values(self) -> list[Mapping[str, Any]]:
        """every key of each actuator or network with its value, SI"""
        return [values_of(actuator) for actuator in self.actuators]

    @property
    def units(self) -> dict[str, str]:
        """SI unit of each varied key and of each number; "1" for numbers without a unit"""
        units = {key: KEYS[key].unit for key in self.varied}
        for found in self.results:
            units |= found.units if isinstance(found, Result) else {}
        return units

    def to_dataframe(self) -> "pandas.DataFrame":
        """One row per run: the keys in which the actuators differ, the outcome, the numbers. A run without a result has the
        outcome error, and its message in column error. Units are in .attrs["units"]."""
        import pandas

        rows: list[dict[str, Any]] = []
        for values, found in zip(self.values, self.results, strict=True):
            row = {key: value_in(values, key) for key in self.varied}
            answer = {"outcome": found.outcome} | dict(found) if isinstance(found, Result) else {"outcome": "error"}
            rows.append(row | answer | ({"error": str(found)} if isinstance(found, Exception) else {}))
        frame = pandas.DataFrame(rows)
        frame.attrs["units"] = self.units
        return frame

    def plot(self, y: str | None = None, x: str | None = None, ax: "Axes | None" = None) -> "Axes":
        """Draw a number of all runs with matplotlib: `y`, by default the first number of the study, against the varied key
        `x`, by default the numeric key with most values; one line per combination of the other varied keys."""
        from . import plot

        return plot.batch(self, y, x, ax)

    def save(self, directory: str | os.PathLike[str]) -> None:
        """Write table.csv, one row per run as in a sweep of the command, and the files of each run in run-0, run-1, ...; a
        run without a result has the outcome error and no folder."""
        folder = os.fspath(directory)
        os.makedirs(folder, exist_ok=True)
        for place, found in enumerate(self.results):
            if isinstance(found, Result):
                found.save(os.path.join(folder, f"run-{place}"))
        with open(os.path.join(folder, "table.csv"), "w", encoding="utf-8", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(self._table())

    def _table(self) -> list[list[Any]]:
        """The rows of table.csv, after their heading."""
        varied, found = self.varied, [result for result in self.results if isinstance(result, Result)]
        numbers = list(dict.fromkeys(name for result in found for name in result if name not in result.timings))
        rows: list[list[Any]] = [[column_name(key, KEYS[key].unit) for key in varied] + ["outcome", *numbers]]
        for values, result in zip(self.values, self.results, strict=True):
            answers = [result.get(name, np.nan) for name in numbers] if isinstance(result, Result) else [np.nan] * len(numbers)
            outcome = result.outcome if isinstance(result, Result) else "error"
            rows.append([cell(value_in(values, key)) for key in varied] + [outcome] + [cell(answer) for answer in answers])
        return rows

    def __repr__(self) -> str:
        errors = len(self.errors)
        return f"<Batch of {len(self)} results{f', {errors} of them errors' if errors else ''}>"


def values_of(actuator: Actuator | Network) -> Mapping[str, Any]:
    """Every key with its value; of a network that the library refuses what was given."""
    if isinstance(actuator, Actuator):
        return actuator
    try:
        return actuator._values()
    except InputError:
        return {key: value if isinstance(value, (int, float, str)) else repr(value) for key, value in actuator.items()}


def value_in(values: Mapping[str, Any], key: str) -> Any:
    return values[key] if key in values else None


def cell(value: Any) -> Any:
    """Integers without a decimal point."""
    return int(value) if isinstance(value, float) and value.is_integer() and abs(value) < 1e15 else value


class BatchError(Error):
    """Some runs of a batch raised exceptions; `batch` contains these and the results of the other runs."""

    def __init__(self, batch: Batch) -> None:
        place, error = next(iter(batch.errors.items()))
        super().__init__(f"{len(batch.errors)} of {len(batch)} runs raised an exception; the first, run {place}: {error}")
        self.batch = batch

    def __reduce__(self) -> tuple[Any, ...]:
        return BatchError, (self.batch,)


def _run(actuator: Actuator | Network, study: str | None, progress: Callable[[str, float], Any] | None = None) -> Result | Exception:
    """A function of the module, so that other processes can import it."""
    try:
        return actuator.run(study, progress=progress)
    except Exception as error:
        return error


def _found(run: "Future[Result | Exception]", actuator: Actuator | Network, study: str | None) -> Result | Exception:
    """The result of a run, or the exception of its lost worker. A run that never started becomes interrupted here."""
    if run.cancelled():
        return _run(actuator, study, lambda stage, fraction: True)
    error = run.exception()
    if error is None:
        return run.result()
    if isinstance(error, Exception):
        return error
    raise error


def _executor(given: Any) -> Any:
    """`given` as an executor of concurrent.futures: itself, or that of a Client of Dask."""
    executor = given.get_executor() if hasattr(given, "get_executor") else given
    if not callable(getattr(executor, "submit", None)):
        raise InputError(f"executor: takes an executor of concurrent.futures or a Client of Dask, not {type(given).__name__}")
    return executor


def run_batch(
    actuators: Iterable[Actuator] | Iterable[Network],
    study: str | None = None,
    *,
    workers: int | None = None,
    executor: Any = None,
    progress: Callable[[int, int], Any] | None = None,
    return_exceptions: bool = False,
) -> Batch:
    """Run a study on each actuator or network, as many at once as there are cores, or `workers`. The results equal those of separate
    runs to the last bit.

    A run that raises an exception, such as InputError if the study refuses its actuator, does not stop the others. When
    all runs have ended, run_batch raises BatchError, whose `batch` contains the other results. With
    return_exceptions=True, as in asyncio.gather, it returns that batch: the exception takes the place of the result.

    `executor` distributes the runs: an executor of concurrent.futures, such as ProcessPoolExecutor or mpi4py's
    MPIPoolExecutor, or a Client of Dask. It stays open. If a worker is lost, its run has the exception of the executor.

    `progress` is called with the number of finished runs and of all runs. If it returns true or raises an exception, or
    at Ctrl-C, the other runs stop, with the outcome interrupted; in an `executor`, running ones finish first.
    """
    given = [actuator.copy() if isinstance(actuator, Network) else actuator for actuator in actuators]
    for actuator in given:
        if not isinstance(actuator, (Actuator, Network)):
            raise InputError(f"run_batch: takes actuators or networks, not {type(actuator).__name__}")
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise InputError(f"workers = {workers!r}: takes a whole number of at least 1")
    if workers is not None and executor is not None:
        raise InputError("workers: not allowed with an executor, which has its own workers")
    stop = threading.Event()
    if executor is not None:
        pool, end, hooks = _executor(executor), nullcontext(), ()
    else:
        pool = end = ThreadPoolExecutor(workers or len(os.sched_getaffinity(0)))
        hooks = (lambda stage, fraction: stop.is_set(),)

    def stop_all() -> None:
        stop.set()
        for run in runs:
            run.cancel()

    with end:
        runs: list[Future[Result | Exception]] = []
        try:
            runs += (pool.submit(_run, actuator, study, *hooks) for actuator in given)
            for done, _ in enumerate(as_completed(runs), 1):
                if progress and progress(done, len(runs)):
                    stop_all()
        except BaseException:
            stop_all()
            raise
    batch = Batch((_found(run, actuator, study) for run, actuator in zip(runs, given, strict=True)), given)
    if batch.errors and not return_exceptions:
        raise BatchError(batch) from next(iter(batch.errors.values()))
    return batch
