#!/usr/bin/env python3
"""Which tests reach which file: writes tests/reach.txt.   reach.py BUILD

From what BUILD/mutants/results.json has recorded: a planted fault marks each test of `make check` that reaches it. A file without a fault
has the tests of its room together. tests/reach.txt has a line per room or file: its path, then the tests, the cheapest first;
the line "-" has those that reach none.
"""
import collections
import json
import os
import sys

import mutants

with open(os.path.join(sys.argv[1], "mutants/results.json"), encoding="utf-8") as kept:
    recorded = json.load(kept)["tests"]
of_number = {mutant.number: mutant for mutant in mutants.read_tables()}
reached, cost = collections.defaultdict(set), collections.Counter()
for name, (_, seconds, numbers) in recorded.items():
    program = name.split("/")[0]
    if program in mutants.ROOMS:
        continue
    cost[program] += seconds
    for number in numbers:
        fault = of_number[number]
        reached[fault.file].add(program)
        reached[fault.room() + "/"].add(program)
with open(os.path.join(mutants.HOME, "tests/reach.txt"), "w", encoding="utf-8") as file:
    print("# Which tests of `make check` reach which file, or any file of a folder: made by scripts/reach.py.", file=file)
    reached["-"] = set(cost).difference(*reached.values())
    for path in sorted(reached):
        print(path, *sorted(reached[path], key=lambda program: (cost[program], program)), file=file)
