#!/usr/bin/env python3
"""Synthetic benches for study calibrate: is the fit the true one, does it say so where it is not, do intervals cover?

    bench/calibration.py COMMAND [COUNT [SEED]] [--lacks]

Each bench is a random actuator with 21 nodes, dry, in a bath or with beads of liquid. Two to four of its keys and of the
shifts of its record are unknown, at least one a key. The record has 50 to 500 frames with voltage, closing, maybe release,
and normal noise; it was computed with steps far finer than those of the fit. "right": the sum of squares is at most 0.1 %
above that at the true values, where nothing is fitted. "identifiable": all keys have an interval.

With --lacks the data obey one law that the fitted model lacks: leaking charge, the field at the edges, or a tape that
softens. "off": the values that fit best without noise miss the data by that many standard deviations of the noise, as the
root of the sum over the rows; below about 4 no test can tell it from noise.
"""
import argparse
import bisect
import csv
import json
import math
import os
import random
import subprocess
import sys
import tempfile

ALL = ("none", "submerged", "bead")
# key: unit, value from which a fit starts, the true one as a multiple of it, the liquids in which it matters
KEYS = {
    "ribbon.young_modulus": ("GPa", 200, 0.85, 1.15, ALL),
    "ribbon.thickness": ("um", 50, 0.92, 1.08, ALL),
    "medium.permittivity": ("", 2.75, 0.85, 1.15, ALL),
    "medium.kinematic_viscosity": ("mm2/s", 50, 0.4, 2.2, ("submerged", "bead")),
    "bead.volume": ("uL", 0.3, 0.5, 2, ("bead",)),
    "damping.internal": ("us", 100, 0.4, 2.2, ("none", "bead")),
}
SCALE = {"GPa": 1e9, "um": 1e-6, "mm2/s": 1e-6, "uL": 1e-9, "us": 1e-6, "s": 1, "mm": 1e-3, "": 1}
SHIFTS = {"time_offset": ("s", 0.004), "displacement_offset": ("mm", 0.4)}  # at most so large

# what the data have and the fitted model lacks
LAWS = {
    "leakage": lambda rnd: {"insulator.resistivity": f"{10 ** rnd.uniform(9, 10)} ohm m", "medium.resistivity": "1e10 ohm m"},
    "edges": lambda rnd: {"electro.edges": "true"},
    "tape": lambda rnd: {"insulator.relaxation_modulus": f"{rnd.uniform(0.2, 0.6)} GPa", "insulator.relaxation_time": f"{rnd.uniform(0.01, 0.05)} s"},
}


def line(points, t):
    """The value at t of a line through points (time, value)."""
    i = bisect.bisect_right([p[0] for p in points], t)
    if i in (0, len(points)):
        return points[min(i, len(points) - 1)][1]
    (t0, y0), (t1, y1) = points[i - 1], points[i]
    return y0 + (y1 - y0) * (t - t0) / (t1 - t0)


