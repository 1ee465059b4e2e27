#!/usr/bin/env python3
"""Scores the answers of any code:  score.py ANSWERS.csv [--markdown]

ANSWERS.csv has the columns case and value; other columns are ignored. Values are in the units of references.csv; "none" says
that there is no such voltage or time. Prints the errors, the largest over its tolerance first. Exit status 0 if every case is
within its tolerance, 1 if not, 2 if the file cannot be read.
"""

import csv
import math
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))


def fail(message):
    sys.stderr.write("score.py: %s\n" % message)
    sys.exit(2)


def read(path, columns):
    """Rows by their case."""
    try:
        with open(path, encoding="utf-8-sig", newline="") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        fail("%s: %s" % (path, error))
    found = {}
    for number, row in enumerate(rows, 2):
        row = {(name or "").strip(): (value or "").strip() for name, value in row.items() if not isinstance(value, list)}
        if any(column not in row for column in columns):
            fail("%s:1: needs the columns %s" % (path, ", ".join(columns)))
        if row["case"] in found:
            fail("%s:%d: case %s is given twice" % (path, number, row["case"]))
        found[row["case"]] = dict(row, line=number)
    return found


def number_of(path, row):
    if row["value"] == "none":
        return None
    try:
        value = float(row["value"])
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        fail("%s:%d: %s: \"%s\" is neither a number nor none" % (path, row["line"], row["case"], row["value"]))
    return value


def error_of(value, reference):
    """Relative; absolute where the reference is 0. Infinite where one of them is none."""
    if value is None or reference is None:
        return 0 if value is reference else math.inf
    return abs(value - reference) / (abs(reference) or 1)


def score(answers_path):
    """(case, unit, reference, value, error, tolerance, kind), the worst first; missing cases."""
    references = read(os.path.join(HERE, "references.csv"), ("case", "unit", "reference", "tolerance", "kind"))
    answers = read(answers_path, ("case", "value"))
    for case, row in answers.items():
        if case not in references:
            fail("%s:%d: there is no case %s" % (answers_path, row["line"], case))
    rows = []
    for case, row in references.items():
        if case not in answers:
            continue
        value = number_of(answers_path, answers[case])
        reference = None if row["reference"] == "none" else float(row["reference"])
        rows.append((case, row["unit"], row["reference"], answers[case]["value"], error_of(value, reference), float(row["tolerance"]), row["kind"]))
    rows.sort(key=lambda r: (-r[4] / r[5], r[0]))
    return rows, [case for case in references if case not in answers]


def shown(error):
    return "no such answer" if math.isinf(error) else "%.2g %%" % (100 * error)


def main():
    words = [word for word in sys.argv[1:] if word != "--markdown"]
    if len(words) != 1:
        fail("give one file of answers")
    rows, missing = score(words[0])
    within = sum(row[4] <= row[5] for row in rows)
    if "--markdown" in sys.argv:
        print("| case | error | tolerance | reference | answer | unit | reference by |\n|---|---|---|---|---|---|---|")
        for case, unit, reference, value, error, tolerance, kind in rows:
            print("| `%s` | %s%s | %g %% | %s | %s | %s | %s |" % (case, shown(error), "" if error <= tolerance else " **too large**", 100 * tolerance, reference,
                                                               value, "–" if unit == "1" else unit, kind))
    else:
        print("%-26s %14s %10s %14s %14s %-5s %s" % ("case", "error", "tolerance", "reference", "answer", "unit", "reference by"))
        for case, unit, reference, value, error, tolerance, kind in rows:
            print("%-26s %14s %8g %% %14s %14s %-5s %s%s" % (case, shown(error), 100 * tolerance, reference, value, unit, kind,
                                                          "" if error <= tolerance else "  TOO LARGE"))
    for case in missing:
        print("%s%s: not answered" % ("\n" if "--markdown" in sys.argv else "", case))
    total = len(rows) + len(missing)
    print("%s%d of %d cases within their tolerance" % ("\n" if "--markdown" in sys.argv else "", within, total))
    sys.exit(0 if within == total else 1)


if __name__ == "__main__":
    main()
