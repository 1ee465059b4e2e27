"""What a sample of a controller of one's own costs from Python beyond the steps themselves:  python3 control.py

The same explicit steps with a controller that does nothing, one sample a step, and in one call without any; best of
several rounds. Reading a signal is part of the controller itself.
"""

import rounds
import zipact
from rounds import DT, MANY, best_of_rounds


def main() -> None:
    simulation = rounds.simulation()
    voltage = simulation["voltage"]

    def nothing(_: zipact.Simulation) -> float:
        return voltage

    in_c = best_of_rounds(lambda: simulation.step(MANY * DT))
    sampled = best_of_rounds(lambda: simulation.control(nothing, DT, simulation.time + MANY * DT))
    call = best_of_rounds(lambda: [nothing(simulation) for _ in range(MANY)])
    print(f"step in C                       {in_c:7.3f} us")
    print(f"step that begins with a sample  {sampled:7.3f} us")
    print(f"the controller's own call       {call:7.3f} us")
    print(f"a sample beyond the controller  {sampled - in_c - call:7.3f} us")


if __name__ == "__main__":
    main()
