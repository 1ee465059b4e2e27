"""What a step costs from Python beyond the same step in C:  python3 step.py

The integrator's step is held at DT, so that one call of step(DT) and each of the many steps inside one call of
step(MANY * DT) do the same in C; the difference is the call. Best of several rounds.
"""

import numpy as np
import rounds
import zipact
from rounds import DT, MANY, best_of_rounds


def main() -> None:
    simulation = rounds.simulation()
    out = np.empty(len(zipact.SIGNALS))

    def calls():
        for _ in range(MANY):
            simulation.step(DT)

    def calls_with_voltage():
        for i in range(MANY):
            simulation.step(DT, 5e3 + (i & 1))

    def one_signal():
        for _ in range(MANY):
            simulation["stroke"]

    def all_signals():
        for _ in range(MANY):
            simulation.read(out)

    in_c = best_of_rounds(lambda: simulation.step(MANY * DT))
    in_python = best_of_rounds(calls)
    print(f"step in C                    {in_c:7.3f} us")
    print(f"step called from Python      {in_python:7.3f} us, {in_python - in_c:.3f} us beyond")
    print(f"the same, voltage changed    {best_of_rounds(calls_with_voltage):7.3f} us, with the work of a jump in C")
    print(f'simulation["stroke"]         {best_of_rounds(one_signal):7.3f} us')
    print(f"simulation.read(out)         {best_of_rounds(all_signals):7.3f} us, all {len(out)} signals")


if __name__ == "__main__":
    main()