class Bench:
    def __init__(self, seed, lacks):
        rnd = self.rnd = random.Random(seed)
        self.liquid = rnd.choice(ALL)
        self.end = 0.25 if self.liquid == "none" else 0.3
        self.base = {"mesh.nodes": 21, "liquid.model": self.liquid, "load.mass": f"{rnd.uniform(4, 14):.2f} g"}
        if self.liquid == "none":  # strips with tapes, which damp
            self.base["damping.internal"] = "100 us"
        names = [key for key in KEYS if self.liquid in KEYS[key][4]]
        self.keys, shifts, count = [], [], rnd.choice([2, 3, 4])
        while not self.keys:
            drawn = rnd.sample(names + list(SHIFTS), count)
            self.keys, shifts = [name for name in drawn if name in KEYS], [name for name in drawn if name in SHIFTS]
        self.true = {key: KEYS[key][1] * rnd.uniform(*KEYS[key][2:4]) for key in self.keys}
        self.shift = {name: rnd.uniform(-1, 1) * SHIFTS[name][1] for name in shifts}
        self.releases = rnd.random() < 0.5
        self.raise_to(rnd.uniform(6.5, 9))
        self.frames = rnd.choice([50, 100, 200, 500])
        self.noise = rnd.choice([0.02, 0.05, 0.1])  # mm
        self.law = rnd.choice(list(LAWS)) if lacks else ""
        self.more = LAWS[self.law](rnd) if lacks else {}

    def raise_to(self, high):
        hold = 0.6 * self.end
        self.high = high
        self.voltage = [(0, 0), (0.005, 0), (0.008, high)] + ([(hold, high), (hold + 0.01, 0)] if self.releases else [])

    def truth(self, name):
        unit = KEYS[name][0] if name in KEYS else SHIFTS[name][0]
        return (self.true[name] if name in KEYS else self.shift[name]) * SCALE[unit]

    def scenario(self, folder, name, values, more):
        lines = {**self.base, **{key: f"{values[key]!r} {KEYS[key][0]}".strip() for key in self.keys}, **more}
        path = os.path.join(folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"{key}: {value}\n" for key, value in lines.items())
        return path

    def motion(self, command, folder, times):
        """The true run: time, s, and stroke, m."""
        with open(os.path.join(folder, "drive.csv"), "w", encoding="utf-8") as file:
            file.write("time_s,voltage_kV\n" + "".join(f"{t!r},{line(self.voltage, t)!r}\n" for t in times))
        more = {"study": "actuate", "drive.waveform": "table", "drive.file": "drive.csv", "solver.end_time": f"{self.end + 0.005} s",
                "solver.tolerance": 1e-5, "solver.stop_when_zipped": "false", "output.samples": 20000, "output.errors": "false"}
        run(command, self.scenario(folder, "truth.yaml", self.true, {**more, **self.more}), os.path.join(folder, "truth"))
        with open(os.path.join(folder, "truth", "table.csv"), newline="", encoding="utf-8") as file:
            return [(float(row["time_s"]), float(row["stroke_m"])) for row in csv.DictReader(file)]

    def record(self, command, folder):
        """Writes what a camera sees of a run that closes, and the same without noise."""
        times = [self.end * i / (self.frames - 1) for i in range(self.frames)]
        late, zero = self.shift.get("time_offset", 0), self.shift.get("displacement_offset", 0)
        strokes = self.motion(command, folder, times)
        while min(y for _, y in strokes) > 0.3 * strokes[0][1]:
            self.raise_to(1.1 * self.high)
            strokes = self.motion(command, folder, times)
        with open(os.path.join(folder, "record.csv"), "w", encoding="utf-8") as seen, open(os.path.join(folder, "clean.csv"), "w", encoding="utf-8") as clean:
            for file in seen, clean:
                file.write("Time (s),Voltage [kV],Displacement / mm\n")
            for t in times:
                moved = 1e3 * (strokes[0][1] - line(strokes, t - late)) + zero
                volts = line(self.voltage, t)
                clean.write(f"{t!r},{volts!r},{moved!r}\n")
                seen.write(f"{t!r},{volts!r},{moved + self.rnd.gauss(0, self.noise)!r}\n")

    def fit(self, command, folder, name, values, data="record.csv"):
        more = {"study": "calibrate", "data.file": data, "calibrate.fit": "'" + ", ".join(self.keys) + "'"}
        if self.shift:
            more["calibrate.offsets"] = "'" + "; ".join(shift.replace("_offset", "") for shift in self.shift) + "'"
        return run(command, self.scenario(folder, name + ".yaml", values, more), os.path.join(folder, name))

    def squares_of_noise(self, folder):
        """Sum of squares of the noise, m2: that at the true values."""
        rows = []
        for name in "record.csv", "clean.csv":
            with open(os.path.join(folder, name), newline="", encoding="utf-8") as file:
                rows.append([float(row[2]) for row in list(csv.reader(file))[1:]])
        return 1e-6 * sum((a - b) ** 2 for a, b in zip(*rows))


