"""The examples run, and say what their heads promise."""

import os
import re
import subprocess
import sys

PYTHON = os.path.join(os.path.dirname(__file__), "..")
DATA = os.path.join(PYTHON, "..", "examples", "data")


def run(name, *arguments):
    script = os.path.join(PYTHON, "examples", name)
    return subprocess.run([sys.executable, script, *arguments], check=True, capture_output=True, text=True).stdout


def test_calibrate(tmp_path):
    said = run("calibrate.py", os.path.join(DATA, "finite-element-strokes.csv"), tmp_path / "calibrate.svg")
    assert abs(float(re.search(r"modulus ([\d.]+)", said).group(1)) - 205) < 0.5  # that of the finite elements
    assert os.path.getsize(tmp_path / "calibrate.svg") > 5000


def test_hold(tmp_path):
    said = run("hold.py", tmp_path / "hold.svg")
    worst, highest, pull_in = (float(text) for text in re.findall(r"([\d.]+) (?:um|V)", said))
    assert worst < 30 and highest < pull_in
    assert os.path.getsize(tmp_path / "hold.svg") > 5000
