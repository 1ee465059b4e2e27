#!/usr/bin/env python3
"""Optuna chooses, zipact batch answers: the largest load that a strip of any thickness and width lifts at 6 kV.

    pip install optuna
    python3 optuna_search.py
"""

import json
import subprocess

import optuna


class Zipact:
    """One process for all cases: a line in, a line out."""

    def __init__(self, *settings):
        words = ["zipact", "batch", *(word for setting in settings for word in ("--set", setting))]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def __call__(self, **keys):
        print(json.dumps(keys), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())

    def close(self):
        self.process.stdin.close()
        self.process.wait()


zipact = Zipact("study=limits", "liquid.model=none", "drive.voltage=6 kV", "output.errors=false", "mesh.nodes=31")


def largest_load(trial):
    """=> kg. A case without an answer is pruned, not counted as 0."""
    thickness, width = trial.suggest_float("thickness", 20e-6, 200e-6, log=True), trial.suggest_float("width", 5e-3, 40e-3)
    answer = zipact(**{"ribbon.thickness": thickness, "ribbon.width": width})
    if answer.get("max_load_kg") is None:
        raise optuna.TrialPruned(answer.get("error") or answer["message"])
    return answer["max_load_kg"]


study = optuna.create_study(direction="maximize")
study.optimize(largest_load, n_trials=40)
zipact.close()
print("%.1f g with %s" % (1e3 * study.best_value, study.best_params))
