#!/usr/bin/env python3
"""zipact-mpi from outside:  python3 tests/test_mpi.py ZIPACT ZIPACT_MPI SCRATCH

Sweeps under mpirun give the bytes of the command, whatever is done by whom, also after a process was lost and the sweep
resumed. Standard library only. Last line: "N passed, N failed".
"""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

from counting import finish, ok

CASES = {
    "rest": ["stationary", "--set", "load.mass=1 g .. 100 g : 30", "--set", "ribbon.thickness=20 um .. 200 um : 5", "--set", "mesh.nodes=11"],
    "limits": ["limits", "--set", "liquid.model=none", "--set", "load.mass=2 g .. 8 g : 24", "--set", "ribbon.thickness=40 um .. 80 um : 5", "--set", "mesh.nodes=15", "--set", "output.errors=false"],
    "motion": ["actuate", "--set", "drive.voltage=[0, 6 kV, 8 kV]", "--set", "mesh.nodes=11", "--set", "solver.end_time=5 ms", "--set", "output.errors=false"],
}
MPIRUN = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3"]


def results(folder):
    def timeless(value):
        if isinstance(value, dict):
            return {name: timeless(item) for name, item in value.items() if name not in ("wall_time_s", "real_time_factor")}
        return [timeless(item) for item in value] if isinstance(value, list) else value

    return [(folder / name).read_bytes() for name in ("table.csv", "results.h5", "scenario.yaml")], timeless(json.loads((folder / "summary.json").read_text()))


def words(case, folder, *more):
    return [*CASES[case], "--no-plots", "--quiet", "-o", str(folder), *more]


def of_group(leader):
    """Processes of zipact-mpi below mpirun `leader`."""
    listed = subprocess.run(["ps", "-o", "pid=,ppid=,comm=", "-A"], stdout=subprocess.PIPE, text=True).stdout.split("\n")
    return [int(line.split()[0]) for line in listed if len(line.split()) > 2 and line.split()[1] == str(leader) and line.split()[2].startswith("zipact-mpi")]


def check_bytes(zipact, zipact_mpi, scratch):
    for case in ("rest", "limits"):
        alone, shared = scratch / (case + "-alone"), scratch / (case + "-mpi")
        ok("%s by the command" % case, subprocess.run([zipact, *words(case, alone)]).returncode == 0)
        ok("%s by three processes" % case, subprocess.run([*MPIRUN, zipact_mpi, *words(case, shared)]).returncode == 0)
        ok("%s: the same bytes" % case, results(shared) == results(alone))
    again = subprocess.run([*MPIRUN, zipact_mpi, *words("rest", scratch / "rest-mpi", "--resume")])
    ok("all rows are there: nothing is computed, all processes end", again.returncode == 0 and results(scratch / "rest-mpi") == results(scratch / "rest-alone"))
    subprocess.run([zipact, *words("motion", scratch / "motion-alone")], check=True)
    ok("alone, without mpirun", subprocess.run([zipact_mpi, *words("motion", scratch / "motion-one")]).returncode == 0 and results(scratch / "motion-one") == results(scratch / "motion-alone"))


def lose_one(command, folder, noticed):
    """Kill one of those that compute once rows are written; again, if the run was quicker than the kill => its mpirun."""
    for _ in range(10):
        shutil.rmtree(folder, ignore_errors=True)
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while not (folder / "journal.sqlite-wal").exists() and process.poll() is None:
            time.sleep(0.02)
        members = of_group(process.pid)
        if len(members) == 3:
            os.kill(members[-1], signal.SIGKILL)
        if noticed(process):
            break
    else:
        ok("a process is lost, which is noticed", False)
    return process


def check_lost_process(zipact_mpi, scratch):
    """One of those that compute is killed: the rows of the others are kept, and a second start computes the rest."""
    torn = scratch / "limits-torn"
    lose_one([*MPIRUN, zipact_mpi, *words("limits", torn)], torn, lambda process: process.wait() != 0)
    ok("a process is lost, and resumed: the same bytes",
       subprocess.run([*MPIRUN, zipact_mpi, *words("limits", torn, "--resume")]).returncode == 0 and results(torn) == results(scratch / "limits-alone"))


def check_lost_worker(zipact_mpi, scratch):
    """One of those that compute is killed under an mpirun that goes on: the others compute its cases too."""
    whole = scratch / "limits-whole"
    process = lose_one([*MPIRUN, "--enable-recovery", zipact_mpi, *words("limits", whole)], whole, lambda process: "process 2 of the job is lost" in process.communicate()[1])
    ok("a process is lost, the others compute its cases: the same bytes", process.returncode == 0 and results(whole) == results(scratch / "limits-alone"))


def check_refusal(zipact_mpi, scratch):
    wrong = subprocess.run([*MPIRUN, zipact_mpi, "limits", "--set", "load.mass=[1 m, 2 g]", "-o", str(scratch / "wrong")], stderr=subprocess.PIPE, text=True)
    ok("wrong input: status 2, said once, all processes end", wrong.returncode == 2 and wrong.stderr.count("not a mass") == 1)


def main():
    zipact, zipact_mpi, scratch = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), pathlib.Path(sys.argv[3]).resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    check_bytes(zipact, zipact_mpi, scratch)
    check_lost_process(zipact_mpi, scratch)
    check_lost_worker(zipact_mpi, scratch)
    check_refusal(zipact_mpi, scratch)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
