"""Hold: a PI controller keeps the stroke of the hanging actuator at a target, below the voltage at which it pulls in.

    python3 hold.py [PICTURE]

The electric force goes with the square of the voltage, so the controller works on the square. The liquid's drag is not
modelled; a damping of the ribbons that is made up stands for it, without which no PI controller would calm them.
"""

import sys

import numpy as np
from matplotlib import pyplot as plt

import zipact

DT = 1e-3  # s, between two looks at the stroke
PROPORTIONAL = 1e10  # V^2 per m of error
INTEGRAL = 2e11  # V^2 per m of error and s
HIGHEST = 5.5e3  # V, below pull-in


def target(time: float) -> float:
    """m: two steps down, one half way back."""
    return 1e-3 * (10.1 if time < 0.8 else 9.4 if time < 1.6 else 9.8)


def hold(actuator: zipact.Actuator, end_time: float) -> np.ndarray:
    """Rows of time, target, stroke, voltage; SI."""
    simulation = zipact.Simulation(actuator)
    rows, integral = [], 0.0
    while simulation.time < end_time:
        stroke, aim = simulation["stroke"], target(simulation.time)
        error = stroke - aim  # too wide: more voltage
        wanted = PROPORTIONAL * error + INTEGRAL * (integral + error * DT)
        square = np.clip(wanted, 0, HIGHEST**2)
        if square == wanted:  # else the integral would wind up
            integral += error * DT
        voltage = float(np.sqrt(square))
        rows.append((simulation.time, aim, stroke, voltage))
        simulation.step(DT, voltage)
    return np.array(rows)


def main(picture: str = "hold.png") -> None:
    actuator = zipact.Actuator(load__mass="8 g", liquid__model="none", damping__internal="100 ms")
    pull_in = actuator.run("equilibrium")["pull_in_voltage_V"]
    time, aim, stroke, voltage = hold(actuator, end_time=2.4).T
    late = (time > 0.7) & (time < 0.8) | (time > 1.5) & (time < 1.6) | (time > 2.3)
    worst = np.abs(stroke - aim)[late].max()
    print(f"within {1e6 * worst:.2g} um of the target, 0.7 s after each of its steps,")
    print(f"by at most {voltage.max():.0f} V; it would pull in at {pull_in:.0f} V")

    figure, (upper, lower) = plt.subplots(2, sharex=True, figsize=(7, 4.5), layout="constrained")
    upper.plot(time, 1e3 * aim, color="#d55e00", linestyle="--", label="target")
    upper.plot(time, 1e3 * stroke, color="#0072b2", label="stroke")
    upper.set_ylabel("stroke / mm")
    upper.legend()
    lower.plot(time, 1e-3 * voltage, color="#0072b2")
    lower.axhline(1e-3 * pull_in, color="#999999", linestyle=":")
    lower.annotate("pull-in", (time[-1], 1e-3 * pull_in - 0.05), ha="right", va="top")
    lower.set(xlabel="time / s", ylabel="voltage / kV")
    for axes in (upper, lower):
        axes.grid(color="#dddddd")
    figure.savefig(picture)


if __name__ == "__main__":
    main(*sys.argv[1:])
