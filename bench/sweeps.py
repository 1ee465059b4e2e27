#!/usr/bin/env python3
"""Do cases of a sweep of limits, which start from a neighbour, find what each finds alone?  bench/sweeps.py PROGRAM COUNT SEED

COUNT random sweeps of 4 by 10 values of two keys, which grow by 1 to 20 % from value to value, on 21 to 61 nodes, dry
and with a bead. Each number that differs by more than 1e-6 of it is a line with the command of the case. Ends with 1 if
more than one number in 5,000 differs. Standard library only; two processors; 2 s of CPU time a sweep.
"""

import concurrent.futures
import csv
import json
import pathlib
import random
import subprocess
import sys
import tempfile

KEYS = {"ribbon.thickness": (40e-6, 130e-6, "m"), "load.mass": (2e-3, 20e-3, "kg"), "insulator.thickness": (60e-6, 200e-6, "m"), "ribbon.width": (6e-3, 20e-3, "m"),
        "drive.voltage": (4e3, 10e3, "V"), "ribbon.length": (0.06, 0.14, "m")}
OUTPUTS = ["pull_in_voltage_V", "closing_voltage_V", "release_voltage_V", "max_load_kg", "travel_m"]
SAME, FEW = 1e-6, 1 / 5000


def run(program, settings, folder):
    words = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([program, "limits", *words, "--jobs", "1", "--no-plots", "--quiet", "-o", str(folder)], check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return "limits " + " ".join(word if word == "--set" else "'%s'" % word for word in words)


def listed(rng, key, count):
    """Random values of a key, each the one before times a factor."""
    least, most, unit = KEYS[key]
    step = 1 + rng.choice([0.01, 0.03, 0.1, 0.2])
    first = rng.uniform(least, most / step**3)
    return "%s=[%s]" % (key, ", ".join("%.9g %s" % (first * step**k, unit) for k in range(count)))


def differs(a, b):
    return (a is None) != (b is None) or (a is not None and abs(a - b) > SAME * abs(b))


def sweep(program, seed):
    """=> numbers compared, lines on those that differ."""
    rng = random.Random(seed)
    lists = [listed(rng, key, count) for key, count in zip(rng.sample(sorted(KEYS), 2), (4, 10))]
    common = ["mesh.nodes=%d" % rng.choice([21, 31, 41, 61]), "output.errors=false", "liquid.model=" + rng.choice(["none", "bead"])]
    lines, compared = [], 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        run(program, [*common, *lists], folder / "sweep")
        with open(folder / "sweep" / "table.csv") as table:
            rows = list(csv.DictReader(table))
        for row in rows:
            own = ["%s=%s %s" % (column.rpartition("_")[0], row[column], column.rpartition("_")[2]) for column in list(row)[:2]]
            command = run(program, [*common, *own], folder / "alone")
            scalars = json.loads((folder / "alone" / "summary.json").read_text())
            for output in OUTPUTS:
                found, alone = float(row[output]) if row.get(output) else None, scalars.get(output)
                compared += 1
                if differs(found, alone):
                    lines.append("%s %s, alone %s, %s warm starts: %s" % (output, found, alone, row["warm_starts"], command))
    return compared, lines


def main():
    program, count, seed = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        found = list(pool.map(lambda k: sweep(program, 1000 * seed + k), range(count)))
    lines = [line for _, those in found for line in those]
    compared = sum(number for number, _ in found)
    print("\n".join([*lines, "%d of %d numbers of %d sweeps differ from those of single cases" % (len(lines), compared, count)]))
    sys.exit(len(lines) > FEW * compared)


if __name__ == "__main__":
    main()
