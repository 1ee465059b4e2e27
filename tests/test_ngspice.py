#!/usr/bin/env python3
"""The supply's circuit in ngspice, the actuator replaced by its recorded capacitance over time: voltage of the electrodes and
current of the source agree.   test_ngspice.py ZIPACT SCRATCH;  77: there is no ngspice, nothing was compared"""

import csv
import pathlib
import shutil
import subprocess
import sys

OHM, FARAD, VOLT = 1e9, 10e-12, 10e3
AGREES = 1e-4  # of the largest voltage; of the largest current
SETTINGS = [
    "source.model=amplifier",
    f"source.resistance={OHM}",
    f"source.capacitance={FARAD}",
    "source.slew_rate=1e6",
    "liquid.model=none",
    "electro.breakdown_cap=false",  # its charge is capacitance times voltage
    f"drive.voltage={VOLT}",
    "mesh.nodes=21",
    "solver.tolerance=7e-5",
    "solver.end_time=0.12",
    "output.samples=40000",
    "output.errors=false",
]


def run_zipact(command, folder):
    settings = [word for setting in SETTINGS for word in ("--set", setting)]
    subprocess.run([command, "actuate", *settings, "-o", folder, "--quiet"], check=True)
    with open(folder / "table.csv", newline="") as file:
        rows = [{name: float(value or "nan") for name, value in row.items()} for row in csv.DictReader(file)]
    return rows


def netlist(rows, answers):
    """The capacitance in pF is the voltage of a node; a ramp of the slew rate, then the resistance."""
    picofarad = "\n".join(f"+ {row['time_s']:.12g} {1e12 * row['capacitance_F']:.12g}" for row in rows)
    end, step = rows[-1]["time_s"], rows[-1]["time_s"] / 20000
    return f"""an actuator behind a supply
Vc c 0 pwl(
{picofarad}
+ )
Vs s 0 pwl(0 0 {VOLT / 1e6} {VOLT})
R1 s e {OHM}
C1 e 0 {FARAD}
C2 e 0 q='1e-12*v(c)*v(e)'
.options reltol=1e-6 abstol=1e-15 vntol=1e-6
.ic v(e)=0
.tran {step} {end} 0 {step} uic
.control
run
wrdata {answers} v(e) i(vs)
quit 0
.endc
.end
"""


def run_ngspice(rows, folder):
    circuit, answers = folder / "circuit.cir", folder / "answers"
    circuit.write_text(netlist(rows, answers))
    subprocess.run(["ngspice", "-b", circuit], check=True, capture_output=True, cwd=folder)
    lines = answers.read_text().split("\n")
    return [tuple(map(float, line.split())) for line in lines if line.strip()]


def interpolated(points, t, column):
    """On the line between the two points around t, which grows from call to call."""
    while len(points) > 2 and points[1][0] < t:
        points.pop(0)
    (t0, *first), (t1, *second) = points[0], points[1]
    return first[column - 1] + (second[column - 1] - first[column - 1]) * (t - t0) / (t1 - t0)


def compare(rows, answers):
    """Largest difference of the voltage over its largest, and of the current, on which both have the drop over the resistance."""
    volts, amperes, worst_volt, worst_ampere = list(answers), list(answers), 0, 0
    for row in rows:
        t = row["time_s"]
        current = (row["source_voltage_V"] - row["voltage_V"]) / OHM
        worst_volt = max(worst_volt, abs(row["voltage_V"] - interpolated(volts, t, 1)) / VOLT)
        worst_ampere = max(worst_ampere, abs(current + interpolated(amperes, t, 3)) / (VOLT / OHM))
    return worst_volt, worst_ampere


def main():
    command, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    if not shutil.which("ngspice"):
        print("skipped: there is no ngspice; apt-get install ngspice")
        return 77
    folder.mkdir(parents=True, exist_ok=True)
    folder = folder.resolve()
    rows = run_zipact(command, folder)
    volt, ampere = compare(rows, run_ngspice(rows, folder))
    lowest = min(row["voltage_V"] for row in rows[len(rows) // 2 :])
    print(f"{len(rows)} rows, {lowest:.0f} V while zipping; apart: voltage {volt:.1e}, current {ampere:.1e}, allowed {AGREES}")
    return 0 if volt < AGREES and ampere < AGREES else 1


sys.exit(main())
