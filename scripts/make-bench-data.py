#!/usr/bin/env python3
"""Make examples/data/bench-*.csv: what a bench would measure of an actuator whose keys are known, with noise.

    make-bench-data.py ZIPACT [FOLDER]

Studies compute strokes, limits and frequencies against the load with the keys of TRUTH; each value then gets a normal
error of the standard deviation that its column sigma_... has. Study calibrate must find these keys again, within its
standard errors: examples/calibrate-bench.yaml.
"""

import csv
import os
import random
import subprocess
import sys
import tempfile

TRUTH = {"ribbon.young_modulus": "188 GPa", "medium.permittivity": "2.55", "insulator.permittivity": "4.2"}

# file, study, loads, then (number of the summary, column, factor, sigma, digits)
FILES = [
    ("bench-strokes.csv", "stationary", "1 g .. 13 g : 7", [("stroke_m", "stroke", "mm", 1e3, 0.05, 3)]),
    (
        "bench-limits.csv",
        "limits",
        "4 g .. 10 g : 4",
        [
            ("pull_in_voltage_V", "pull_in_voltage", "V", 1, 20, 0),
            ("release_voltage_V", "release_voltage", "V", 1, 15, 0),
        ],
    ),
    ("bench-frequencies.csv", "modes", "2 g .. 12 g : 3", [("frequency_1_Hz", "frequency", "Hz", 1, 0.02, 3)]),
]


def computed(zipact, study, loads):
    """The rows of the table of a study over these loads."""
    settings = {**TRUTH, "liquid.model": "none", "mesh.nodes": "31", "load.mass": loads, "output.errors": "false"}
    with tempfile.TemporaryDirectory() as folder:
        words = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
        subprocess.run([zipact, study, *words, "--no-plots", "--quiet", "-o", folder], check=True)
        with open(os.path.join(folder, "table.csv"), newline="") as table:
            return list(csv.DictReader(table))


def main(zipact, folder="examples/data"):
    noise = random.Random(2026)
    for name, study, loads, columns in FILES:
        with open(os.path.join(folder, name), "w") as file:
            truth = ", ".join(f"{key} = {value}" for key, value in TRUTH.items())
            file.write(f"# Not measured: study {study} with {truth}, and normal noise\n")
            file.write("load_g")
            for _, stem, unit, *_ in columns:
                file.write(f",{stem}_{unit},sigma_{stem}_{unit}")
            for row in computed(zipact, study, loads):
                file.write(f"\n{1e3 * float(row['load.mass_kg']):g}")
                for number, _, _, factor, sigma, digits in columns:
                    file.write(f",{factor * float(row[number]) + noise.gauss(0, sigma):.{digits}f},{sigma:g}")
            file.write("\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
