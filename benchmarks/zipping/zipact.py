#!/usr/bin/env python3
"""The answers of zipact to the benchmark:  zipact.py ZIPACT FRONTS.csv > zipact.csv

FRONTS.csv is what bench/fronts.c prints. The mesh and the tolerance are the defaults of the command, as its users have
them, but for the mesh of the pouch, whose zip front is 0.1 mm long.
"""

import csv
import json
import subprocess
import sys
import tempfile

G = 9.81
DRY = {"liquid.model": "none"}
BEAM = {**DRY, "actuator.kind": "ribbon", "ribbon.length": "45 mm", "ribbon.thickness": "100 um", "ribbon.plane": "stress", "ribbon.density": 0,
        "gravity": 0, "load.mass": 0, "drive.voltage": 0}
EI = 200e9 * 12.7e-3 * 100e-6**3 / 12


def beam(end, load):
    """A weightless beam of 45 mm under a load at its end, in units of EI / L^2."""
    return {**BEAM, "actuator.right_end": end, "load.force": "%.17g N" % (load * EI / 45e-3**2)}


def heavy(weight):
    """A cantilever under its own weight per length, in units of EI / L^3: as long as that takes."""
    per_length = 7850 * 12.7e-3 * 100e-6 * G
    return {**BEAM, "actuator.right_end": "free", "ribbon.density": "7850 kg/m3", "gravity": "9.81 m/s2",
            "ribbon.length": "%.17g m" % ((weight * EI / per_length) ** (1 / 3))}


def opening(mass):
    return {**DRY, "ribbon.plane": "stress", "ribbon.density": 0, "load.mass": mass}


def flange(end):
    """A beam over a flat electrode: 100 mm long, 1 mm thick, gap 1 mm, bare, in vacuum."""
    return {**DRY, "actuator.kind": "flange", "actuator.right_end": end, "ribbon.length": "100 mm", "ribbon.thickness": "1 mm",
            "ribbon.plane": "stress", "gravity": 0, "load.mass": 0, "insulator.thickness": 0, "medium.permittivity": 1,
            "medium.breakdown_field": "1 GV/m", "electro.gap_offset": "1 mm", "drive.voltage": "30 kV"}


def curved(power, eta):
    """A beam beside a curved electrode, 100 mm long and 1 mm thick; the electrode rises by 1 mm and has an insulator of eta mm."""
    return {**flange("free"), "actuator.kind": "curved", "electro.gap_offset": 0, "counter.height": "1 mm", "counter.power": power,
            "lower.insulator.thickness": "%g mm" % (4 * eta), "lower.insulator.permittivity": 4, "electro.breakdown_cap": "false"}
# A bare plate of 300 um x 40 um on a spring of 8 N/m, gap 5 um, with a stop at 1 um, in vacuum.
PLATE = {**DRY, "actuator.kind": "plate", "ribbon.length": "300 um", "ribbon.width": "40 um", "plate.gap": "5 um", "plate.stop_gap": "1 um",
         "plate.stiffness": "8 N/m", "medium.permittivity": 1, "drive.voltage": "80 V"}


def load_of_voltage(voltage):
    """eps0 w V^2 L^4 / (2 EI g^3) of flange() and curved()."""
    return 8.8541878128e-12 * voltage**2 * 0.1**4 / (2 * 200e9 * 1e-9 / 12 * 1e-9)


def curling(share):
    """flange() with a natural curvature towards the electrode: `share` times the root of load_of_voltage(), times gap / length^2."""
    per_volt = share * load_of_voltage(1) ** 0.5 * 1e-3 / 0.1**2
    return {**flange("free"), "segment_1.length": "100 mm", "segment_1.thickness": "1 mm", "segment_1.curvature_per_volt": "%.12g 1/m/V" % per_volt}


def wedge(separation, cap):
    return {**DRY, "profile.shape": "cubic", "isometric.separation": separation, "drive.voltage": "6 kV", "electro.breakdown_cap": cap}


# a pouch held at a strain; the film's metal stretches as 18 um of polyester do, and is thin so that it hardly bends
POUCH = {"actuator.kind": "pouch", "isometric.strain": 0.0215853, "drive.voltage": "8 kV", "gravity": 0, "load.mass": 0, "film.roughness": "0.001 um",
         "insulator.thickness": "18 um", "ribbon.thickness": "3 um", "ribbon.young_modulus": "24 GPa", "ribbon.poisson_ratio": 0, "mesh.nodes": 1601}

BATH = {"liquid.model": "submerged", "solver.stop_when_zipped": "true"}
FILM = {**BATH, "liquid.inertia": "false", "medium.drag_coefficient": 0}
UNDAMPED = {**DRY, "damping.internal": 0, "solver.stop_when_zipped": "true"}
ALONE = {**BEAM, "ribbon.density": "7850 kg/m3"}

