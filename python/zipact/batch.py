"""Many runs at once, on all cores."""

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
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


def run_batch(
    actuators: Iterable[Actuator],
    study: str | None = None,
    *,
    workers: int | None = None,
    progress: Callable[[int, int], Any] | None = None,
    return_exceptions: bool = False,
) -> Batch:
    """Run a study on each actuator, as many at once as there are cores, or `workers`; the same bits as one by one.

    A run that raises an exception, as InputError where the study refuses its actuator, does not stop the others. When
    all have ended run_batch raises BatchError, whose `batch` holds what was found. With return_exceptions=True, as in
    asyncio.gather, it returns that batch: the exception is in the place of the result.

    `progress` is called with the runs done and all runs; what it returns, if true, stops the rest, and so do Ctrl-C and
    an exception that it raises. What was stopped has the outcome interrupted.
    """
    actuators = list(actuators)
    for actuator in actuators:
        if not isinstance(actuator, Actuator):
            raise InputError(f"run_batch: takes actuators, not {type(actuator).__name__}")
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise InputError(f"workers = {workers!r}: takes a whole number from 1 on")
    stop = threading.Event()

    def run(actuator: Actuator) -> Result | Exception:
        try:
            return actuator.run(study, progress=lambda stage, fraction: stop.is_set())
        except Exception as error:
            return error

    with ThreadPoolExecutor(workers or len(os.sched_getaffinity(0))) as pool:
        runs = [pool.submit(run, actuator) for actuator in actuators]
        try:
            for done, _ in enumerate(as_completed(runs), 1):
                if progress and progress(done, len(runs)):
                    stop.set()
        except BaseException:
            stop.set()
            pool.shutdown(cancel_futures=True)
            raise
    batch = Batch((run.result() for run in runs), actuators)
    if batch.errors and not return_exceptions:
        raise BatchError(batch) from next(iter(batch.errors.values()))
    return batch
