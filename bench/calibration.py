#!/usr/bin/env python3
"""Synthetic benches for study calibrate: is the fit the true one, does it say so where it is not, do intervals cover?

    bench/calibration.py COMMAND [COUNT [SEED]]

Each bench is a random actuator, dry or in a bath, with 21 nodes and two or three unknown keys, maybe an unknown reading of
zero. The record has 50 to 500 frames with voltage, closing, maybe release, and normal noise; it was computed with steps far
finer than those of the fit. "right": the sum of squares is at most 0.1 % above that at the true values, where only the shifts
are fitted. "identifiable": all keys have an interval.
"""
import bisect
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile

# key: unit, value from which a fit starts, the true one as a multiple of it
KEYS = {
    "ribbon.young_modulus": ("GPa", 200, 0.85, 1.15),
    "ribbon.thickness": ("um", 50, 0.92, 1.08),
    "medium.permittivity": ("", 2.75, 0.85, 1.15),
    "medium.kinematic_viscosity": ("mm2/s", 50, 0.4, 2.2),
}


def number(text, unit):
    return float(text) * {"GPa": 1e9, "um": 1e-6, "mm2/s": 1e-6, "": 1}[unit]


def line(points, t):
    """The value at t of a line through points (time, value)."""
    i = bisect.bisect_right([p[0] for p in points], t)
    if i in (0, len(points)):
        return points[min(i, len(points) - 1)][1]
    (t0, y0), (t1, y1) = points[i - 1], points[i]
    return y0 + (y1 - y0) * (t - t0) / (t1 - t0)


class Bench:
    def __init__(self, seed):
        rnd = self.rnd = random.Random(seed)
        self.seed = seed
        self.bath = rnd.random() < 0.6
        self.end = 0.3 if self.bath else 0.15
        self.base = {"mesh.nodes": 21, "liquid.model": "submerged" if self.bath else "none", "load.mass": f"{rnd.uniform(4, 14):.2f} g"}
        names = [key for key in KEYS if self.bath or key != "medium.kinematic_viscosity"]
        self.keys = rnd.sample(names, rnd.choice([2, 2, 3]))
        self.true = {key: KEYS[key][1] * rnd.uniform(*KEYS[key][2:]) for key in self.keys}
        high, hold = rnd.uniform(6.5, 9), 0.6 * self.end
        self.voltage = [(0, 0), (0.005, 0), (0.008, high)]
        if rnd.random() < 0.5:
            self.voltage += [(hold, high), (hold + 0.01, 0)]
        self.frames = rnd.choice([50, 100, 200, 500])
        self.noise = rnd.choice([0.02, 0.05, 0.1])  # mm
        self.zero = rnd.uniform(-0.4, 0.4) if rnd.random() < 0.5 else None  # mm

    def scenario(self, folder, name, values, more):
        lines = {**self.base, **{key: f"{values[key]!r} {KEYS[key][0]}".strip() for key in self.keys}, **more}
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"{key}: {value}\n" for key, value in lines.items())
        return path

    def record(self, command, folder):
        """Computes the run and writes what a camera sees of it."""
        times = [self.end * i / (self.frames - 1) for i in range(self.frames)]
        volts = [line(self.voltage, t) for t in times]
        with open(os.path.join(folder, "drive.csv"), "w", encoding="utf-8") as file:
            file.write("time_s,voltage_kV\n" + "".join(f"{t!r},{u!r}\n" for t, u in zip(times, volts)))
        more = {"study": "actuate", "drive.waveform": "table", "drive.file": "drive.csv", "solver.end_time": f"{self.end} s",
                "solver.tolerance": 1e-5, "solver.stop_when_zipped": "false", "output.samples": 20000, "output.errors": "false"}
        run(command, self.scenario(folder, "truth.yaml", self.true, more), os.path.join(folder, "truth"))
        with open(os.path.join(folder, "truth", "table.csv"), newline="", encoding="utf-8") as file:
            strokes = [(float(row["time_s"]), float(row["stroke_m"])) for row in csv.DictReader(file)]
        with open(os.path.join(folder, "record.csv"), "w", encoding="utf-8") as file:
            file.write("Time (s),Voltage [kV],Displacement / mm\n")
            for t, u in zip(times, volts):
                moved = 1e3 * (strokes[0][1] - line(strokes, t)) + (self.zero or 0) + self.rnd.gauss(0, self.noise)
                file.write(f"{t!r},{u!r},{moved!r}\n")

    def fit(self, command, folder, values, keys):
        more = {"study": "calibrate", "data.file": "record.csv", "calibrate.fit": "'" + ", ".join(keys) + "'"}
        if self.zero is not None:
            more["calibrate.offsets"] = "displacement"
        name = "fit" if keys else "true"
        return run(command, self.scenario(folder, name + ".yaml", values, more), os.path.join(folder, name))


def run(command, scenario, out):
    subprocess.run([command, "run", scenario, "-o", out, "--quiet", "--no-plots"], capture_output=True, check=False)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def of(summary, key):
    group, name = key.split(".")
    return summary[group][name], summary[group][name + "_interval_95"]


def main():
    command = os.path.abspath(sys.argv[1])
    count, seed = (int(text) for text in (sys.argv[2:] + ["20", "1"][len(sys.argv) - 2:])[:2])
    tally = {"right": 0, "doubtful": 0, "wrong": 0, "not identifiable": 0}
    covered = {key: [0, 0] for key in KEYS}
    for k in range(seed, seed + count):
        bench = Bench(k)
        with tempfile.TemporaryDirectory() as folder:
            bench.record(command, folder)
            start = os.times()
            fit = bench.fit(command, folder, {key: KEYS[key][1] for key in bench.keys}, bench.keys)
            end = os.times()
            true = bench.fit(command, folder, bench.true, [])
        if not all(key.split(".")[0] in fit for key in bench.keys) or fit.get("residual_rms_m") is None:
            verdict = "doubtful" if fit["outcome"] != "converged" else "wrong"
            above, told = math.nan, fit["message"]
        else:
            values = {key: of(fit, key) for key in bench.keys}
            bounded = all(None not in interval for _, interval in values.values())
            above = (fit["residual_rms_m"] / true["residual_rms_m"]) ** 2 - 1
            verdict = ("doubtful" if fit["outcome"] == "doubtful" else "not identifiable" if not bounded else
                       "right" if above <= 1e-3 else "wrong")
            told = ""
            for key, (value, (low, high)) in values.items():
                truth = number(bench.true[key], KEYS[key][0])
                told += f"  {key} {value / truth - 1:+.4f}"
                if low is not None and high is not None and fit["outcome"] == "converged":
                    covered[key][0] += low <= truth <= high
                    covered[key][1] += 1
        tally[verdict] += 1
        spent = end.children_user - start.children_user
        print(f"{k:6} {'bath' if bench.bath else 'dry':4} {bench.frames:3} frames {bench.noise:4} mm  {verdict:16} squares {above:+.1e}  {spent:5.1f} s{told}", flush=True)
    print(", ".join(f"{value} {name}" for name, value in tally.items()))
    missed = sum(b - a for a, b in covered.values())
    print("intervals that cover the true value: " + ", ".join(f"{key} {a} of {b}" for key, (a, b) in covered.items() if b))
    if tally["wrong"] > max(1, count // 50) or missed > max(3, sum(b for _, b in covered.values()) // 8):
        sys.exit("too many fits are wrong, or intervals miss the true value")


if __name__ == "__main__":
    main()
