#!/usr/bin/env python3
"""docs/verification.md from what the tests measure: make-verification-page.py BUILD

Runs every test of BUILD/tests that holds a tolerance (ck_near, ck_below and their like in tests/check_util.h), each with ZIPACT_CHECKS
naming a file of its own. What a test is about is the comment above it; tests/telling.csv names the most telling comparisons.
"""
import csv
import math
import os
import re
import subprocess
import sys
import tempfile
from collections import namedtuple

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
Check = namedtuple("Check", "room test value against measured allowed")

INTRO = """# How results are verified

Made by `make verification` from the tests, whose run measured every number on this page. A comparison requires either a value
within a relative error of another, or a number below a limit; "measured" is this error or number. A test fails if it exceeds the
allowed one. Of repeated comparisons the page shows the one nearest to its limit.

Further tests compare bits, texts and files, check that wrong input is refused, make every allocation fail once, and fuzz the reader of scenarios: they pass or fail, without a
number. [Validity](validity.md) shows where the simple models deviate from the fuller ones, and [compares with experiments](validity.md#experiments).

| room | tests with numbers | comparisons |
|---|---|---|
"""


def checks_of(room, program, folder):
    """Runs a test; what it compared."""
    record = os.path.join(folder, room + ".checks")  # "front" is also a folder of a test
    done = subprocess.run([os.path.abspath(program)], cwd=folder, env={**os.environ, "ZIPACT_CHECKS": record},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode:
        sys.exit(f"{program} failed:\n{done.stdout}")
    if not os.path.exists(record):  # it compares no numbers
        return
    with open(record, encoding="utf-8") as lines:
        for line in lines:
            _, test, value, against, measured, allowed = line.rstrip("\n").split("\t")
            error = float(measured)
            yield Check(room, test, value, against, 0 if math.isnan(error) else error, float(allowed))


def comment_above(source, test):
    """First sentence of the comment above a test or what it calls; its name in words where there is none."""
    found = re.search(r"/\*((?:(?!\*/).)*)\*/\n(?:\w*TESTS?\(%s\b|static [^\n;]*\b%s\()" % (test, test), source, re.S)
    text = " ".join(found.group(1).replace("*", " ").split()) if found else ""
    sentence = re.split(r"(?<=[a-z0-9)][.:;]) (?=[A-Z0-9])", text)[0].rstrip(".:;")
    if not sentence or sentence.startswith(("Measured", "Theirs")):
        return test.removeprefix("test_").replace("_", " ")
    return sentence


def share(check):
    """Of what is allowed; nothing where an error is nothing."""
    return check.measured / check.allowed if check.measured else 0


def cell(text):
    return text.replace("|", "\\|").replace("\\\n", " ")


def code(text):
    return "`" + cell(text) + "`"


def small(number):
    return "0" if number == 0 else f"{number:.1e}".replace("e-0", "e-").replace("e+00", "") if abs(number) < 0.1 else f"{number:.2g}"


def worst(checks):
    return max(checks, key=share)


def by(checks, field):
    groups = {}
    for check in checks:
        groups.setdefault(getattr(check, field), []).append(check)
    return groups


def telling(checks):
    """The comparisons of tests/telling.csv; one that no test makes is an error."""
    rows = []
    with open(os.path.join(HOME, "tests", "telling.csv"), newline="", encoding="utf-8") as file:
        for named in csv.DictReader(file):
            found = [c for c in checks if c.test == named["test"] and named["comparison"] in c.value + " " + c.against]
            if not found:
                sys.exit(f"tests/telling.csv: no comparison with {named['comparison']} in {named['test']}")
            w = worst(found)
            rows.append(f"| {named['what']} | {named['against']} | {small(w.measured)} | {small(w.allowed)} | "
                        f"`test_{w.room}`, {w.test.removeprefix('test_')} |")
    return rows


def page(checks):
    rooms = by(checks, "room")
    lines = [INTRO.rstrip("\n")]
    for room, own in rooms.items():
        lines.append(f"| [{room}](#{room}) | {len(by(own, 'test'))} | {len(own)} |")
    lines += ["", "## The most telling", "", "| what | against | measured | allowed | test |", "|---|---|---|---|---|", *telling(checks)]
    for room, own in rooms.items():
        with open(os.path.join(HOME, "tests", f"test_{room}.c"), encoding="utf-8") as file:
            source = file.read()
        lines += ["", f"## {room}", "", "| what is checked | value | against | measured | allowed | of | test |", "|---|---|---|---|---|---|---|"]
        for test, group in by(own, "test").items():
            w = worst(group)
            against = code(w.against) if w.against else "a limit"
            lines.append(f"| {cell(comment_above(source, test))} | {code(w.value)} | {against} | {small(w.measured)} | "
                         f"{small(w.allowed)} | {len(group)} | {test} |")
    return "\n".join(lines) + "\n"


def main():
    tests = os.path.join(sys.argv[1], "tests")
    rooms = [name[5:-2] for name in sorted(os.listdir(os.path.join(HOME, "tests"))) if re.fullmatch(r"test_\w+\.c", name)]
    checks = []
    with tempfile.TemporaryDirectory() as folder:
        for room in rooms:
            with open(os.path.join(HOME, "tests", f"test_{room}.c"), encoding="utf-8") as file:
                if re.search(r"\bck_(near|below|assert_double_eq_tol)\(", file.read()):
                    checks += checks_of(room, os.path.join(tests, "test_" + room), folder)
    text = page(checks)
    with open(os.path.join(HOME, "docs", "verification.md"), "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
