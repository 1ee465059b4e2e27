"""Many runs at once, on all cores."""

import os
import threading
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from typing import TYPE_CHECKING, Any

import numpy as np

from ._zipact import InputError
from .actuator import Actuator
from .result import Result

if TYPE_CHECKING:
    import pandas


class Batch(Sequence[Result]):
    """Results in the order of their actuators. batch["zip_time_s"] is the array of a number of all of them, nan where a
    run has none."""

    def __init__(self, results: Iterable[Result]) -> None:
        self.results = list(results)

    def __getitem__(self, item: Any) -> Any:
        if isinstance(item, str):
            if self.results and not any(item in result for result in self.results):
                self.results[0][item]  # says what there is
            return np.array([result.get(item, np.nan) for result in self.results])
        return Batch(self.results[item]) if isinstance(item, slice) else self.results[item]

    def __len__(self) -> int:
        return len(self.results)

    def to_dataframe(self) -> "pandas.DataFrame":
        """A row for each run: the keys in which the actuators differ, the outcome, the numbers."""
        import pandas

        actuators = [result.actuator for result in self.results]
        varied = [key for key in actuators[0] if len({a[key] for a in actuators}) > 1] if actuators else []
        return pandas.DataFrame(
            {key: result.actuator[key] for key in varied} | {"outcome": result.outcome} | dict(result)
            for result in self.results
        )

    def __repr__(self) -> str:
        return f"<Batch of {len(self)} results>"


def run_batch(
    actuators: Iterable[Actuator],
    study: str | None = None,
    *,
    workers: int | None = None,
    progress: Callable[[int, int], Any] | None = None,
) -> Batch:
    """Run a study on each actuator, as many at once as there are cores, or `workers`; the same bits as one by one.

    `progress` is called with the runs done and all runs; what it returns, if true, stops the rest, and so does an
    exception. What was stopped has the outcome interrupted.
    """
    actuators = list(actuators)
    for actuator in actuators:
        if not isinstance(actuator, Actuator):
            raise InputError(f"run_batch: takes actuators, not {type(actuator).__name__}")
    if workers is not None and (not isinstance(workers, int) or workers < 1):
        raise InputError(f"workers = {workers!r}: takes a whole number from 1 on")
    stop = threading.Event()
    with ThreadPoolExecutor(workers or len(os.sched_getaffinity(0))) as pool:
        runs = [pool.submit(a.run, study, progress=lambda stage, fraction: stop.is_set()) for a in actuators]
        try:
            for done, run in enumerate(as_completed(runs), 1):
                run.result()
                if progress and progress(done, len(runs)):
                    stop.set()
        except BaseException:
            stop.set()
            pool.shutdown(cancel_futures=True)
            raise
    return Batch(run.result() for run in runs)
