#!/usr/bin/env python3
"""Runs the benchmark of zipping and renews its answers and the scores in docs/benchmark.md.

    scripts/make-benchmark-page.py [--check] ZIPACT      with --check, says whether they are up to date
"""

import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDER = ROOT / "benchmarks" / "zipping"


def printed(*words):
    result = subprocess.run([sys.executable, *map(str, words)], stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit("%s: exit status %d" % (words[0], result.returncode))
    return result.stdout


def main():
    old = []

    def renew(path, text):
        if path.read_text(encoding="utf-8") == text:
            return
        old.append(str(path.relative_to(ROOT)))
        if "--check" not in sys.argv:
            path.write_text(text, encoding="utf-8")

    renew(FOLDER / "references.csv", printed(FOLDER / "references.py"))
    renew(FOLDER / "zipact.csv", printed(FOLDER / "zipact.py", sys.argv[-1], ROOT / "bench" / "fronts.csv"))
    page = ROOT / "docs" / "benchmark.md"
    scores = printed(FOLDER / "score.py", "--markdown", FOLDER / "zipact.csv")
    renew(page, re.sub(r"(<!-- scores -->\n).*(?=<!-- end of scores -->)", lambda m: m.group(1) + scores, page.read_text(encoding="utf-8"), flags=re.S))
    if "--check" in sys.argv and old:
        sys.exit("out of date: %s: scripts/make-benchmark-page.py ZIPACT" % ", ".join(old))
    if "--check" in sys.argv:
        print("3 passed, 0 failed")


if __name__ == "__main__":
    main()
