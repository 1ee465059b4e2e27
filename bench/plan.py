#!/usr/bin/env python3
"""Synthetic benches for study plan: how many measurements on an even grid tell as much as a few planned ones?

    bench/plan.py COMMAND [COUNT [SEED]] [--best]

Each bench is a random dry actuator with 21 nodes at rest or closing, of which two or three keys are unknown. It can measure
one or two of: strokes under loads and voltages, pull-in voltages under loads, zip times under loads and voltages, with a
standard deviation each. The plan is made at values of the keys that are up to 15 % wrong; planned rows and even grids are
then judged at the true ones. A grid of n rows has as many loads as voltages, as nearly as n allows, its ends are those of
the list, and of two kinds half each. The least n counts whose error of all keys together (the criterion D) is at most that
of the plan ("together"), and the least whose every key has an interval at most as wide as the plan's ("in each key"). "of
the list": how many evenly spaced rows of the list do as well together, as study plan says itself. Grids end at a number of
rows; where none is as good, that number counts.

With --best the plan is made at the true values and may take rows repeatedly: a bound for what any plan can reach.
"""
import argparse
import csv
import json
import math
import os
import random
import statistics
import subprocess
import sys
import tempfile

# key: unit, value at which the plan is made, the true one as a multiple of it
KEYS = {
    "ribbon.young_modulus": ("GPa", 200, 0.85, 1.15),
    "ribbon.thickness": ("um", 50, 0.92, 1.08),
    "medium.permittivity": ("", 2.75, 0.85, 1.15),
    "insulator.permittivity": ("", 4.62, 0.85, 1.15),
}
# kind: unit of its column, unit and range of its standard deviation, rows of the list: loads and voltages, most rows of a grid
KINDS = {
    "stroke": ("mm", "um", 20, 100, (12, 12), 100),
    "pull_in_voltage": ("V", "V", 10, 50, (30, 1), 30),
    "zip_time": ("ms", "ms", 0.2, 1, (6, 6), 36),
}


def spread(low, high, count):
    return [low + (high - low) * (k / (count - 1) if count > 1 else 0.5) for k in range(count)]


