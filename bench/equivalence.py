#!/usr/bin/env python3
"""Do two builds of the command give the same numbers?  bench/equivalence.py OLD NEW [COUNT [SEED]]

OLD and NEW are the two commands. COUNT (600) random designs with random features from SEED (1) are computed, each by one
study. At rest a number may differ by 1e-9 of its size; in motion also by ten times what a load larger by 1e-13 changes,
since contact magnifies rounding. Errors, residuals, counts and wall times are left out. For each design that differs more,
the number that differs most and the settings are printed, and the status is 1. Standard library only.
"""

import collections
import json
import math
import random
import subprocess
import sys

LEAST, NUDGE, TIMES = 1e-9, 1e-13, 10  # of a number; of the load; what this changes

TURNS = {"platform.rotates": True, "platform.electrode": False, "actuator.symmetry": "none"}
# A design has at most two.
FEATURES = [
    {"liquid.model": "submerged"},
    {"liquid.model": "bead", "bead.volume": 50e-9},
    {"ribbon.plasticity": True},
    {"ribbon.plane": "anticlastic"},
    {"electro.edges": True},
    {"electro.model": "field"},
    {"ribbon.model": "mass_spring"},
    {"actuator.kind": "ribbon"},
    {"actuator.kind": "flange"},
    {"actuator.kind": "hinge"},
    {"actuator.symmetry": "none"},
    {"mount.tilt": 0.3, "actuator.symmetry": "none"},
    TURNS,
    {"load.offset": 1e-3, **TURNS},
    {"source.model": "amplifier", "source.supply": "laboratory_10kv"},
    {"source.model": "amplifier", "source.resistance": 1e7},
    {"stack.parallel": 2},
    {"stack.series": 2},
    {"stack.series": 2, "stack.distance": 0.05},
    {"stack.parallel": 2, "member_1.ribbon.thickness": 90e-6},
    {"stack.series": 2, "member_2.ribbon.thickness": 110e-6},
    {"load.stiffness": 20},
    {"load.stop_opening": 2e-3},
    {"load.change_time": 0.01, "load.change_mass": 1e-3},
    {"segment_1.length": 8e-3, "segment_1.thickness": 250e-6},
    {"lower.ribbon.thickness": 80e-6},
    {"segment_1.length": 10e-3, "segment_1.curvature": 3},
    {"medium.resistivity": 1e11, "insulator.resistivity": 1e13},
    {"sense.frequency": 1e4, "sense.amplitude": 10, "sense.sampling_rate": 2e5},
    {"control.kind": "pi", "control.integral": 1e6, "setpoint.value": 5e-3},
    {"solver.integrator": "explicit", "contact.model": "sequential", "ribbon.model": "mass_spring"},
    {"preset": "paper-code", "mesh.nodes": 21},
    {"sensitivity.by": "load.mass"},
]
# How often each is drawn.
STUDIES = {"actuate": 4, "stationary": 2, "equilibrium": 3, "limits": 3, "isometric": 2, "modes": 2, "profile": 1, "cycle": 1}
LEFT_OUT = ("error", "residual", "wall", "steps", "iterations", "rejected", "failures", "time_step", "evaluations", "bound",
            "real_time")


def design(draw):
    def log(low, high):
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    length = log(20e-3, 200e-3)
    case = {"study": draw.choices(list(STUDIES), STUDIES.values())[0], "ribbon.length": length,
            "ribbon.thickness": log(20e-6, 300e-6), "ribbon.width": log(5e-3, 30e-3), "load.mass": log(0.3e-3, 0.3),
            "insulator.thickness": log(20e-6, 300e-6), "platform.length": 0.1 * length,
            "drive.voltage": draw.uniform(1e3, 10e3), "mesh.nodes": draw.choice([11, 15, 21, 31]), "liquid.model": "none",
            "output.errors": False, "solver.max_cpu_time": 20}
    for feature in draw.sample(FEATURES, draw.choice([0, 1, 1, 2, 2])):
        case.update(feature)
    if case["study"] in ("isometric", "profile"):
        case["isometric.separation"] = length * log(3e-3, 0.3)
    if case["study"] == "actuate":
        case["solver.end_time"] = 0.05
    if case["study"] == "cycle":
        case.update({"drive.waveform": "sine", "drive.frequency": draw.uniform(5, 50), "drive.voltage": 1000})
    return case


def answers(program, cases):
    text = "".join(json.dumps(case) + "\n" for case in cases)
    done = subprocess.run([program, "batch", "--quiet"], input=text, stdout=subprocess.PIPE, text=True)
    found = [json.loads(line) for line in done.stdout.splitlines()]
    if len(found) != len(cases):
        raise SystemExit(f"{program}: {len(found)} answers to {len(cases)} cases")
    return found


def numbers(value, path=""):
    """(place, number) of all that counts in an answer."""
    if isinstance(value, dict):
        for key, part in value.items():
            if not any(word in key for word in LEFT_OUT):
                yield from numbers(part, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for k, part in enumerate(value):
            yield from numbers(part, f"{path}[{k}]")
    elif not isinstance(value, str) or path == "outcome":
        yield path, value


def apart(one, two):
    """{place: difference over the larger number} of two answers where they differ; inf where only one has a number."""
    one, two = dict(numbers(one)), dict(numbers(two))
    found = {}
    for path in sorted(set(one) | set(two)):
        a, b = one.get(path), two.get(path)
        if a != b:
            real = isinstance(a, (int, float)) and isinstance(b, (int, float))
            found[path] = abs(a - b) / max(abs(a), abs(b)) if real else math.inf
    return found


def main():
    old, new = sys.argv[1:3]
    count, seed = (int(word) for word in (sys.argv[3:] + ["600", "1"][len(sys.argv) - 3:]))
    draw = random.Random(seed)
    cases = [design(draw) for _ in range(count)]
    before, after = answers(old, cases), answers(new, cases)
    moved = [apart(one, two) for one, two in zip(before, after)]
    differ = [k for k in range(count) if any(part > LEAST for part in moved[k].values())]
    nudged = answers(old, [{**cases[k], "load.mass": cases[k]["load.mass"] * (1 + NUDGE)} for k in differ])
    worse = 0
    for k, other in zip(differ, nudged):
        noise = apart(before[k], other)
        bad = [(part, path) for path, part in moved[k].items() if part > max(LEAST, TIMES * noise.get(path, 0))]
        if bad:
            worse += 1
            print("%s differs by %.1e:" % max(bad)[::-1], *(f"--set {key}={json.dumps(value)}" for key, value in cases[k].items()))
    outcomes = collections.Counter(answer.get("outcome", "refused") for answer in before)
    print(f"{count} designs, {worse} differ, {len(differ) - worse} by rounding only; {dict(outcomes)}")
    return worse > 0


if __name__ == "__main__":
    sys.exit(main())
