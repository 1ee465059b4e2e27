#!/usr/bin/env python3
"""What a study costs, counted:

    bench/counts.py COMMAND >counts.csv
    bench/counts.py COMMAND --check counts.csv

Each row is a study by callgrind with a simulated cache, which counts alike on every machine: instructions of zp_study_run,
those for each node and iteration of Newton's method, the bytes that the first level of the cache takes from the second one
and the last level from memory. --check fails if a study takes 1.3 times as many instructions as in the file. Takes five
minutes; needs valgrind. Standard library only.
"""
import argparse
import csv
import json
import os
import re
import subprocess
import sys
import tempfile

LINE = 64  # bytes
CACHES = ["--I1=32768,8,64", "--D1=32768,8,64", "--LL=33554432,16,64"]
DRY, BEAD, BATH = (["liquid.model=" + word] for word in ("none", "bead", "submerged"))
ZIP = ["solver.stop_when_zipped=true", "output.errors=false"]
STRIP = ["actuator.kind=ribbon", "ribbon.length=45 mm", "ribbon.thickness=100 um", "ribbon.plane=stress", "output.errors=false"]
FREE = ["actuator.kind=ribbon", "actuator.right_end=free", "ribbon.length=60 mm", "load.mass=0.5 g", "output.errors=false"]
# name, study, what is set; ribbons
ROWS = [
    ("rest of a guided strip", "stationary", [*STRIP, "load.mass=61 g", "mesh.nodes=14"], 1),
    ("rest of a strip", "stationary", [*FREE, "ribbon.model=rod"], 1),
    ("rest of a strip in space, load beside the middle", "stationary", [*FREE, "ribbon.model=spatial", "load.across=1 mm"], 1),
    ("rest of the default actuator", "stationary", [*DRY, "output.errors=false"], 2),
    ("limits, dry", "limits", [*DRY, "output.errors=false"], 2),
    ("limits, dry, with errors", "limits", DRY, 2),
    ("limits, bead", "limits", [*BEAD, "output.errors=false"], 2),
    ("swing of a cantilever, 0.1 s", "actuate", [*STRIP, "actuator.right_end=free", "load.mass=2 g", "initial.state=straight", "damping.internal=0", "mesh.nodes=15", "solver.tolerance=7e-4", "solver.end_time=0.1"], 1),
    ("zip, dry", "actuate", [*DRY, *ZIP], 2),
    ("zip, dry, with errors", "actuate", [*DRY, ZIP[0]], 2),
    ("zip, bead", "actuate", [*BEAD, *ZIP], 2),
    ("zip, bath", "actuate", [*BATH, *ZIP], 2),
]


def count(program, study, sets, folder):
    """=> instructions, misses of the first and of the last level, and the summary."""
    out = os.path.join(folder, "callgrind.out")
    words = [word for text in sets for word in ("--set", text)]
    subprocess.run(["valgrind", "--tool=callgrind", "--cache-sim=yes", *CACHES, "--toggle-collect=zp_study_run", "--callgrind-out-file=" + out, program, study, *words, "--no-plots", "--quiet", "-o", os.path.join(folder, "out")], check=True, stderr=subprocess.DEVNULL)
    with open(out, encoding="utf-8") as file:
        text = file.read()
    names = re.search(r"^events: (.*)$", text, re.M)[1].split()
    events = dict(zip(names, map(int, re.search(r"^(?:totals|summary): (.*)$", text, re.M)[1].split())))
    with open(os.path.join(folder, "out", "summary.json"), encoding="utf-8") as file:
        return events["Ir"], events["D1mr"] + events["D1mw"], events["DLmr"] + events["DLmw"], json.load(file)


def measure(program, name, study, sets, ribbons):
    """=> a row."""
    nodes = next((int(text.split("=")[1]) for text in sets if text.startswith("mesh.nodes")), 61)
    with tempfile.TemporaryDirectory() as folder:
        instructions, first, last, summary = count(program, study, sets, folder)
    iterations = summary.get("newton_iterations") or ""
    each = round(instructions / (ribbons * nodes * iterations)) if iterations else ""
    return [name, nodes, summary.get("steps") or "", iterations, instructions, each, LINE * first, LINE * last]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("command")
    parser.add_argument("--check", metavar="FILE")
    given = parser.parse_args()
    known = {}
    if given.check:
        with open(given.check, encoding="utf-8", newline="") as file:
            known = {row["study"]: int(row["instructions"]) for row in csv.DictReader(file)}
    table, most, slower = csv.writer(sys.stdout, lineterminator="\n"), 1.3, []
    table.writerow(["study", "nodes", "steps", "iterations", "instructions", "per_node_and_iteration", "bytes_of_second_level", "bytes_of_memory"])
    for row in ROWS:
        measured = measure(os.path.abspath(given.command), *row)
        table.writerow(measured)
        sys.stdout.flush()
        if given.check and measured[4] > most * known[row[0]]:
            slower.append(row[0])
    if slower:
        sys.exit("more instructions than in %s: %s" % (given.check, "; ".join(slower)))


if __name__ == "__main__":
    main()
