#!/usr/bin/env python3
"""The examples of zipact batch for other programs:  python3 tests/test_batch_examples.py ZIPACT SCRATCH

GNU parallel, snakemake, Dakota and Optuna where they are installed; Dakota's driver always, with a file of parameters as
Dakota writes it, and Optuna's example with a stand-in for Optuna. Standard library only. Last line: "N passed, N failed".
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys

from counting import finish, ok

HERE = pathlib.Path(__file__).resolve().parent.parent / "examples" / "batch"

# As Dakota 6 writes it for two variables and two responses.
PARAMETERS = """                                          2 variables
                     5.000000000000000e-05 ribbon.thickness
                     8.000000000000000e-03 load.mass
                                          2 functions
                                          1 ASV_1:pull_in_voltage_V
                                          1 ASV_2:%s
                                          2 derivative_variables
                                          1 DVV_1:ribbon.thickness
                                          2 DVV_2:load.mass
                                          0 analysis_components
                                          1 eval_id
"""

# Optuna's names in the example, with equal steps in place of its search.
STAND_IN = """
class TrialPruned(Exception):
    pass


class Trial:
    def __init__(self, share):
        self.share, self.params = share, {}

    def suggest_float(self, name, low, high, log=False):
        self.params[name] = low * (high / low) ** self.share if log else low + (high - low) * self.share
        return self.params[name]


class Study:
    best_value, best_params = float("-inf"), {}

    def optimize(self, objective, n_trials):
        for k in range(5):
            trial = Trial(k / 4)
            value = objective(trial)
            if value > self.best_value:
                self.best_value, self.best_params = value, trial.params


def create_study(direction):
    assert direction == "maximize"
    return Study()
"""


def run(words, folder, **more):
    return subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, text=True, **more)


def pull_in(text):
    return [json.loads(line)["pull_in_voltage_V"] for line in text.splitlines()]


def check_parallel(folder):
    cases = (HERE / "cases.jsonl").read_text()
    alone = run(["zipact", "batch", "--set", "liquid.model=none", "--set", "output.errors=false"], folder, input=cases)
    answers = pull_in(alone.stdout)
    ok("cases.jsonl: thicker strips, which hang less far open, pull in earlier", len(answers) == 4 and answers == sorted(answers, reverse=True))
    if shutil.which("parallel"):
        shared = run(["sh", str(HERE / "parallel.sh")], folder, input=cases)
        ok("GNU parallel: the same answers", shared.returncode == 0 and pull_in(shared.stdout) == answers)


def check_dakota(folder):
    driver = [sys.executable, str(HERE / "dakota_driver.py"), "params.in", "results.out"]
    (folder / "params.in").write_text(PARAMETERS % "travel_m")
    done = run(driver, folder)
    values = [line.split() for line in (folder / "results.out").read_text().splitlines()]
    ok("Dakota's driver: both outputs", done.returncode == 0 and [v[1] for v in values] == ["pull_in_voltage_V", "travel_m"] and 3e3 < float(values[0][0]) < 9e3)
    (folder / "params.in").write_text(PARAMETERS % "no_such_output")
    run(driver, folder)
    ok("Dakota's driver: what has no answer fails", (folder / "results.out").read_text().splitlines()[1] == "fail")
    if shutil.which("dakota"):
        for name in ("dakota.in", "dakota_driver.py"):
            shutil.copy(HERE / name, folder)
        ok("Dakota", run(["dakota", "-i", "dakota.in"], folder).returncode == 0)


def check_optuna(folder):
    (folder / "optuna.py").write_text(STAND_IN)
    script = run([sys.executable, str(HERE / "optuna_search.py")], folder, env={**os.environ, "PYTHONPATH": str(folder)})
    ok("Optuna's example, with a stand-in", script.returncode == 0 and " g with {'thickness'" in script.stdout)


def check_snakemake(folder):
    if not shutil.which("snakemake"):
        return
    shutil.copy(HERE / "Snakefile", folder)
    done = run(["snakemake", "--cores", "2", "--quiet"], folder, stderr=subprocess.DEVNULL)
    rows = (folder / "pull-in.csv").read_text().splitlines() if done.returncode == 0 else []
    ok("snakemake: a table of all", len(rows) == 21 and rows[0].startswith("thickness_um,load.mass_kg,outcome"))


def main():
    program, scratch = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    (scratch / "bin").mkdir(parents=True)
    (scratch / "bin" / "zipact").symlink_to(program)
    os.environ["PATH"] = "%s:%s" % (scratch / "bin", os.environ["PATH"])
    for check in (check_parallel, check_dakota, check_optuna, check_snakemake):
        folder = scratch / check.__name__
        folder.mkdir()
        check(folder)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
