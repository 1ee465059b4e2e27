#!/usr/bin/env python3
"""The command without memory:  python3 tests/test_no_memory.py ZIPACT FAIL_MALLOC.so SCRATCH

Allocations are made to fail, one at a time or all from one on, also those inside libfyaml, UDUNITS-2, HDF5, jansson and
NLopt, which crashed, called exit(2) or took the text for bad YAML: 36 of 110 such failures ended so. Then runs get less
address space than they want. Wanted: exit status 3 with a message of ours and
what was computed, or 0 with the results of always. Most of 30000 allocations read the unit database: of those a few are
tried, of others many. Last line: "N passed, N failed".
"""

import json
import os
import resource
import shutil
import subprocess
import sys

SHORT = ["--set", "mesh.nodes=5", "--set", "output.samples=20", "--set", "output.shapes=3"]
DATABASE = 27000  # allocations that read the unit database, at least

command, library, scratch = [os.path.abspath(name) for name in sys.argv[1:]]
failures = []
passed = 0


def check(good, what):
    global passed
    passed += bool(good)
    if not good:
        failures.append(what)
        print("FAILED: " + what)


def run(words, at=0, on=False, count=None, limit=None):
    """=> exit status, standard output, standard error. `limit`: bytes of address space."""
    settings = {"PATH": "/nowhere", "LD_PRELOAD": library, "FAIL_AT": str(at), "FAIL_ON": str(int(on))}
    if count:
        settings["FAIL_COUNT"] = count
    if limit:
        settings["MALLOC_ARENA_MAX"] = "1"  # threads that meet in malloc would reserve 64 MB of it
    less = (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))) if limit else None
    done = subprocess.run([command] + words, env=settings, capture_output=True, text=True, preexec_fn=less)
    return done.returncode, done.stdout, done.stderr


def allocations(words):
    status, output, _ = run(words, count="count")
    check(status == 0, "%s: status %d with memory" % (" ".join(words), status))
    with open("count", encoding="ascii") as file:
        return int(file.read()), output


def without_times(text):
    """The summary without what differs from run to run."""
    def strip(item):
        if isinstance(item, dict):
            return {k: strip(v) for k, v in item.items() if k not in ("wall_time_s", "real_time_factor")}
        return [strip(x) for x in item] if isinstance(item, list) else item

    return strip(json.loads(text)) if text.startswith(("{", "[")) else text


def says_no_memory(message):
    """Its last line is ours and names the reason."""
    last = message.strip().splitlines()[-1:]
    return last and last[0].startswith("zipact: ") and ("memory" in last[0] or "libfyaml cannot start" in last[0])


def fail_each(words, numbers, on=False):
    """Let the allocations `numbers` of the command fail."""
    _, expected = allocations(words)
    for n in numbers:
        status, output, message = run(words, n, on)
        what = "%s, allocation %d%s failing" % (words[0], n, " and all after it" if on else "")
        if status == 0:
            check(without_times(output) == without_times(expected), what + ": status 0, but another output")
        else:
            check(status == 3 and says_no_memory(message), "%s: status %d, %s" % (what, status, message[:200]))


def some(count, most):
    """At most `most` numbers from 1 to count, evenly."""
    return range(1, count + 1, 1 + (count - 1) // most)


def without_database(count, most):
    """All of the first 300, some of the database, at most `most` of the rest."""
    rest = range(DATABASE, count + 1, 1 + (count - DATABASE) // most)
    return [*range(1, 301), *range(301, DATABASE, 331), *rest]


def every_failure_is_survived():
    study = ["stationary", *SHORT, "--json", "-o", "study"]
    count, _ = allocations(study)
    check(count > DATABASE, "only %d allocations: does the library count?" % count)
    fail_each(study, without_database(count, 300))
    fail_each(study, [*range(5, 301, 37), *range(301, DATABASE, 3001), *range(DATABASE, count, 53)], True)
    check(run(study)[0] == 0, "works again with memory")
    left = [name for _, _, names in os.walk("study") for name in names if name.startswith(".")]
    check(not left, "left behind: %s" % left)


def other_commands_survive():
    sweep = ["actuate", *SHORT, "--set", "solver.end_time=1ms", "--set", "load.mass=[8 g, 9 g]", "--json", "-o", "sweep"]
    fit = ["run", os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples/calibrate-modulus.yaml")]
    fit += ["--set", "mesh.nodes=9", "--json", "-o", "fit"]
    for words in sweep, fit:
        count, _ = allocations(words)
        fail_each(words, range(DATABASE, count + 1, 1 + (count - DATABASE) // 120))
    for words in ["keys", "--json"], ["--version"]:
        count, _ = allocations(words)
        fail_each(words, some(count, 40))


def rows_of(folder):
    with open(folder + "/table.csv", encoding="ascii") as file:
        return len(file.readlines()) - 1


def large_sweep(limit=None):
    """A sweep of 20000 cases in so much address space; it ended in a crash, and then after some hundred runs, whose
    results it all had in memory => exit status, standard error."""
    masses = ", ".join("%d mg" % (i + 1) for i in range(20000))
    with open("large.yaml", "w", encoding="ascii") as file:
        file.write("study: actuate\nliquid.model: none\nmesh: {nodes: 5}\nsolver: {end_time: 1 ms}\nload:\n  mass: [%s]\n" % masses)
    status, _, message = run(["run", "large.yaml", "--resume", "--quiet", "-o", "large"], limit=limit)
    return status, message


def a_large_sweep_needs_little_memory():
    shutil.rmtree("large", ignore_errors=True)
    status, message = large_sweep(54 << 20)  # at 50 MB the threads run out in one run of five: the rows need 48 MB and more of address space
    check(status == 3 and says_no_memory(message), "sweep in 54 MB: status %d, %s" % (status, message[:200]))
    check(rows_of("large") == 20000, "sweep in 54 MB: %d rows" % rows_of("large"))
    status, message = large_sweep(120 << 20)
    check(status == 0, "sweep in 120 MB: status %d, %s" % (status, message[:200]))
    with open("large/summary.json", encoding="ascii") as file:
        check(len(json.load(file)["rows"]) == 20000, "sweep in 120 MB: other rows")
    check(sorted(os.listdir("large")) == ["journal.sqlite", "results.h5", "scenario.yaml", "summary.json", "table.csv"],
          "sweep in 120 MB: %s" % sorted(os.listdir("large")))


def any_limit_is_survived():
    """From where the loader cannot load the program (its status is 127) to where a run has enough."""
    enough = 0
    for megabytes in range(8, 60, 2):
        status, _, message = run(["profile", "--set", "profile.shape=cubic", "-o", "limit"], limit=megabytes << 20)
        good = status == 0 or (status == 127 and "shared libraries" in message) or (status == 3 and says_no_memory(message))
        check(good, "%d MB: status %d, %s" % (megabytes, status, message[:200]))
        enough += status == 0
    check(enough > 3, "a profile needs less than 50 MB")


os.makedirs(scratch, exist_ok=True)
os.chdir(scratch)
every_failure_is_survived()
other_commands_survive()
a_large_sweep_needs_little_memory()
any_limit_is_survived()
print("%d passed, %d failed" % (passed, len(failures)))
sys.exit(1 if failures else 0)
