"""zipact bench: its names are those that scripts read, its errors below what they are said to be.   bench.py ZIPACT"""

import json
import subprocess
import sys

NAMES = {"name", "nodes", "ns_per_node_step", "steps_per_simulated_second", "seconds_per_simulated_second", "cpu_s",
         "error"}
LARGEST = {("swing of a cantilever", 21): 3e-3, ("swing of a cantilever", 61): 1.5e-3,
           ("swing of a cantilever", 131): 1.2e-3, ("explicit swing", 131): 1e-4, ("rest of a guided strip", 33): 1e-3}

rows = json.loads(subprocess.run([sys.argv[1], "bench", "--json"], check=True, capture_output=True).stdout)["rows"]
failures = ["%s: lacks %s" % (row["name"], NAMES - set(row)) for row in rows if NAMES - set(row)]
failures += ["%(name)s: %(cpu_s)s CPU s" % row for row in rows if not row["cpu_s"] > 0]
errors = {(row["name"], row["nodes"]): row["error"] for row in rows}
for row, largest in LARGEST.items():
    print("%s, %d nodes: error %.2e, at most %.1e" % (row + (errors[row], largest)))
    if not errors[row] < largest:
        failures.append("%s, %d nodes: error %g" % (row + (errors[row],)))
print("\n".join(failures))
sys.exit(1 if failures else 0)