class Bench:
    def __init__(self, command, folder, seed):
        rnd = random.Random(seed)
        self.command, self.folder = command, folder
        self.keys = rnd.sample(list(KEYS), rnd.choice([2, 3]))
        self.true = {key: KEYS[key][1] * rnd.uniform(*KEYS[key][2:]) for key in self.keys}
        self.kinds = rnd.sample(list(KINDS), rnd.choice([1, 1, 2]))
        self.number = len(self.keys) * rnd.choice([1, 2, 3])
        self.sigma = {kind: rnd.uniform(*KINDS[kind][2:4]) for kind in self.kinds}
        self.loads = rnd.uniform(3, 5), rnd.uniform(7, 10)
        pull_in = [self.pull_in(load) for load in self.loads]
        self.voltages = {"stroke": (0, 0.85 * pull_in[0]), "zip_time": (1.35 * pull_in[1], 2 * pull_in[1]), "pull_in_voltage": (0, 0)}
        self.most = min(KINDS[kind][5] for kind in self.kinds)

    def base(self):
        return {"mesh.nodes": 21, "liquid.model": "none", "damping.internal": "100 us", "drive.voltage": "20 kV", "solver.tolerance": 1e-3}

    def pull_in(self, load):
        """kV, at the values at which the plan is made."""
        return self.run("limits", {"load.mass": f"{load!r} g"})["pull_in_voltage_V"] / 1e3

    def run(self, study, more):
        path = os.path.join(self.folder, "bench.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.writelines(f"{key}: {value}\n" for key, value in {**self.base(), **more}.items())
        out = os.path.join(self.folder, "out")
        done = subprocess.run([self.command, study, path, "-o", out, "--quiet", "--no-plots"], capture_output=True, text=True, check=False)
        if done.returncode > 1:
            sys.exit(done.stderr)
        with open(os.path.join(out, "summary.json"), encoding="utf-8") as file:
            return json.load(file)

    def grid(self, kind, loads, voltages):
        return [(load, voltage) for load in spread(*self.loads, loads) for voltage in spread(*self.voltages[kind], voltages)]

    def listed(self):
        """The rows among which the plan chooses, by kind."""
        return {kind: self.grid(kind, *KINDS[kind][4]) for kind in self.kinds}

    def even(self, number):
        """A grid of at most so many rows, by kind."""
        rows = {}
        for part, kind in enumerate(self.kinds):
            share = (number + part) // len(self.kinds)
            loads = share if kind == "pull_in_voltage" else max(1, math.isqrt(share))
            rows[kind] = self.grid(kind, loads, share // loads)
        return rows

    def plan(self, rows, values, budget):
        """Choose among rows => summary, and the chosen rows by kind."""
        for kind, of in rows.items():
            with open(os.path.join(self.folder, kind + ".csv"), "w", encoding="utf-8") as file:
                setting = "load_g" if kind == "pull_in_voltage" else "load_g,voltage_kV"
                file.write(f"{setting},{kind}_{KINDS[kind][0]}\n")
                file.writelines(f"{load!r}," + (f"{voltage!r}," if "voltage" in setting else "") + "\n" for load, voltage in of)
        summary = self.run("plan", {
            **{key: f"{values[key]!r} {KEYS[key][0]}".strip() for key in self.keys},
            "plan.candidates": "; ".join(kind + ".csv" for kind in rows),
            "plan.budget": budget,
            "calibrate.fit": f"'{', '.join(self.keys)}'",
            "calibrate.x": "load_g",
            "calibrate.y": "; ".join(f"{kind}_{KINDS[kind][0]}" for kind in rows),
            "calibrate.sigma": "; ".join(f"{kind} = {self.sigma[kind]!r} {KINDS[kind][1]}" for kind in rows),
        })
        chosen = {kind: [] for kind in rows}
        with open(os.path.join(self.folder, "out", "table.csv"), newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                kind = list(rows)[int(row["file"]) - 1]
                chosen[kind].append(rows[kind][int(row["row"]) - 1])
        return summary, {kind: of for kind, of in chosen.items() if of}

    def errors(self, rows):
        """Of all these rows at the true values: of all keys together, then of each; 1 where no row has a value there."""
        summary, _ = self.plan(rows, self.true, sum(len(of) for of in rows.values()))
        if "planned_relative_error" not in summary:
            return [1] * (1 + len(self.keys))
        each = [number(summary, key + "_planned_standard_error") / number(summary, key) for key in self.keys]
        return [summary["planned_relative_error"], *each]

    def compare(self, best):
        """=> errors of the plan, or of the best one, and rows of grids that are as good together and in each key, infinite
        where none is, and of the list."""
        nominal = {key: KEYS[key][1] for key in self.keys}
        listed = self.listed()
        if best:  # a best choice has about as many settings as keys, each as often as the others
            listed = {kind: of * (self.number // len(self.keys)) for kind, of in listed.items()}
        summary, chosen = self.plan(listed, self.true if best else nominal, self.number)
        planned = self.errors(chosen)
        together = each = math.inf
        before = None
        for count in range(len(self.kinds), self.most + 1):
            rows = self.even(count)
            if rows == before:
                continue
            before, size = rows, sum(len(of) for of in rows.values())
            errors = self.errors(rows)
            if errors[0] <= planned[0]:
                together = min(together, size)
            if all(error <= limit for error, limit in zip(errors[1:], planned[1:])):
                each = min(each, size)
                if together < math.inf:
                    break
        return planned, together, each, summary["even_rows"]


def number(summary, name):
    group, _, last = name.partition(".")
    return summary[group][last]


def shown(rows, most):
    return f"{rows:3}" if rows < math.inf else f">{most}"


def report(ratios):
    """Of (kinds, planned rows over those of a grid that is as good together, in each key, over even ones of the list) =>
    the median in each key."""
    print("\n| measured | benches | planned over even, together | in each key | of the list |\n|---|---|---|---|---|")
    for kinds in sorted({row[0] for row in ratios}) + [None]:
        of = [row[1:] for row in ratios if kinds in (row[0], None)]
        medians = " | ".join(f"{statistics.median(column):.2f}" for column in zip(*of))
        print(f"| {kinds or 'all'} | {len(of)} | {medians} |")
    return statistics.median(row[2] for row in ratios)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("count", nargs="?", type=int, default=20)
    parser.add_argument("seed", nargs="?", type=int, default=1)
    parser.add_argument("--best", action="store_true")
    given = parser.parse_args()
    ratios = []
    for seed in range(given.seed, given.seed + given.count):
        with tempfile.TemporaryDirectory() as folder:
            bench = Bench(os.path.abspath(given.command), folder, seed)
            start = os.times()
            planned, together, each, listed = bench.compare(given.best)
            spent = os.times().children_user - start.children_user
        name = ", ".join(sorted(bench.kinds))
        told = "  ".join(f"{key} {100 * error:.3g} %" for key, error in zip(bench.keys, planned[1:]))
        print(f"{seed:5} {name:26} {bench.number} planned, even {shown(together, bench.most)} together, {shown(each, bench.most)} in each key, {listed:3.0f} of the list, {spent:5.1f} s  {told}", flush=True)
        ratios.append((name, *(bench.number / min(rows, bench.most) for rows in (together, each)), bench.number / listed))
    median = report(ratios)
    if given.count >= 20 and median > 0.6:
        sys.exit("planned measurements are hardly fewer than those of an even grid")


if __name__ == "__main__":
    main()
