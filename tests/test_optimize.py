#!/usr/bin/env python3
"""zipact optimize from outside:  python3 tests/test_optimize.py ZIPACT SCRATCH

Optima that are known otherwise; the same bytes for any number of workers and after kill -9; the best so far after Ctrl-C;
fronts; wrong texts. Standard library only. Last line: "N passed, N failed".
"""

import json
import math
import os
import pathlib
import random
import shutil
import signal
import statistics
import subprocess
import sys
import time

from counting import finish, ok

LIGHTEST = ["study=limits", "liquid.model=none", "load.mass=30 g", "drive.voltage=8 kV", "ribbon.length=60 mm", "mesh.nodes=11", "output.errors=false",
            "optimize.variables=ribbon.thickness = 20 um .. 200 um log; ribbon.width = 5 mm .. 40 mm log; insulator.thickness = 20 um .. 200 um log",
            "optimize.objective=min mass_kg", "optimize.constraints=max_load_kg >= 30 g; travel_m >= 15 mm; breakdown_margin >= 1.2", "optimize.evaluations=120"]
FRONT = ["optimize.objective=min mass_kg; max travel_m", "optimize.constraints=max_load_kg >= 30 g; breakdown_margin >= 1.2", "optimize.evaluations=240"]


class Zipact:
    def __init__(self, program):
        self.program = program

    def command(self, sets, folder, *more):
        return [self.program, "optimize", *(word for item in sets for word in ("--set", item)), "--no-plots", "--quiet", "-o", str(folder), *more]

    def run(self, sets, folder, *more):
        return subprocess.run(self.command(sets, folder, *more), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def files(folder):
    return [(folder / name).read_bytes() for name in ("table.csv", "results.h5", "scenario.yaml")]


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def check_known_optimum(zipact, scratch):
    """A weightless clamped strip, guided at its end, bends by P L^3 / (12 E I): 0.3 mm where its thickness says so; the
    lightest way to keep it below that is the thinnest strip that does."""
    folder = scratch / "strip"
    sets = ["study=stationary", "actuator.kind=ribbon", "actuator.right_end=guided", "ribbon.density=0", "load.mass=10 mg", "mesh.nodes=21", "output.errors=false",
            "optimize.variables=load.mass = 1 mg .. 10 mg", "optimize.objective=max load.mass_kg"]
    refused = zipact.run(sets, folder)
    ok("strip: a key is no output", refused.returncode == 2 and "not an output of study stationary" in refused.stderr)
    sets[-2:] = ["optimize.variables=ribbon.thickness = 40 um .. 60 um", "optimize.objective=max stroke_m", "optimize.constraints=stroke_m <= 0.3 mm"]
    for method in ("auto", "cobyla", "slsqp"):
        run = zipact.run([*sets, "optimize.method=" + method, "optimize.evaluations=60"], scratch / ("strip-" + method))
        best = summary_of(scratch / ("strip-" + method))["optimum"]
        thickness, expected = best["cases"][0]["ribbon.thickness"], (10e-6 * 9.81 * 0.1**3 * (1 - 0.285**2) / (200e9 * 12.7e-3 * 0.3e-3)) ** (1 / 3)
        ok("strip by %s: the thickness that bends by 0.3 mm" % method, run.returncode == 0 and best["feasible"] and abs(thickness / expected - 1) < 2e-3)


def check_robust_strip(zipact, scratch):
    """The same strip of a drawn modulus: its thickness follows from that of which 5 of 100 samples are softer, where a
    constraint names no other number of the distribution."""
    sets = ["study=stationary", "actuator.kind=ribbon", "actuator.right_end=guided", "ribbon.density=0", "load.mass=10 mg", "mesh.nodes=21", "output.errors=false",
            "ribbon.young_modulus=lognormal(200 GPa, 0.05)", "sampling.count=64", "optimize.variables=ribbon.thickness = 40 um .. 60 um", "optimize.objective=max stroke_m",
            "optimize.evaluations=60"]
    for constraint, score, method in (("stroke_m <= 0.3 mm", 1.6449, "slsqp"), ("stroke_m.median <= 0.3 mm", 0, "cobyla"), ("stroke_m.quantile_05 <= 0.3 mm", -1.6449, "slsqp")):
        folder = scratch / ("robust-" + method)
        words = zipact.command([*sets, "optimize.constraints=" + constraint, "optimize.method=" + method], folder)
        run = subprocess.run([word for word in words if word != "--quiet"], stdout=subprocess.PIPE, text=True)
        found = summary_of(folder)
        best = found["optimum"]["cases"][0]
        name, number = constraint.split(" ")[0].split(".")[-1].replace("stroke_m", "quantile_95"), best["outputs"]["stroke_m"]
        modulus = 200e9 * math.exp(-0.05 * score)
        expected = (10e-6 * 9.81 * 0.1**3 * (1 - 0.285**2) / (modulus * 12.7e-3 * 0.3e-3)) ** (1 / 3)
        ok("%s: the bound" % constraint, run.returncode == 0 and found["optimum"]["feasible"] and abs(number[name] / 0.3e-3 - 1) < 2e-6 and number["count"] == 64)
        ok("%s: the thickness" % constraint, abs(best["ribbon.thickness"] / expected - 1) < 3e-3)  # of 64 samples; 1.6e-3 measured
        ok("%s: printed" % constraint, "    stroke_m.mean = %.6g" % number["mean"] in run.stdout and "    stroke_m.%s = %.6g" % (name, number[name]) in run.stdout)
    again = subprocess.run([zipact.program, "optimize", str(scratch / "robust-slsqp" / "scenario.yaml"), "--no-plots", "--quiet", "-o", str(scratch / "robust-again")])
    ok("robust: its scenario.yaml gives the same optimisation", again.returncode == 0 and files(scratch / "robust-again") == files(scratch / "robust-slsqp"))
    samples = [[row["ribbon.young_modulus"] for row in found["rows"][k : k + 64]] for k in range(0, len(found["rows"]), 64)]
    ok("robust: the same samples for all designs", len(samples) > 10 and all(group == samples[0] for group in samples))


def check_missing_samples(zipact, scratch):
    """A sample that has no output misses: with all 16 samples bounded no strip is good under which one of them does not
    zip, with 15 of them one may be."""
    sets = [*LIGHTEST[:-3], "load.mass=10 g", "ribbon.young_modulus=uniform(150 GPa, 250 GPa)", "sampling.count=16", "optimize.variables=ribbon.thickness = 20 um .. 60 um",
            "optimize.objective=min mass_kg", "optimize.evaluations=24", "optimize.method=cobyla"]
    for number, most in (("max", 0), ("quantile_95", 1)):
        found = optimum_of(zipact, [*sets, "optimize.constraints=pull_in_voltage_V.%s <= 8 kV" % number], scratch / "missing")[1]
        best = found["optimum"]["cases"][0]["outputs"]["pull_in_voltage_V"]
        lacking = [sum(row["pull_in_voltage_V"] is None for row in found["rows"][k : k + 16]) for k in range(0, len(found["rows"]), 16)]
        ok("%s: samples that may lack the output" % number, found["optimum"]["feasible"] and best["missing"] <= most and max(lacking) > 1)


def check_bound_of_a_motion(zipact, scratch):
    """The least viscous loss until closing is that of the least viscosity: at constant time its derivative has the
    other sign."""
    sets = ["study=actuate", "liquid.model=submerged", "mesh.nodes=7", "solver.stop_when_zipped=true", "output.errors=false",
            "optimize.variables=medium.kinematic_viscosity = 20 mm2/s .. 80 mm2/s", "optimize.objective=min viscous_loss_J", "optimize.evaluations=12"]
    run = zipact.run(sets, scratch / "motion")
    best = summary_of(scratch / "motion")["optimum"]["cases"][0]
    ok("motion: the bound", run.returncode == 0 and abs(best["medium.kinematic_viscosity"] / 20e-6 - 1) < 1e-6)


def check_known_front(zipact, scratch):
    """The same strip, much stroke for little stress, 3 P L / (w b^2): their quotient is L^2 (1 - nu^2) / (3 E b), so the
    thinnest strip is best, of any width, and where it is as wide as it may be, the thinnest that has the stress."""
    folder = scratch / "front"
    run = zipact.run(["study=stationary", "actuator.kind=ribbon", "actuator.right_end=guided", "ribbon.density=0", "load.mass=10 mg", "mesh.nodes=21", "output.errors=false",
                      "optimize.variables=ribbon.thickness = 40 um .. 60 um; ribbon.width = 5 mm .. 20 mm", "optimize.objective=max stroke_m; min max_stress_Pa",
                      "optimize.evaluations=1200"], folder)
    front = summary_of(folder)["optimum"]["cases"]
    shares = []  # of the greatest stroke with that stress
    for case in front:
        thinnest = max(40e-6, (3 * 10e-6 * 9.81 * 0.1 / (20e-3 * case["max_stress_Pa"])) ** 0.5)
        shares.append(case["stroke_m"] / case["max_stress_Pa"] * 3 * 200e9 * thinnest / (0.1**2 * (1 - 0.285**2)))
    ok("front: on it", run.returncode == 0 and len(front) > 20 and max(shares) < 1.002 and min(shares) > 0.9 and statistics.median(shares) > 0.99)
    ok("front: from end to end", min(case["ribbon.width"] for case in front) < 5.1e-3 and max(case["ribbon.thickness"] for case in front) > 59.5e-6)


def check_workers(zipact, scratch):
    """All cases follow from the scenario alone."""
    for name, more in (("slsqp", []), ("cobyla", ["optimize.method=cobyla"]), ("nsga2", FRONT)):
        alone = scratch / (name + "-1")
        ok("%s: done" % name, zipact.run([*LIGHTEST, *more], alone, "--jobs", "1").returncode == 0)
        other = scratch / (name + "-3")
        ok("%s by 3 workers: the same bytes" % name, zipact.run([*LIGHTEST, *more], other, "--jobs", "3").returncode == 0 and files(other) == files(alone))
    best = {name: summary_of(scratch / (name + "-1"))["optimum"]["cases"] for name in ("slsqp", "cobyla", "nsga2")}
    ok("slsqp and cobyla find the same mass", abs(best["slsqp"][0]["mass_kg"] / best["cobyla"][0]["mass_kg"] - 1) < 0.02)
    ok("the constraints that limit it hold", best["slsqp"][0]["max_load_kg"] > 0.03 * (1 - 2e-6) and best["slsqp"][0]["breakdown_margin"] > 1.2 * (1 - 2e-6))
    rows = summary_of(scratch / "slsqp-1")["rows"]
    good = [r["mass_kg"] for r in rows if r["max_load_kg"] and r["max_load_kg"] >= 0.03 and (r["travel_m"] or 0) >= 0.015 and r["breakdown_margin"] >= 1.2]
    ok("no case that holds is lighter", len(good) > 0 and best["slsqp"][0]["mass_kg"] <= min(good))
    front = [(case["mass_kg"], case["travel_m"]) for case in best["nsga2"]]
    ok("the front rises: more travel costs mass", len(front) > 3 and all(a[0] < b[0] and a[1] < b[1] for a, b in zip(front, front[1:])))
    again = subprocess.run([zipact.program, "optimize", str(scratch / "slsqp-1" / "scenario.yaml"), "--no-plots", "--quiet", "-o", str(scratch / "again")])
    ok("its scenario.yaml gives the same optimisation", again.returncode == 0 and files(scratch / "again") == files(scratch / "slsqp-1"))


def check_kills(zipact, scratch):
    """kill -9 as soon as a row is written, and while the rest is computed."""
    chance = random.Random(3)
    for name, more in (("slsqp", []), ("nsga2", FRONT)):
        torn, hits = scratch / (name + "-torn"), 0
        for _ in range(2):
            process = subprocess.Popen(zipact.command([*LIGHTEST, *more], torn, "--resume"), stderr=subprocess.DEVNULL)
            while process.poll() is None and not (torn / "journal.sqlite-wal").exists():
                time.sleep(0.002)
            time.sleep(chance.uniform(0, 0.1))
            process.send_signal(signal.SIGKILL)
            hits += process.wait() == -signal.SIGKILL
        ok("%s: a kill hits" % name, hits > 0)
        ok("%s after kills: done" % name, zipact.run([*LIGHTEST, *more], torn, "--resume").returncode == 0)
        ok("%s after kills: the same bytes" % name, files(torn) == files(scratch / (name + "-1")))


def check_interrupt(zipact, scratch):
    """Ctrl-C leaves the best so far, and what was computed."""
    folder = scratch / "interrupted"
    sets = [*LIGHTEST, "optimize.evaluations=2000"]
    process = subprocess.Popen(zipact.command(sets, folder, "--jobs", "1"), stderr=subprocess.DEVNULL)
    while process.poll() is None and (not (folder / "journal.sqlite-wal").exists() or (folder / "journal.sqlite-wal").stat().st_size < 100000):
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    ok("interrupted: 130", process.wait() == 130)
    summary = summary_of(folder)
    ok("interrupted: the best so far", summary["outcome"] == "interrupted" and len(summary["optimum"]["cases"]) == 1 and 0 < len(summary["rows"]) < 2000)
    forgotten = zipact.run(sets, folder)
    ok("interrupted: not replaced without --resume", forgotten.returncode == 2 and "--resume" in forgotten.stderr)


STRIP = ["study=stationary", "actuator.kind=ribbon", "actuator.right_end=guided", "ribbon.density=0", "load.mass=10 mg", "mesh.nodes=21", "output.errors=false",
         "optimize.variables=ribbon.thickness = 40 um .. 60 um; ribbon.width = 10 mm .. 20 mm", "optimize.objective=max stroke_m"]


def optimum_of(zipact, sets, folder, *more):
    run = zipact.run(sets, folder, *more)
    return run.returncode, summary_of(folder)


def check_empty_box(zipact, scratch):
    """Where no case holds, cells of the box are excluded: all of a box that is empty by its closed form, never all of one
    that holds a design which a short search misses."""
    code, found = optimum_of(zipact, [*LIGHTEST, "mesh.nodes=21", "optimize.constraints=max_load_kg >= 30 g; travel_m >= 100 mm"], scratch / "empty")
    ok("an empty box is an answer", code == 0 and not found["optimum"]["feasible"] and found["optimum"]["excluded_share"] == 1 and "no design in the box" in found["message"])
    least = 10e-6 * 9.81 * 0.1**3 * (1 - 0.285**2) / (200e9 * 20e-3 * 60e-6**3)  # m, of the stiffest strip in the box
    code, found = optimum_of(zipact, [*STRIP, "optimize.constraints=stroke_m <= %.4g um" % (0.8e6 * least)], scratch / "stiff")
    ok("a box without such a strip", code == 0 and found["optimum"]["excluded_share"] == 1 and abs(found["optimum"]["cases"][0]["stroke_m"] / least - 1) < 2e-3)
    code, others = optimum_of(zipact, [*STRIP, "optimize.constraints=stroke_m <= %.4g um" % (0.8e6 * least)], scratch / "stiff-5", "--jobs", "5")
    ok("by 5 workers: the same bytes", files(scratch / "stiff") == files(scratch / "stiff-5"))
    thirds = [*STRIP, "optimize.variables=ribbon.thickness = 40 um .. 60 um log", "ribbon.width=20 mm", "optimize.method=cobyla", "optimize.evaluations=10"]
    code, found = optimum_of(zipact, [*thirds, "optimize.constraints=stroke_m <= %.9g um" % (1e6 * 0.9988 * least)], scratch / "thirds")
    ok("cut in three four times, with ten cases: all but one 81st", code == 0 and abs(found["optimum"]["excluded_share"] - 80 / 81) < 1e-12 and "98.8 % of the box is excluded" in found["message"])
    for part in (1.02, 1.5, 3.0, 5.0):
        window = "stroke_m <= %.7g um; stroke_m >= %.7g um" % (1.00001e6 * part * least, 0.99999e6 * part * least)
        code, found = optimum_of(zipact, [*STRIP, "optimize.method=cobyla", "optimize.evaluations=10", "optimize.constraints=" + window], scratch / "window")
        ok("%g of the least stroke: not excluded" % part, code == 0 and (found["optimum"]["feasible"] or found["optimum"]["excluded_share"] < 1))


def check_steep_corner(zipact, scratch):
    """In a wide box the stroke changes faster at thin strips than between the centres of cells: pairs of cases show it,
    so the corner that holds the design is not excluded."""
    stroke = 10e-6 * 9.81 * 0.1**3 * (1 - 0.285**2) / (200e9 * 20e-3 * 40e-6**3)  # m, of the widest strip of 40 um
    sets = [*STRIP, "optimize.variables=ribbon.thickness = 10 um .. 400 um; ribbon.width = 10 mm .. 20 mm", "optimize.method=cobyla", "optimize.evaluations=10"]
    code, found = optimum_of(zipact, [*sets, "optimize.constraints=stroke_m <= %.8g um; stroke_m >= %.8g um" % (1.01e6 * stroke, 0.99e6 * stroke)], scratch / "steep")
    ok("a steep corner is not excluded", code == 0 and (found["optimum"]["feasible"] or found["optimum"]["excluded_share"] < 1))


def check_search_after_exclusion(zipact, scratch):
    """Ten cases find no strip in the window, cells of the box do, and what is left of the cases goes towards its upper end."""
    least = 10e-6 * 9.81 * 0.1**3 * (1 - 0.285**2) / (200e9 * 20e-3 * 60e-6**3)
    window = "stroke_m <= %.7g um; stroke_m >= %.7g um" % (1.02e6 * 3 * least, 0.98e6 * 3 * least)
    code, found = optimum_of(zipact, [*STRIP, "optimize.method=cobyla", "optimize.evaluations=10", "optimize.constraints=" + window], scratch / "onwards")
    first = [case["stroke_m"] / (3 * least) for case in found["optimum"]["cases"]][0]
    ok("from a case of a cell towards the bound", code == 0 and found["optimum"]["feasible"] and 1.01 < first < 1.02)


def check_refusals(zipact, scratch):
    wrong = {"optimize.variables=": "empty", "optimize.variables=ribbon.thikness = 1 um .. 2 um": "did you mean ribbon.thickness", "optimize.variables=mesh.nodes = 11 .. 21": "not a real number",
             "optimize.variables=ribbon.width = 5 mm .. 4 mm": "upper end", "optimize.variables=ribbon.width = 5 mm .. 4 kg": "not a length", "optimize.variables=ribbon.width": "write",
             "optimize.variables=ribbon.width = 5 mm .. 9 mm; ribbon.width = 5 mm .. 9 mm": "twice", "segment_1.length=[0, 1 mm]": "takes one value",
             "optimize.objective=": "empty", "optimize.objective=least mass_kg": "write", "optimize.objective=min mass": "not an output of study limits", "optimize.constraints=travel_m = 3 mm": "write",
             "optimize.constraints=travel_m >= 3 kg": "not a length", "optimize.constraints=travel_m >= far": "not a number", "optimize.constraints=breakdown_margin >= 3 mm": "no unit",
             "optimize.constraints=travl_m >= 3 mm": "travl_m is not an output", "optimize.constraints=max_load_kg.mean >= 3 g": "no key has a distribution",
             "optimize.constraints=max_load_kg.quantile_5 >= 3 g": "no statistic quantile_5; write one of mean, standard_deviation, min, quantile_05,"}
    for text, reason in wrong.items():
        run = zipact.run([*LIGHTEST, text], scratch / "refused")
        ok("%s: refused" % text, run.returncode == 2 and reason in run.stderr)
        ok("%s: nothing is written" % text, not any((scratch / "refused").glob("*.sqlite")))
    for bound in ("99 %", "99%", "0.99", "9.9e-1"):
        run = zipact.run(["study=actuate", "mesh.nodes=5", "output.errors=false", "liquid.model=none", "solver.end_time=1 ms", "optimize.variables=drive.voltage = 6 kV .. 10 kV",
                          "optimize.objective=max contraction", "optimize.constraints=contraction <= " + bound, "optimize.evaluations=10"], scratch / "bound")
        ok("%s is a bound" % bound, run.returncode == 0)
    several = zipact.run([*LIGHTEST, "optimize.objective=min mass_kg; max travel_m", "optimize.method=slsqp"], scratch / "refused")
    ok("several objectives by slsqp: refused", several.returncode == 2 and "nsga2" in several.stderr)


def check_end_of_runs(zipact, scratch):
    """Runs of which only the zip time is read end at the first 99 %; others where the actuator stays closed."""
    bath = ["study=actuate", "mesh.nodes=5", "output.errors=false", "liquid.model=submerged", "solver.end_time=0.4 s", "optimize.variables=medium.kinematic_viscosity = 20 mm2/s .. 80 mm2/s",
            "optimize.method=cobyla", "optimize.evaluations=10"]
    for objective, constraint, stays in (("min zip_time_s", [], False), ("min zip_time_s", ["optimize.constraints=contraction >= 0.5"], True)):
        run = zipact.run([*bath, "optimize.objective=" + objective, *constraint], scratch / "ends")
        lines = (scratch / "ends" / "table.csv").read_text().splitlines()
        place = lines[0].split(",").index("closed_from_s")
        ok("%s: where runs end" % [objective, *constraint], run.returncode == 0 and all((line.split(",")[place] != "") == stays for line in lines[1:]))


def check_one_tolerance(zipact, scratch):
    """Cases of a search by derivatives have the tolerance of these from the first one on, which has none."""
    dry = ["study=actuate", "mesh.nodes=5", "output.errors=false", "liquid.model=none", "solver.end_time=0.2 s"]
    run = zipact.run([*dry, "optimize.variables=load.mass = 4 g .. 8 g", "optimize.objective=min zip_time_s", "optimize.method=slsqp",
                      "optimize.evaluations=10"], scratch / "tolerance")
    lines = [line.split(",") for line in (scratch / "tolerance" / "table.csv").read_text().splitlines()]
    case = dict(zip(lines[0], lines[1]))
    key = next(name for name in lines[0] if name.startswith("load.mass"))
    sets = [*dry, "load.mass=" + case[key], "solver.stop_when_zipped=true", "solver.tolerance=2.5e-5"]
    alone = subprocess.run([zipact.program, "actuate", *(word for item in sets for word in ("--set", item)), "--quiet", "--no-plots", "--json", "-o", str(scratch / "alone")],
                           stdout=subprocess.PIPE, text=True)
    time_alone = json.loads(alone.stdout)["zip_time_s"]
    ok("values and derivatives of one tolerance", run.returncode == 0 and abs(float(case["zip_time_s"]) / time_alone - 1) < 1e-9)


def check_what_is_printed(zipact, scratch):
    """The best case, with its key, its outcome and its objective, is that of summary.json."""
    words = [word for word in zipact.command([*STRIP, "optimize.constraints=stroke_m <= 0.2 mm", "optimize.evaluations=20"], scratch / "printed") if word != "--quiet"]
    shown = subprocess.run(words, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    summary = summary_of(scratch / "printed")
    best = summary["optimum"]["cases"][0]
    ok("printed: the message", shown[0] == summary["message"] and "the best of %d cases" % len(summary["rows"]) in shown[0])
    ok("printed: the best case", "ribbon.thickness = %.12g um" % (1e6 * best["ribbon.thickness"]) in shown[1] and "converged" in shown[1])
    ok("printed: its objective", shown[2] == "    stroke_m = %.6g" % best["stroke_m"])


def main():
    program, scratch = os.path.abspath(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    zipact = Zipact(program)
    check_known_optimum(zipact, scratch)
    check_robust_strip(zipact, scratch)
    check_missing_samples(zipact, scratch)
    check_bound_of_a_motion(zipact, scratch)
    check_workers(zipact, scratch)
    check_known_front(zipact, scratch)
    check_kills(zipact, scratch)
    check_interrupt(zipact, scratch)
    check_empty_box(zipact, scratch)
    check_steep_corner(zipact, scratch)
    check_end_of_runs(zipact, scratch)
    check_one_tolerance(zipact, scratch)
    check_search_after_exclusion(zipact, scratch)
    check_what_is_printed(zipact, scratch)
    check_refusals(zipact, scratch)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