# case: study, keys, what the case asks of its summary
CASES = {
    "rest_guided_4": ("stationary", beam("guided", 4), lambda s: s["stroke_m"] / 45e-3),
    "rest_guided_16": ("stationary", beam("guided", 16), lambda s: s["stroke_m"] / 45e-3),
    "rest_free_1": ("stationary", beam("free", 1), lambda s: s["stroke_m"] / 45e-3),
    "rest_free_10": ("stationary", beam("free", 10), lambda s: s["stroke_m"] / 45e-3),
    "rest_weight_10": ("stationary", heavy(10), lambda s: s["stroke_m"] / float(heavy(10)["ribbon.length"].split()[0])),
    "rest_opening_8g": ("stationary", opening("8 g"), lambda s: s["opening_m"]),
    "rest_opening_30g": ("stationary", opening("30 g"), lambda s: s["opening_m"]),
    "rest_hanging": ("stationary", DRY, lambda s: s["opening_m"]),
    "modes_guided_1": ("modes", {**ALONE, "actuator.right_end": "guided"}, lambda s: s["frequencies_Hz"][0]),
    "modes_guided_2": ("modes", {**ALONE, "actuator.right_end": "guided"}, lambda s: s["frequencies_Hz"][1]),
    "modes_free_1": ("modes", {**ALONE, "actuator.right_end": "free"}, lambda s: s["frequencies_Hz"][0]),
    "modes_hanging": ("modes", DRY, lambda s: s["frequencies_Hz"][0]),
    "modes_hanging_5kV": ("modes", {**DRY, "modes.voltage": "5 kV"}, lambda s: s["frequencies_Hz"][0]),
    "pull_in_guided": ("limits", flange("guided"), lambda s: load_of_voltage(s["pull_in_voltage_V"])),
    "pull_in_free": ("limits", flange("free"), lambda s: load_of_voltage(s["pull_in_voltage_V"])),
    "pull_in_curved_1": ("limits", curved(1, 0.2), lambda s: load_of_voltage(s["pull_in_voltage_V"])),
    "pull_in_curved_1.5": ("limits", curved(1.5, 0.05), lambda s: load_of_voltage(s["pull_in_voltage_V"])),
    "pull_in_curling": ("limits", curling(0.5), lambda s: load_of_voltage(s["pull_in_voltage_V"])),
    "pull_in_plate": ("limits", PLATE, lambda s: 8.8541878128e-12 * 300e-6 * 40e-6 * s["pull_in_voltage_V"]**2 / (8 * 5e-6**3)),
    "release_plate": ("limits", PLATE, lambda s: 8.8541878128e-12 * 300e-6 * 40e-6 * s["release_voltage_V"]**2 / (8 * 5e-6**3)),
    "pull_in_8g": ("limits", DRY, lambda s: s["pull_in_voltage_V"]),
    "pull_in_8g_no_breakdown": ("limits", {**DRY, "electro.breakdown_cap": "false"}, lambda s: s["pull_in_voltage_V"]),
    "closing_61g": ("limits", {**DRY, "load.mass": "61 g"}, lambda s: s["closing_voltage_V"]),
    "largest_load": ("limits", DRY, lambda s: s["max_load_kg"]),
    "release_8g": ("limits", DRY, lambda s: s["release_voltage_V"]),
    "release_8g_no_platform": ("limits", {**DRY, "platform.electrode": "false"}, lambda s: s["release_voltage_V"]),
    "force_wedge_1mm": ("profile", wedge("1 mm", "false"), lambda s: s["field_force_N"]),
    "force_wedge_2mm": ("profile", wedge("2 mm", "false"), lambda s: s["field_force_N"]),
    "force_wedge_4mm": ("profile", wedge("4 mm", "false"), lambda s: s["field_force_N"]),
    "force_wedge_2mm_breakdown": ("profile", wedge("2 mm", "true"), lambda s: s["force_N"]),
    "force_held_2mm": ("isometric", {**DRY, "drive.voltage": "6 kV"}, lambda s: s["force_N"]),
    "pouch_force": ("isometric", POUCH, lambda s: s["force_N"]),
    "pouch_capacitance": ("isometric", POUCH, lambda s: s["capacitance_F"]),
    "zip_dry_opening_40ms": ("actuate", {**UNDAMPED, "solver.end_time": "40 ms"}, lambda s: s["opening_m"]),
    "zip_dry_time": ("actuate", UNDAMPED, lambda s: s["zip_time_s"]),
    "zip_dry_61g": ("actuate", {**UNDAMPED, "load.mass": "61 g"}, lambda s: s["zip_time_s"]),
    "film_zip_time": ("actuate", FILM, lambda s: s["zip_time_s"]),
    "film_zip_time_inertia": ("actuate", BATH, lambda s: s["zip_time_s"]),
    "energy_dry_zip": ("actuate", UNDAMPED, lambda s: s["energy_error"]),
    "energy_film_zip": ("actuate", BATH, lambda s: s["energy_error"]),
}
# fronts of the film alone, from the rows of bench/fronts.c: curvature ahead, column
FRONTS = {"film_front_speed_0.3": ("0.3", "speed"), "film_front_speed_0.5": ("0.5", "speed"), "film_front_speed_0.7": ("0.7", "speed"),
          "film_front_film_0.5": ("0.5", "film_10")}


def answer(zipact, case, folder, more=()):
    study, keys, asked = CASES[case]
    words = [zipact, study, "--json", "--quiet", "--no-plots", "-o", folder, "--set", "output.errors=false"]
    for key, value in [*keys.items(), *more]:
        words += ["--set", "%s=%s" % (key, value)]
    result = subprocess.run(words, stdout=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit("%s: exit status %d: %s" % (case, result.returncode, " ".join(words)))
    try:
        return asked(json.loads(result.stdout))
    except TypeError:
        return None


def main():
    with open(sys.argv[2], encoding="utf-8") as file:
        fronts = {row["K"]: row for row in csv.DictReader(file) if row["w_over_l"] == "inf"}
    print("case,value")
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            value = answer(sys.argv[1], case, folder)
            print("%s,%s" % (case, "none" if value is None else "%.7g" % value), flush=True)
    for case, (curvature, column) in FRONTS.items():
        print("%s,%s" % (case, fronts[curvature][column]))


if __name__ == "__main__":
    main()
