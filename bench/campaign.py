#!/usr/bin/env python3
"""What whole campaigns cost, journal and files included:  bench/campaign.py BUILD [TRIES] >campaign.csv

Each campaign runs TRIES times (default 3) by one worker on one processor and by two on two, in turn. A row has the
least CPU time of one worker per case, its inverse, which is what a processor adds, and how many times as fast the
campaign ends on two processors: the ratio of the least wall times, which means something on a quiet machine only.
The load of the machine before the first run is the last column. Standard library only.
"""

import csv
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

LOADS, THICKNESSES = "load.mass=2 g .. 9 g : %d", "ribbon.thickness=80 um .. 120 um : %d"
DRY = ["--set", "liquid.model=none"]

# study, nodes, cases, what varies, what else is set
CAMPAIGNS = [
    ("stationary", 21, 20000, LOADS, []),
    ("stationary", 61, 10000, LOADS, []),
    ("limits", 21, 4000, THICKNESSES, DRY),
    ("limits", 61, 2000, THICKNESSES, DRY),
    ("limits with a bead", 61, 2000, THICKNESSES, []),
    ("actuate", 21, 200, "drive.voltage=7 kV .. 10 kV : %d", [*DRY, "--set", "solver.tolerance=1e-3"]),  # times to 0.1 %
]


def command(program, campaign, folder, jobs):
    study, nodes, cases, varied, more = campaign
    settings = ["--set", varied % cases, "--set", "mesh.nodes=%d" % nodes, "--set", "output.errors=false", *more]
    return [program, study.split()[0], *settings, "--no-plots", "--quiet", "-o", folder, "--jobs", str(jobs)]


def run(words, processors):
    """=> wall time and CPU time, s."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(words, check=True, preexec_fn=lambda: os.sched_setaffinity(0, processors))
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(program, campaign, tries, scratch):
    processors = sorted(os.sched_getaffinity(0))[:2]
    wall, cpu = {1: [], 2: []}, []
    for _ in range(tries):
        for jobs in (1, 2):
            folder = str(scratch / "campaign")
            shutil.rmtree(folder, ignore_errors=True)
            took, used = run(command(program, campaign, folder, jobs), processors[:jobs])
            wall[jobs].append(took)
            cpu += [used] if jobs == 1 else []
    return min(cpu), min(wall[1]) / min(wall[2]) if len(processors) > 1 else float("nan")


def main():
    program, tries = str(pathlib.Path(sys.argv[1]) / "zipact"), int(sys.argv[2]) if len(sys.argv) > 2 else 3
    load = os.getloadavg()[0]
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["campaign", "nodes", "cases", "cpu_us_per_case", "cases_per_s_per_core", "speed_up_of_two", "load"])
    with tempfile.TemporaryDirectory() as folder:
        for campaign in CAMPAIGNS:
            cpu, speed_up = measure(program, campaign, tries, pathlib.Path(folder))
            study, nodes, cases = campaign[:3]
            row = ["%.1f" % (1e6 * cpu / cases), "%.3g" % (cases / cpu), "%.2f" % speed_up, "%.1f" % load]
            out.writerow([study, nodes, cases, *row])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
