#!/usr/bin/env python3
"""What edges, film and leak do to the stroke by capacitance: meter.csv, on standard output.   meter.py BUILD

The example capacitance-meter with one of them at a time, and with none: without liquid strong internal damping takes the
place of the liquid's. Each row compares a reading with the true stroke in the middle of its window."""
import csv, json, pathlib, subprocess, sys, tempfile

EXAMPLE = pathlib.Path(__file__).resolve().parent.parent / "examples" / "capacitance-meter.yaml"
DRY = ["liquid.model=none", "damping.internal=20 ms", "solver.end_time=1.2 s"]
CASES = {
    "none": DRY + ["electro.edges=false"],
    "edges": DRY + ["electro.edges=true"],
    "leak": DRY + ["electro.edges=false", "insulator.resistivity=1e13", "medium.resistivity=1e12"],
    "film": ["electro.edges=false"],
}


def run(command, folder, keys):
    """=> (summary, rows of the table)"""
    settings = [word for key in keys + ["output.errors=false", "output.samples=20000"] for word in ("--set", key)]
    given = [command, "run", str(EXAMPLE), "--no-plots", "--quiet", "--json", "-o", folder] + settings
    summary = json.loads(subprocess.run(given, check=True, stdout=subprocess.PIPE).stdout)
    with open(folder + "/table.csv") as table:
        return summary, [{name: float(text) if text else None for name, text in row.items()} for row in csv.DictReader(table)]


def stroke_at(rows, time):
    """Between two rows, linear."""
    after = next(k for k, row in enumerate(rows) if row["time_s"] >= time)
    late, early = rows[after], rows[max(after - 1, 0)]
    span = late["time_s"] - early["time_s"]
    share = (time - early["time_s"]) / span if span > 0 else 0
    return early["stroke_m"] + share * (late["stroke_m"] - early["stroke_m"])


def readings(rows, window):
    """(middle of the window, true stroke there, reading), of each window that a row shows"""
    for k in range(1, int(rows[-1]["time_s"] / window)):
        row = next(row for row in rows if row["time_s"] >= k * window)
        if row["time_s"] < (k + 1) * window and row["sensed_stroke_m"] is not None:
            middle = (k - 0.5) * window
            yield middle, stroke_at(rows, middle), row["sensed_stroke_m"]


def main():
    command = sys.argv[1] + "/zipact"
    out = csv.writer(sys.stdout, lineterminator="\n")
    out.writerow(["case", "time_s", "stroke_m", "sensed_stroke_m", "error_m"])
    with tempfile.TemporaryDirectory() as folder:
        for name, keys in CASES.items():
            summary, rows = run(command, folder, keys)
            parts = ["%s %.3g mm" % (part, 1e3 * summary["sense_%s_error_m" % part]) for part in ("zip", "hold", "release")]
            print("%-6s root mean square: %s" % (name, ", ".join(parts)), file=sys.stderr)
            for middle, true, sensed in readings(rows, summary["sense_window_s"]):
                out.writerow([name, "%.6g" % middle, "%.6g" % true, "%.6g" % sensed, "%.6g" % (sensed - true)])


main()
