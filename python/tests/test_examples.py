"""The examples run, and say what their heads promise."""

import os
import re
import subprocess
import sys

import pytest

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


def test_lever(tmp_path):
    pytest.importorskip("matplotlib")
    said = run("lever.py", tmp_path / "lever.gif")
    worst, target, before, after = map(float, re.findall(r"[\d.]*\d", said))
    assert worst < 0.01 and target == 1.5 and before + 50 < after < 5000  # 0.0034 measured
    assert os.path.getsize(tmp_path / "lever.gif") > 50000


@pytest.mark.nightly
def test_notebooks():
    """They print what is committed."""
    pytest.importorskip("nbclient")
    script = os.path.join(PYTHON, "..", "scripts", "run-notebooks.py")
    found = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert found.returncode == 0, found.stdout + found.stderr
    assert found.stdout.count("s of CPU") == 7


def test_readme():
    """The five lines of the README, as they stand there."""
    with open(os.path.join(PYTHON, "..", "README.md"), encoding="utf-8") as file:
        lines = [line[4:] for line in re.search(r"(    import zipact.*\n(?:    .*\n)+)", file.read()).group(1).splitlines()]
    assert len(lines) == 5
    said = subprocess.run([sys.executable, "-c", "\n".join(lines)], check=True, capture_output=True, text=True).stdout
    pull_in, release = map(float, said.split())
    assert 0 < release < pull_in
