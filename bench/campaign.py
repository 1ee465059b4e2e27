#!/usr/bin/env python3
"""What whole campaigns cost, journal and files included:  bench/campaign.py BUILD [TRIES] >campaign.csv

Each campaign runs TRIES times (default 3) by one worker on one processor and by two on two, in turn. A row has the
least CPU time of one worker per case, its inverse, which is what a processor adds, and how many times as fast the
campaign ends on two processors: the ratio of the least wall times, which means something on a quiet machine only.
The load of the machine before the first run is the last column. Standard library only.
"""

import csv
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile
import time

LOAD, THICKNESS, VOLTAGE = "load.mass=2 g .. 9 g", "ribbon.thickness=80 um .. 120 um", "drive.voltage=7 kV .. 10 kV"
DRY = ["--set", "liquid.model=none"]

# study, nodes, lists whose product is the campaign (each of at most 20,000 values), what else is set; each campaign
# keeps one processor busy for 5 s or more, so that the start and the files at the end weigh as little as in real ones
CAMPAIGNS = [
    ("stationary", 21, {LOAD: 500, THICKNESS: 400}, []),
    ("stationary", 61, {LOAD: 300, THICKNESS: 200}, []),
    ("limits", 21, {THICKNESS: 20000}, DRY),
    ("limits", 61, {THICKNESS: 8000}, DRY),
    ("limits with a bead", 61, {THICKNESS: 6000}, []),
    ("actuate", 21, {VOLTAGE: 400}, [*DRY, "--set", "solver.tolerance=1e-3"]),  # times to 0.1 %
]


def command(program, campaign, folder, jobs):
    study, nodes, lists, more = campaign
    settings = ["mesh.nodes=%d" % nodes, "output.errors=false", *("%s : %d" % (key, n) for key, n in lists.items())]
    words = [word for setting in settings for word in ("--set", setting)] + more
    return [program, study.split()[0], *words, "--no-plots", "--quiet", "-o", folder, "--jobs", str(jobs)]


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
            study, nodes, cases = campaign[0], campaign[1], math.prod(campaign[2].values())
            row = ["%.1f" % (1e6 * cpu / cases), "%.3g" % (cases / cpu), "%.2f" % speed_up, "%.1f" % load]
            out.writerow([study, nodes, cases, *row])
            sys.stdout.flush()


if __name__ == "__main__":
    main()
