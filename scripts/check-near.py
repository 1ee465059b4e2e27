#!/usr/bin/env python3
"""Builds and runs those tests of `make check` that reach what has changed (.ci/changed).   check-near.py BUILD [--list]

tests/reach.txt says which these are: of a file, or of its folder where it has no line of its own; and test_NAME of NAME.c. A
header has those of the source of its name. Tests that the table does not know run, too. All run for what every file depends on: public headers,
the tables of keys, the build.
--list only says which.
"""
import os
import re
import subprocess
import sys

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# What any change may break, in seconds: links and rules of style.
ALWAYS = {"rules", "links"}
ALL = re.compile(r"^(include/|CMakeLists\.txt$|tests/(CMakeLists\.txt|.*\.h|suite\.c)$|src/base/|src/def/\w+\.def$)")
# What has no faults planted in it.
BY_HAND = {"docs/": {"docs_current", "materials_current", "test_schema"}, "plots/": {"test_templates", "test_report"},
           "examples/": {"test_batch_examples", "test_schema", "test_scenario"}, "benchmarks/": {"test_benchmark"},
           "bench/": {"designs_limits", "designs_kept", "rates"}, "scripts/deps.sh": {"deps"}, "packaging/": {"test_install"}}
# What tests of `make check` do not look at.
BESIDE = {"python/": "make python", "octave/": "make octave", "web/": "make check-web", "docs/": "make html check-docs",
          "windows/": "make windows", "packaging/": "make deb", ".ci/": ".ci/run"}


def read_reach():
    with open(os.path.join(HOME, "tests/reach.txt"), encoding="utf-8") as file:
        lines = [line.split() for line in file if not line.startswith("#")]
    return {words[0]: set(words[1:]) for words in lines}


def folders_of(path):
    """Of src/a/b/c.c: src/a/b/, src/a/, src/"""
    while path := os.path.dirname(path):
        yield path + "/"


def tests_near(path, reach, known):
    """The tests that reach the file; None: all."""
    name = os.path.splitext(os.path.basename(path))[0]
    if ALL.search(path):
        return None
    if path.startswith("tests/"):
        return {name} & known
    for place, tests in BY_HAND.items():
        if path.startswith(place):
            return (tests | {name}) & known
    for place in (path, os.path.splitext(path)[0] + ".c", *folders_of(path)):
        if place in reach:
            return (reach[place] | {"test_" + name}) & known
    return {"test_" + name} & known


def main():
    build, only_list = sys.argv[1], "--list" in sys.argv
    changed = subprocess.run([os.path.join(HOME, ".ci/changed")], check=True, stdout=subprocess.PIPE, text=True).stdout.split("\n")[:-1]
    listed = subprocess.run(["ctest", "--test-dir", build, "-LE", "nightly", "-N"], check=True, stdout=subprocess.PIPE, text=True)
    known = set(re.findall(r"^ *Test +#\d+: (\S+)", listed.stdout, re.M))
    reach = read_reach()
    near = [tests_near(path, reach, known) for path in changed]
    told = set().union(*reach.values(), *BY_HAND.values())
    new = {name for name in known - told if name.startswith("test_")}
    chosen = known if None in near else ALWAYS.union(*near, new if any(path.startswith(("src/", "cli/", "reproduce/")) for path in changed) else ())
    print("%d of %d tests: %s" % (len(chosen), len(known), "all" if chosen == known else " ".join(sorted(chosen))), flush=True)
    for place, command in BESIDE.items():
        if any(path.startswith(place) for path in changed):
            print("also: " + command, flush=True)
    if only_list:
        return 0
    targets = subprocess.run(["cmake", "--build", build, "--target", "help"], check=True, stdout=subprocess.PIPE, text=True).stdout
    built = [name for name in sorted(chosen) if re.search(r"^\.\.\. %s$" % name, targets, re.M)] + ["zipact_command"]
    if chosen == known or any(not name.startswith("test_") for name in chosen - ALWAYS):  # scripts, which want all of it
        built = ["all"]
    status = subprocess.run(["cmake", "--build", build, "-j", str(os.cpu_count()), "--target", *built, "--", "--no-print-directory"]).returncode
    words = ["ctest", "--test-dir", build, "--output-on-failure", "-j", str(os.cpu_count()), "-LE", "nightly"]
    return status or subprocess.run(words + ["-R", "^(%s)$" % "|".join(sorted(chosen))]).returncode


if __name__ == "__main__":
    sys.exit(main())
