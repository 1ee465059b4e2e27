#!/usr/bin/env python3
"""Make examples/data/video*.csv: what a phone and a supply would measure of an actuator whose keys are known, with noise.

    make-video-data.py ZIPACT [FOLDER]

video.csv is a zip in a bath of oil at 240 frames a second, as a video tracker exports it: the clock began before the
switch, and heights count from anywhere. video-pull-ins.csv are the voltages that study plan asks for after it. Both are
computed with the keys of TRUTH, with time steps ten times finer than those of a fit, and get normal errors. Study
calibrate must find the keys again: docs/phone-video.md.
"""

import csv
import json
import os
import random
import subprocess
import sys
import tempfile

TRUTH = {"ribbon.young_modulus": "188 GPa", "medium.kinematic_viscosity": "62 mm2/s", "medium.permittivity": "2.6"}
BENCH = {"liquid.model": "submerged", "mesh.nodes": "21", "output.errors": "false"}
RATE, BEFORE, FRAMES = 240, 0.0371, 60  # frames a second; s from the first frame to the switch; frames
SHIFT, BLUR = 0.0524, 0.1e-3  # m: of the heights, and the standard deviation of one
PULL_INS = {"load_g": [9, 10], "sigma_V": 20}


def run(zipact, study, settings):
    """The rows of the table of a study, and its summary."""
    with tempfile.TemporaryDirectory() as folder:
        words = [word for name, value in {**TRUTH, **BENCH, **settings}.items() for word in ("--set", f"{name}={value}")]
        subprocess.run([zipact, study, *words, "--no-plots", "--quiet", "-o", folder], check=True)
        with open(os.path.join(folder, "table.csv"), newline="") as file:
            rows = [{name: float(value) for name, value in row.items() if value} for row in csv.DictReader(file)]
        with open(os.path.join(folder, "summary.json")) as file:
            return rows, json.load(file)


def between(rows, time, name):
    """The value at a time, by a straight line between two rows; before the first row that of rest."""
    for one, two in zip(rows, rows[1:]):
        if one["time_s"] <= time < two["time_s"]:
            share = (time - one["time_s"]) / (two["time_s"] - one["time_s"])
            return (1 - share) * one[name] + share * two[name]
    return rows[0][name] if time < 0 else rows[-1][name]


def main(zipact, folder="examples/data"):
    noise = random.Random(2026)
    zip_, _ = run(zipact, "actuate", {"solver.tolerance": "1e-5", "solver.end_time": "0.4 s", "output.samples": "100000"})
    with open(os.path.join(folder, "video.csv"), "w") as file:
        file.write("clip\nt,y\n")
        for frame in range(FRAMES):
            time = frame / RATE
            height = SHIFT + zip_[0]["stroke_m"] - between(zip_, time - BEFORE, "stroke_m") + noise.gauss(0, BLUR)
            file.write(f"{time:.4f},{height:.5f}\n")
    with open(os.path.join(folder, "video-pull-ins.csv"), "w") as file:
        file.write("load_g,pull_in_voltage_V,sigma_pull_in_voltage_V\n")
        for load in PULL_INS["load_g"]:
            _, limits = run(zipact, "limits", {"load.mass": f"{load} g"})
            file.write(f"{load},{limits['pull_in_voltage_V'] + noise.gauss(0, PULL_INS['sigma_V']):.0f},{PULL_INS['sigma_V']}\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