def run(command, scenario, out):
    subprocess.run([command, "run", scenario, "-o", out, "--quiet", "--no-plots"], capture_output=True, check=False)
    with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def of(summary, name):
    """The value of a key or shift in a summary, and its interval."""
    group, _, last = name.rpartition(".")
    numbers = summary[group] if group else summary
    return numbers[last], numbers[last + "_interval_95"]


def judge(bench, fit, noise):
    """=> verdict, excess of the sum of squares, whether each unknown's interval has its true value."""
    if fit.get("residual_rms_m") is None:
        return fit["outcome"], math.nan, {}
    values = {name: of(fit, name) for name in [*bench.keys, *bench.shift]}
    above = fit["residual_rms_m"] ** 2 * bench.frames / noise - 1
    bounded = all(interval and None not in interval for _, interval in values.values())
    covers = {name: interval[0] <= bench.truth(name) <= interval[1] for name, (_, interval) in values.items() if interval and None not in interval}
    if fit["outcome"] not in ("converged", "at_bound"):
        return fit["outcome"], above, covers
    return "wrong" if above > 1e-3 else "right" if bounded else "not identifiable", above, covers


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("count", nargs="?", type=int, default=20)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--lacks", action="store_true")
    given = parser.parse_args()
    command = os.path.abspath(given.command)
    tally, covered, flagged = {}, {}, {}
    for k in range(given.seed, given.seed + given.count):
        bench = Bench(k, given.lacks)
        with tempfile.TemporaryDirectory() as folder:
            bench.record(command, folder)
            noise = bench.squares_of_noise(folder)
            start = os.times()
            fit = bench.fit(command, folder, "fit", {key: KEYS[key][1] for key in bench.keys})
            spent = os.times().children_user - start.children_user
            verdict, above, covers = judge(bench, fit, noise)
            told = ""
            if bench.law:
                best = bench.fit(command, folder, "clean", bench.true, "clean.csv")
                off = (best["residual_rms_m"] or math.nan) * bench.frames**0.5 / (1e-3 * bench.noise)
                told = f"  {bench.law} off {off:.1f}"
                of_law = flagged.setdefault(bench.law, [0, 0, 0, 0])
                of_law[0] += verdict in ("doubtful", "not_settled", "at_bound")
                of_law[1] += 1
                if off > 6:
                    of_law[2] += verdict in ("doubtful", "not_settled", "at_bound")
                    of_law[3] += 1
        tally[verdict] = tally.get(verdict, 0) + 1
        for name, has in covers.items():
            if not bench.law and fit["outcome"] == "converged":
                covered.setdefault(name, []).append(has)
        if fit.get("residual_rms_m") is not None:
            told += "".join(f"  {name} {of(fit, name)[0] / bench.truth(name) - 1:+.4f}{'' if covers.get(name, True) else '!'}" for name in [*bench.keys, *bench.shift])
        told += "".join("\n         " + text for text in fit.get("notes", []) if verdict != "right" and "columns" not in text and "beyond" not in text)
        print(f"{k:6} {bench.liquid:9} {bench.frames:3} frames {bench.noise:4} mm {verdict:16} squares {above:+.1e} {spent:6.1f} s{told}", flush=True)
    report(given.count, tally, covered, flagged)


def report(count, tally, covered, flagged):
    print(f"\n{count} benches: " + ", ".join(f"{number} {name}" for name, number in sorted(tally.items())))
    for law, (seen, all_of, seen_plain, plain) in sorted(flagged.items()):
        print(f"| {law} | flagged {seen} of {all_of} | of those off by more than 6: {seen_plain} of {plain} |")
    if flagged:
        return
    print("| unknown | intervals | cover the true value |\n|---|---|---|")
    for name, has in covered.items():
        print(f"| {name} | {len(has)} | {100 * sum(has) / len(has):.1f} % |")
    every = [has for of_name in covered.values() for has in of_name]
    print(f"| all | {len(every)} | {100 * sum(every) / max(len(every), 1):.1f} % |")
    missed = len(every) - sum(every)
    if tally.get("wrong", 0) > count // 50 or missed > max(3, len(every) // 8):
        sys.exit("too many fits are wrong, or intervals miss the true value")


if __name__ == "__main__":
    main()
