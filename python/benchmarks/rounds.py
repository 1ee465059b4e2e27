"""The actuator and the clock of the benchmarks beside this file: explicit steps of a fixed length, so that many steps in one
call and as many calls do the same in C."""

import time

import zipact

DT, MANY, ROUNDS = 1e-8, 2000, 60


def simulation() -> zipact.Simulation:
    return zipact.Simulation(
        zipact.Actuator(mesh__nodes=21, solver__time_step=DT, solver__integrator="explicit", contact__model="sequential")
    )


def best_of_rounds(work) -> float:
    """us per step of MANY; best of several rounds"""
    times = []
    for _ in range(ROUNDS):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return 1e6 * min(times) / MANY
