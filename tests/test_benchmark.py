#!/usr/bin/env python3
"""The scorer of benchmarks/zipping finds what is wrong:  test_benchmark.py REPOSITORY SCRATCH"""

import csv
import pathlib
import subprocess
import sys

folder, scratch = pathlib.Path(sys.argv[1]) / "benchmarks" / "zipping", pathlib.Path(sys.argv[2])
counts = [0, 0]
scratch.mkdir(parents=True, exist_ok=True)


def ok(what, good):
    counts[0 if good else 1] += 1
    if not good:
        print("FAILED:", what)


def score(text):
    """(exit status, what is printed) for answers."""
    (scratch / "answers.csv").write_text(text, encoding="utf-8")
    run = subprocess.run([sys.executable, str(folder / "score.py"), str(scratch / "answers.csv")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return run.returncode, run.stdout


ours = (folder / "zipact.csv").read_text(encoding="utf-8")
answers = [line.split(",") for line in ours.splitlines()[1:]]
with open(folder / "references.csv", encoding="utf-8") as file:
    references = {row["case"]: row for row in csv.DictReader(file)}


def changed(case, value):
    return "case,value\n" + "".join("%s,%s\n" % (c, value if c == case else v) for c, v in answers)


status, text = score(ours)
ok("our answers are within the tolerances", status == 0 and "39 of 39 cases" in text)
ok("there is an answer to each case", [case for case, _ in answers] == list(references))
for case, row in references.items():
    reference, tolerance = row["reference"], float(row["tolerance"])
    if reference == "none":
        wrong, right = "1", "none"
    else:
        scale = abs(float(reference)) or 1
        wrong, right = repr(float(reference) + 1.01 * tolerance * scale), repr(float(reference) + 0.99 * tolerance * scale)
        ok("%s: none where there is an answer" % case, score(changed(case, "none"))[0] == 1)
    status, text = score(changed(case, wrong))
    lines = text.splitlines()
    ok("%s: a wrong answer is found, and printed first" % case, status == 1 and lines[1].startswith(case + " ") and "TOO LARGE" in lines[1])
    ok("%s: one within the tolerance is not" % case, score(changed(case, right))[0] == 0)
status, text = score("case,value\n" + "".join("%s,%s\n" % tuple(a) for a in answers[1:]))
ok("a missing answer counts", status == 1 and "%s: not answered" % answers[0][0] in text and "38 of 39" in text)
ok("further columns are ignored", score("who,case,value\n" + "".join("me,%s,%s\n" % tuple(a) for a in answers))[0] == 0)
for what, bad, said in (("a word", changed("rest_guided_4", "wide"), '"wide" is neither a number nor none'),
                        ("no number", changed("rest_guided_4", "nan"), "neither a number nor none"),
                        ("an unknown case", ours + "rest_guided_5,1\n", "there is no case rest_guided_5"),
                        ("a case twice", ours + "rest_guided_4,1\n", "given twice"),
                        ("no columns", "a,b\n1,2\n", "needs the columns")):
    status, text = score(bad)
    ok("%s is refused: %s" % (what, text), status == 2 and said in text)
print("%d passed, %d failed" % tuple(counts))
sys.exit(counts[1] != 0)
