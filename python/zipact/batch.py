"""Many runs at once, on all cores."""

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, as_completed
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

import numpy as np

from ._zipact import Error, InputError
from .actuator import Actuator
from .result import Result

if TYPE_CHECKING:
    import pandas


class Batch(Sequence[Result]):
    """Results in the order of their actuators. batch["zip_time_s"] is the array of a number of all of them, nan where a
    run has none. Where a run raised an exception, that is in the place of its result."""

    def __init__(self, results: Iterable[Result | Exception], actuators: Iterable[Actuator]) -> None:
        self.results = list(results)
        self.actuators = list(actuators)
        """what was run"""

    @property
    def errors(self) -> dict[int, Exception]:
        """the exceptions of runs that have no result, by their place"""
        return {i: found for i, found in enumerate(self.results) if isinstance(found, Exception)}

    def __getitem__(self, item: Any) -> Any:
        if isinstance(item, slice):
            return Batch(self.results[item], self.actuators[item])
        if not isinstance(item, str):
            return self.results[item]
        found = [result for result in self.results if isinstance(result, Result)]
        if found and not any(item in result for result in found):
            found[0][item]  # says what there is
        return np.array([result.get(item, np.nan) if isinstance(result, Result) else np.nan for result in self.results])

    def __len__(self) -> int:
        return len(self.results)

    def to_dataframe(self) -> "pandas.DataFrame":
        """A row for each run: the keys in which the actuators differ, the outcome, the numbers. A run without a result has
        the outcome error, and its message in column error."""
        import pandas

        varied = [key for key in (self.actuators or [()])[0] if len({a[key] for a in self.actuators}) > 1]
        rows: list[dict[str, Any]] = []
        for actuator, found in zip(self.actuators, self.results, strict=True):
            row = {key: actuator[key] for key in varied}
            answer = {"outcome": found.outcome} | dict(found) if isinstance(found, Result) else {"outcome": "error"}
            rows.append(row | answer | ({"error": str(found)} if isinstance(found, Exception) else {}))
        return pandas.DataFrame(rows)

    def __repr__(self) -> str:
        errors = len(self.errors)
        return f"<Batch of {len(self)} results{f', {errors} of them errors' if errors else ''}>"


class BatchError(Error):
    """Some runs of a batch raised exceptions; `batch` has them and the results of the others."""

    def __init__(self, batch: Batch) -> None:
        place, error = next(iter(batch.errors.items()))
        super().__init__(f"{len(batch.errors)} of {len(batch)} runs raised an exception; the first, run {place}: {error}")
        self.batch = batch

    def __reduce__(self) -> tuple[Any, ...]:
        return BatchError, (self.batch,)


def _run(actuator: Actuator, study: str | None, progress: Callable[[str, float], Any] | None = None) -> Result | Exception:
    """A function of the module, so that processes find it."""
    try:
        return actuator.run(study, progress=progress)
    except Exception as error:
        return error


def _found(run: "Future[Result | Exception]", actuator: Actuator, study: str | None) -> Result | Exception:
    """What a run has found, or why its worker was lost. One that never began is interrupted here."""
    if run.cancelled():
        return _run(actuator, study, lambda stage, fraction: True)
    error = run.exception()
    if error is None:
        return run.result()
    if isinstance(error, Exception):
        return error
    raise error


def _executor(given: Any) -> Any:
    """The executor of concurrent.futures that `given` is, or has, as a Client of Dask."""
    executor = given.get_executor() if hasattr(given, "get_executor") else given
    if not callable(getattr(executor, "submit", None)):
        raise InputError(f"executor: takes one of concurrent.futures or a Client of Dask, not {type(given).__name__}")
    return executor


def run_batch(
    actuators: Iterable[Actuator],
    study: str | None = None,
    *,
    workers: int | None = None,
    executor: Any = None,
    progress: Callable[[int, int], Any] | None = None,
    return_exceptions: bool = False,
) -> Batch:
    """Run a study on each actuator, as many at once as there are cores, or `workers`; the same bits as one by one.

    A run that raises an exception, as InputError where the study refuses its actuator, does not stop the others. When
    all have ended run_batch raises BatchError, whose `batch` holds what was found. With return_exceptions=True, as in
    asyncio.gather, it returns that batch: the exception is in the place of the result.

    `executor` runs them elsewhere: one of concurrent.futures, as ProcessPoolExecutor or mpi4py's MPIPoolExecutor, or a
    Client of Dask. It stays open. A run whose worker is lost has the exception that its executor gives.

    `progress` is called with the runs done and all runs; what it returns, if true, stops the rest, and so do Ctrl-C and
    an exception that it raises. What was stopped has the outcome interrupted; in an `executor`, runs that have begun
    end first.
    """
    actuators = list(actuators)
    for actuator in actuators:
        if not isinstance(actuator, Actuator):
            raise InputError(f"run_batch: takes actuators, not {type(actuator).__name__}")
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise InputError(f"workers = {workers!r}: takes a whole number from 1 on")
    if workers is not None and executor is not None:
        raise InputError("workers: an executor has its own")
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
            runs += (pool.submit(_run, actuator, study, *hooks) for actuator in actuators)
            for done, _ in enumerate(as_completed(runs), 1):
                if progress and progress(done, len(runs)):
                    stop_all()
        except BaseException:
            stop_all()
            raise
    batch = Batch((_found(run, actuator, study) for run, actuator in zip(runs, actuators, strict=True)), actuators)
    if batch.errors and not return_exceptions:
        raise BatchError(batch) from next(iter(batch.errors.values()))
    return batch
