"""A lever: an actuator lifts a beam on a pin, which a spring helps to carry. A film of a run, then the same by steps: the
program holds an angle while a hand pushes the beam down.

    python3 lever.py [FILM]
"""

import sys

import numpy as np

import zipact

PERIOD = 1e-3  # s, between two looks at the angle
INTEGRAL = 1e6  # V per rad of error and s
HIGHEST = 5e3  # V
TARGET = np.radians(1.5)


def lever() -> zipact.Network:
    network = zipact.Network(drive={"voltage": "4 kV", "waveform": "ramp", "rise_time": "0.2 s"}, mesh__nodes=21)
    network["damping"] = {"drag": "0.02 N s2/m2", "internal": "20 ms"}
    network.bodies["beam"] = {"moves": "plane", "mass": "10 g", "inertia": "6000 g mm2", "at": [0, "-8 mm"]}
    network.joints["pivot"] = {"type": "pin", "between": ["frame", "beam"], "at": ["-80 mm", "-8 mm"]}
    network.members["lift"] = {"upper": "frame", "lower": "beam"}
    network.springs["coil"] = {"between": ["frame", "beam"], "from_at": ["70 mm", "12 mm"], "to_at": ["70 mm", 0]}
    network.springs["coil"] |= {"stiffness": "5 N/m", "rest": "12 mm"}
    return network


def hold(network: zipact.Network, end_time: float) -> np.ndarray:
    """Rows of time, angle, voltage; SI. From half the time on a force acts on the beam."""
    simulation, rows, voltage = zipact.Simulation(network), [], 0.0
    while simulation.time < end_time:
        voltage = float(np.clip(voltage + INTEGRAL * PERIOD * (TARGET - simulation["beam.angle"]), 0, HIGHEST))
        simulation.set_input("voltage", voltage)
        simulation.set_input("beam.force_y", "-10 mN" if simulation.time > end_time / 2 else 0.0)
        simulation.step(PERIOD)
        rows.append((simulation.time, simulation["beam.angle"], simulation["lift.voltage"]))
    return np.array(rows)


def main(film: str = "lever.gif") -> None:
    network = lever()
    result = network.run("actuate", solver__end_time=0.4, output__shapes=200)
    result.animate(frames=50).save(film, dpi=60)
    time, angle, voltage = hold(network, end_time=2.0).T
    before, after = (np.abs(time - instant) < 0.05 for instant in (0.95, 1.95))
    worst = np.abs(angle - TARGET)[before | after].max()
    print(f"within {np.degrees(worst):.2g} degrees of {np.degrees(TARGET):.2g}, by {voltage[before].mean():.0f} V,")
    print(f"and by {voltage[after].mean():.0f} V against the hand")


if __name__ == "__main__":
    main(*sys.argv[1:])
