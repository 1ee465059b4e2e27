#!/usr/bin/env python3
"""Tables of docs/validity.md, between its markers, and docs/images/validity-*.svg, from runs of examples/validity and
of examples/experiments.yaml.

make-validity-page.py [--check] ZIPACT    with --check says whether the page is up to date, of what runs within seconds
"""
import csv
import json
import math
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import validity_comb  # noqa: E402
import validity_pouch  # noqa: E402

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(HOME, "docs", "validity.md")
SEQUENTIAL = {"contact.model": "sequential", "solver.integrator": "explicit"}
LIMIT = 1  # per cent: where a simple model stops being good enough
INK = ["#0b5fa5", "#c2410c", "#15803d", "#7c3aed", "#111827", "#db2777"]


class Runs:
    """Runs scenarios, each once, in a folder that goes when done."""

    def __init__(self, zipact, folder):
        self.zipact, self.folder, self.done = zipact, folder, {}

    def folder_of(self, name, settings=None):
        """Where the results of a scenario with these settings stand."""
        words = [f"{key}={value}" for key, value in (settings or {}).items()]
        key = " ".join([name, *words])
        if key not in self.done:
            out = os.path.join(self.folder, str(len(self.done)))
            scenario = os.path.join(HOME, "examples", "validity", name + ".yaml")
            sets = [part for word in words for part in ("--set", word)]
            subprocess.run([self.zipact, "run", scenario, "-o", out, "--quiet", *sets], check=True)
            self.done[key] = out
        return self.done[key]

    def rows(self, name, settings=None):
        """Rows of table.csv, texts that are numbers as numbers; an empty cell is None."""
        with open(os.path.join(self.folder_of(name, settings), "table.csv"), newline="") as file:
            return [{k: number(v) for k, v in row.items()} for row in csv.DictReader(file)]

    def summary(self, name, settings=None):
        with open(os.path.join(self.folder_of(name, settings), "summary.json")) as file:
            return json.load(file)

    def compare(self, name, simple, value, keys, better=None):
        """{values of keys: (simple, better)} of the column `value`, where both have one."""
        pairs = {}
        for a, b in zip(self.rows(name, simple), self.rows(name, better)):
            at = tuple(a[k] for k in keys)
            assert at == tuple(b[k] for k in keys)
            if a[value] is not None and b[value] is not None:
                pairs[at] = a[value], b[value]
        return pairs


def number(text):
    try:
        return float(text)
    except ValueError:
        return text or None


def off(simple, better):
    """Difference of the simple model from the better one, in per cent."""
    return 100 * (simple / better - 1)


def per_cent(value):
    """Two digits, as many as the comparisons are worth; a dash where there is nothing to compare."""
    if value is None:
        return "–"
    digits = max(0, 1 - math.floor(math.log10(abs(value)))) if value else 0
    return f"{value:+.{min(digits, 4)}f} %".replace("-", "−")


def crossing(points):
    """Where |y| of points (x, y) last crosses LIMIT, by a power law between two points; None where it never does."""
    found = None
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        if (abs(y0) < LIMIT) != (abs(y1) < LIMIT):
            share = math.log(LIMIT / abs(y0)) / math.log(abs(y1 / y0))
            found = x0 * (x1 / x0) ** share
    return found


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows])


# The comparisons: each gives curves {label: [(x, per cent)]}.


def field_force(runs):
    curves = {}
    for row in runs.rows("field-force"):
        label = f"insulator {1e6 * row['insulator.thickness_m']:g} µm"
        curves.setdefault(label, []).append((1e3 * row["isometric.separation_m"], 100 * (1 / row["scale_factor"] - 1)))
    return curves


def edges_force(runs):
    curves = {}
    pairs = runs.compare("edges-force", None, "force_N", ("isometric.separation_m", "ribbon.width_m"),
                         {"electro.edges": "true"})
    for (opening, width), pair in pairs.items():
        curves.setdefault(f"force, open {1e3 * opening:g} mm", []).append((1e3 * width, off(*pair)))
    curves["pull-in voltage"] = [(width, off(*edges_pull_in(runs, width))) for width in (2, 5, 12.7, 25, 50, 100)]
    return {label: sorted(points) for label, points in curves.items()}


def edges_pull_in(runs, width):
    """Pull-in voltage without and with lateral edges; the load, 8 g on 12.7 mm, grows with the width."""
    actuator = {"ribbon.width": f"{width} mm", "load.mass": f"{8 * width / 12.7:.9g} g"}
    return [runs.summary("edges-pull-in", {**actuator, "electro.edges": edges})["pull_in_voltage_V"] for edges in ("false", "true")]


def zip_times(runs):
    keys = "ribbon.thickness_m", "load.mass_kg"
    pull_in = {tuple(r[k] for k in keys): r["pull_in_voltage_V"] for r in runs.rows("contact-pull-in")}
    curves = {}
    for (b, m, U), pair in runs.compare("contact-zip", SEQUENTIAL, "zip_time_s", (*keys, "drive.voltage_V")).items():
        label = f"{1e6 * b:g} µm steel, {1e3 * m:g} g"
        curves.setdefault(label, []).append((U / pull_in[b, m], off(*pair)))
    return curves


def closed_lengths(runs):
    pairs = runs.compare("contact-release", SEQUENTIAL, "zipped_length_m", ("drive.offset_V",))
    names = "sequential", "unilateral"
    return {name: [(1e-3 * U, 1e3 * pair[k]) for (U,), pair in pairs.items()] for k, name in enumerate(names)}


def chain_strokes(runs):
    rod = runs.rows("chain-stroke")
    finest = max(row["mesh.nodes"] for row in rod)
    exact = {row["load.mass_kg"]: row["stroke_m"] for row in rod if row["mesh.nodes"] == finest}
    chain = runs.rows("chain-stroke", {"ribbon.model": "mass_spring"})
    curves = {}
    for row in chain + rod:
        m, nodes = row["load.mass_kg"], row["mesh.nodes"]
        if row in chain and nodes < finest or nodes == 21:
            label = f"N = {nodes:g}" if row in chain else f"rod, {nodes:g}"
            curves.setdefault(label, []).append((exact[m] / 45e-3, off(row["stroke_m"], exact[m])))
    return curves


def frequency(rows):
    """Crossings of the middle, upwards, per time."""
    points = [(row["time_s"], row["stroke_m"]) for row in rows]
    strokes = [y for _, y in points]
    middle = (max(strokes) + min(strokes)) / 2
    at = [t0 + (t1 - t0) * (middle - y0) / (y1 - y0) for (t0, y0), (t1, y1) in zip(points, points[1:]) if y0 < middle <= y1]
    return (len(at) - 1) / (at[-1] - at[0])


def chain_motion(runs):
    chain = {"ribbon.model": "mass_spring"}
    keys = "drive.voltage_V", "mesh.nodes"
    rod = {tuple(r[k] for k in keys): r["zip_time_s"] for r in runs.rows("chain-zip")}
    finest = max(nodes for _, nodes in rod)
    curves = {}
    for row in runs.rows("chain-zip", chain):
        U, nodes = (row[k] for k in keys)
        curves.setdefault(f"zip time, {1e-3 * U:g} kV", []).append((nodes, off(row["zip_time_s"], rod[U, finest])))
    fine = {"mesh.nodes": 161, "solver.integrator": "implicit", "contact.model": "unilateral",
            "damping.internal": "0 s", "solver.tolerance": 1e-6}
    exact = frequency(runs.rows("chain-swing", fine))
    curves["frequency"] = [(n, off(frequency(runs.rows("chain-swing", {**chain, "mesh.nodes": n})), exact))
                           for n in (11, 21, 41)]
    return curves


READING = 0.15  # of what is read off the published plots
STEEL, GAUGE = 200e9, 0.05  # Pa; two standard deviations of the thickness of strip
SOFTER, STIFFER = 200 * 0.85, 200 * 1.15  # GPa: steel 5 % thinner or thicker bends as much more or less


class Experiment:
    """A published row beside ours: openings in mm, of ours also their ranges over the reading and the steel."""

    def __init__(self, row, ours, by_load, by_steel):
        self.plot, self.load, self.measured = row["plot"], float(row["load.mass_g"]), float(row["opening_mm"])
        self.thickness, self.length, self.width = (float(row[f"ribbon.{key}"]) for key in ("thickness_um", "length_mm", "width_mm"))
        self.ours, self.by_load, self.by_steel = ours, by_load, by_steel

    def varied(self):
        """What its plot varies."""
        return f"{getattr(self, self.plot):g} {'µm' if self.plot == 'thickness' else 'mm'}"

    def meets(self):
        low, high = self.measured * (1 - READING), self.measured * (1 + READING)
        if low <= self.ours <= high:
            return "yes"
        return "with the load" if self.by_load[0] <= high and low <= self.by_load[1] else "**no**"


def strokes_of(runs, settings=None):
    """Computed openings of all published rows, mm."""
    return [1e3 * row["fitted_m"] for row in runs.rows("../experiments", settings)]


def experiments(runs):
    """All published rows, in the order of the data."""
    with open(os.path.join(HOME, "examples", "data", "experiments-2018.csv"), newline="") as file:
        rows = list(csv.DictReader(line for line in file if line[0] != "#"))
    loads = [strokes_of(runs, {"load.share": 0.5 * (1 + sign * READING)}) for sign in (-1, 1)]
    steels = [strokes_of(runs, {"ribbon.young_modulus": f"{E} GPa"}) for E in (STIFFER, SOFTER)]
    return [Experiment(*all_of) for all_of in zip(rows, strokes_of(runs), zip(*loads), zip(*steels), strict=True)]


class Spread:
    """What is not known of the published actuators: settings for its value as it is, and two standard deviations below
    and above."""

    def __init__(self, key, value, deviation, material=True):
        self.key, self.material = key, material
        self.settings = [{key: value * math.exp(2 * sign * deviation)} for sign in (-1, 1)]


def of_material(name, key):
    """(value, spread) of a material's key, as src/def/materials.def has them."""
    with open(os.path.join(HOME, "src", "def", "materials.def"), encoding="utf-8") as file:
        found = re.search(rf'^ZP_\w+\({name}, "{key}", ([^,]+), ([^,]+),', file.read(), re.M)
    return tuple(float(text) for text in found.groups())


def spreads():
    """Of steel, tape, gauge and load. Stiffness goes with the cube of the gauge."""
    tape = [("insulator." + key, *of_material("ZP_INSULATOR_PVC_TAPE", key)) for key in ("young_modulus", "density")]
    steel = "ribbon.young_modulus", STEEL, of_material("ZP_STRIP_STEEL_301", "young_modulus")[1]
    half = math.log(1 + READING) / 2
    return tape, [Spread(*steel), *(Spread(*one) for one in tape),
                  Spread("ribbon.young_modulus", STEEL, 3 * GAUGE / 2, material=False),
                  Spread("load.share", 0.5, half, material=False)]


class Band:
    """Openings of the published actuators with their tape, mm, and where they lie when all that spreads does."""

    def __init__(self, middle, changes):
        self.middle, self.range = middle, {}
        for name, counted in (("material", [c for c, material in changes if material]), ("all", [c for c, _ in changes])):
            down = math.hypot(*(min(0, *pair) for pair in counted))
            up = math.hypot(*(max(0, *pair) for pair in counted))
            self.range[name] = middle * math.exp(-down), middle * math.exp(up)

    def distance(self, e, name=None):
        """How far the measured opening lies from the computed one, in standard deviations of both: of the reading
        alone, or with a range. Openings are compared by their logarithms."""
        off = math.log(e.measured / self.middle)
        reaches = abs(math.log(self.range[name][off > 0] / self.middle)) if name else 0
        return off / (math.hypot(math.log(1 + READING), reaches) / 2)

    def explains(self, e):
        """What the measured opening may follow from, to two standard deviations."""
        for words, name in ("the reading", None), ("the materials", "material"), ("gauge and load", "all"):
            if abs(self.distance(e, name)) <= 2:
                return words
        return "**not explained**"


def bands(runs):
    """One band for each published row."""
    tape, all_of = spreads()
    known = {"ribbon.young_modulus": STEEL, **{key: value for key, value, _ in tape}}
    middle = strokes_of(runs, known)
    changes = [[strokes_of(runs, {**known, **one}) for one in spread.settings] for spread in all_of]
    return [Band(at, [(tuple(math.log(values[row] / at) for values in pair), spread.material)
                      for pair, spread in zip(changes, all_of)]) for row, at in enumerate(middle)]


# The page.


def spread_table(runs):
    rows = []
    for e, band in zip(experiments(runs), bands(runs), strict=True):
        ranges = [f"{low:.3g} to {high:.3g} mm" for low, high in (band.range["material"], band.range["all"])]
        rows.append([e.plot, f"{e.length:g} mm × {e.width:g} mm × {e.thickness:g} µm",
                     f"{e.measured * (1 - READING):.3g} to {e.measured * (1 + READING):.3g} mm", f"{e.ours:.3g} mm",
                     f"{band.middle:.3g} mm", *ranges, f"{band.distance(e, 'all'):+.1f}".replace("-", "−"), band.explains(e)])
    return table(["plot", "actuator", "measured", "without tape", "with tape", "steel and tape", "with gauge and load", "off by", "explained by"],
                 rows)


def experiments_table(runs):
    rows = []
    for e in experiments(runs):
        ranges = [f"{low:.3g} to {high:.3g} mm" for low, high in (e.by_load, e.by_steel)]
        rows.append([e.plot, f"{e.length:g} mm × {e.width:g} mm × {e.thickness:g} µm", f"{e.load:g} g", f"{e.measured:g} mm",
                     f"{e.ours:.3g} mm", per_cent(off(e.ours, e.measured)), *ranges, e.meets()])
    return table(["plot", "actuator", "load", "measured, ±15 %", "computed", "error", "load ±15 %", "steel 5 % thicker, thinner",
                  "within the reading"], rows)


def grid(curves, head, show):
    """One row per x, one column per curve."""
    xs = sorted({x for points in curves.values() for x, _ in points})
    columns = [dict(points) for points in curves.values()]
    return table([head, *curves], [[show(x), *(per_cent(column.get(x)) for column in columns)] for x in xs])


def limits(curves, what, show, never):
    """One row per curve: where it crosses LIMIT; `never` says what not crossing means."""
    rows = []
    for label, points in curves.items():
        at = crossing(points)
        rows.append([label, never if at is None else show(at)])
    return table([what, "1 % at"], rows)


def zip_table(curves):
    rows = []
    for label, points in curves.items():
        rows.append([label, *(f"{per_cent(y)} at {x:.2f}" for x, y in (points[0], points[len(points) // 2], points[-1]))])
    return table(["actuator", "lowest voltage", "middle", "highest"], rows)


def release_table(curves):
    rows = [[f"{U:g} kV", f"{a:g} mm", f"{b:g} mm"]
            for (U, a), (_, b) in zip(curves["sequential"], curves["unilateral"])]
    return table(["voltage falls to", "closed of 45 mm, sequential", "unilateral"], rows)


def pull_in_table(runs):
    rows = []
    for a, b, c in zip(runs.rows("field-pull-in"), runs.rows("field-pull-in", {"electro.model": "field"}),
                       runs.rows("field-pull-in", {"electro.edges": "true"})):
        for name, key in ("pull-in", "pull_in_voltage_V"), ("release", "release_voltage_V"):
            rows.append([f"{1e3 * a['load.mass_kg']:g} g", name, f"{a[key]:.0f} V", per_cent(off(a[key], b[key])),
                         per_cent(off(a[key], c[key]))])
    return table(["load", "voltage", "plates", "plates against field", "plates against plates with edges"], rows)


def mm(value):
    return f"{value:.3g} mm"


# What moves a zip time in oil and is not known: key, the values that are possible, why.
UNKNOWN = [
    ("bead.suction", ("0", "1"), "no measurement"),
    ("bead.volume", ("200 uL", "400 uL"), "how a drop is put on"),
    ("air.breakdown_field", ("2 MV/m", "4 MV/m"), "3 MV/m is that of wide gaps"),
    ("medium.breakdown_field", ("15 MV/m", "30 MV/m"), "of the paper's oil; does the force end there?"),
    ("film.roughness", ("0.5 um", "10 um"), "of tapes"),
    ("insulator.young_modulus", ("0 GPa", "0.2 GPa"), "soft tape adds stiffness"),
    ("ribbon.thickness", ("47.5 um", "52.5 um"), "gauge of strip"),
    ("medium.drag_coefficient", ("0.75", "3"), "assumed"),
]
LIQUIDS = {"bath": {}, "bead of 300 µL": {"liquid.model": "bead"}}


def moved(change):
    """A change of the zip time in per cent, in words where it is none or endless."""
    return "never" if math.isinf(change) else per_cent(change) if abs(change) > 0.01 else "0"


def zip_band(runs):
    """How each unknown moves the zip time, and all of them, as independent of each other."""
    rows, total = [], {name: [0, 0] for name in LIQUIDS}
    times = {name: runs.summary("zip-band", keys)["zip_time_s"] for name, keys in LIQUIDS.items()}
    for key, values, why in UNKNOWN:
        cells = []
        for name, keys in LIQUIDS.items():
            changes = []
            for value in values:
                time = runs.summary("zip-band", {**keys, key: value})["zip_time_s"]
                changes.append(math.inf if time is None else off(time, times[name]))
            for change in max(changes), min(changes):
                total[name][change > 0] = math.hypot(total[name][change > 0], change)
            cells.append(", ".join(moved(change) for change in changes))
        rows.append([f"`{key}`", ", ".join(values).replace("um", "µm").replace("uL", "µL"), why, *cells])
    band = [f"**{1e3 * times[name]:.0f} ms**, −{total[name][0]:.0f} %, "
            + ("or never" if math.isinf(total[name][1]) else f"+{total[name][1]:.0f} %") for name in LIQUIDS]
    rows.append(["all of these", "", "root of the sum of squares", *band])
    return table(["not known", "from, to", "why", *LIQUIDS], rows)


BEADS = [20, 50, 100, 150, 200, 300, 400]  # volumes at each front, µL


def ms(time):
    return "–" if time is None else f"{1e3 * time:.4g} ms"


def bead_volumes(runs):
    """What becomes of beads of several volumes: when they close, starve and reopen, and where their liquid is in the end."""
    rows = []
    for volume in BEADS:
        keys = {"bead.volume": f"{volume} uL"}
        s = runs.summary("bead-volume", keys)
        after = [row["contraction"] for row in runs.rows("bead-volume", keys) if s["zip_time_s"] and row["time_s"] > s["zip_time_s"]]
        rows.append([f"{volume} µL", ms(s["starved_time_s"]), ms(s["zip_time_s"]), f"{100 * min(after):.3g} %" if after else "–",
                     ms(s["closed_from_s"]), f"{100 * s['contraction']:.4g} %", f"{1e3 * s['wet_length_m']:.3g} mm",
                     f"{1e9 * s['bead_outside_m3']:.3g} µL"])
    return table(["at each front", "starves from", "first 99 %", "opens again to", "closed from", "after 1 s", "wet then", "at the edges then"], rows)


def bead_contractions(runs):
    curves = {}
    for volume in (50, 100, 200, 300):
        rows = runs.rows("bead-volume", {"bead.volume": f"{volume} uL"})
        curves[f"{volume} µL"] = [(1e3 * row["time_s"], 100 * row["contraction"]) for row in rows if row["time_s"] < 0.6]
    return curves


def published(name):
    """Rows of a file of examples/data, as numbers."""
    with open(os.path.join(HOME, "examples", "data", name + ".csv"), newline="") as file:
        return [{k: float(v) for k, v in row.items()} for row in csv.DictReader(line for line in file if line[0] != "#")]


FALLS_FITTED = (0.96, 2.9, 4.87, 6.75)  # kV; the other falls are predicted


def passes(rows, level, rising):
    """When the voltage first passes a level on its way up or, after the largest one, down, ms."""
    top = max(range(len(rows)), key=lambda k: rows[k]["voltage_V"])
    for before, after in zip(rows, rows[1:]) if rising else zip(rows[top:], rows[top + 1:]):
        a, b = before["voltage_V"], after["voltage_V"]
        if a < level <= b if rising else a >= level > b:
            return 1e3 * (before["time_s"] + (level - a) / (b - a) * (after["time_s"] - before["time_s"]))
    return None


class Step:
    """One step of the converter with an actuator, ms: measured and computed."""

    def __init__(self, row, rows):
        self.row, level = row, row["output_kV"]
        low, high = 100 * level, 900 * level
        self.to_10 = passes(rows, low, True)
        self.rise = passes(rows, high, True) - self.to_10
        self.fall = passes(rows, low, False) - passes(rows, high, False)
        self.fitted = level in FALLS_FITTED


def converter_steps(runs):
    return [Step(row, runs.rows("converter-steps", {"drive.voltage": f"{row['output_kV']} kV"})) for row in published("converter-steps")]


def converter_table(runs):
    rows = []
    for s in converter_steps(runs):
        m = s.row
        rows.append([f"{m['output_kV']:.2f} kV", f"{m['alone_rise_ms']:g}", f"{m['to_10_ms']:g}", f"{s.to_10:.1f}", f"{m['rise_ms']:g}", f"{s.rise:.0f}",
                     per_cent(off(s.rise, m["rise_ms"])), f"{m['fall_ms']:g}", f"{s.fall:.0f}", per_cent(off(s.fall, m["fall_ms"])),
                     "fitted" if s.fitted else "predicted"])
    return table(["output", "rise alone", "to 10 %, measured", "computed", "rise, measured", "predicted", "error", "fall, measured", "computed", "error",
                  "the fall is"], rows)


def converter_curves(runs):
    steps = converter_steps(runs)
    return [{"measured": [(s.row["output_kV"], s.row[key]) for s in steps], "computed": [(s.row["output_kV"], getattr(s, name)) for s in steps]}
            for name, key in (("rise", "rise_ms"), ("fall", "fall_ms"))]


OWN_RESISTIVITY = 8.8e12  # ohm m, by the 18 um film's rows at 7 and 8 kV


def retained(runs, film, resistivity=None):
    """Attraction in the last of 50 cycles over its mean in cycles 6 to 10: that of the voltage that the liquid has."""
    keys = {"insulator.thickness": f"{film:g} um", **({"medium.resistivity": resistivity} if resistivity else {})}
    cycles = [0] * 51
    for row in runs.rows("charge-retention", keys):
        cycle = int(row["time_s"] / 2)
        cycles[cycle] = max(cycles[cycle], (row["voltage_V"] + row["interface_voltage_V"]) ** 2)
    return cycles[49] / (sum(cycles[5:10]) / 5)


def retention(runs):
    """Published rows with what is left of the displacement and what one resistivity for both films, and one of its own,
    leave."""
    one = {film: retained(runs, film) for film in (15, 18)}
    own = retained(runs, 18, OWN_RESISTIVITY)
    return [(row, row["last_mm"] / row["first_mm"], one[row["film_um"]], own if row["film_um"] == 18 else None)
            for row in published("charge-retention")]


def retention_table(runs):
    rows = []
    for row, measured, one, own in retention(runs):
        rows.append([f"{row['film_um']:g} µm", f"{row['voltage_kV']:g} kV", f"{row['first_mm']:g} mm", f"{row['last_mm']:g} mm", f"{measured:.3f}",
                     f"{one:.3f}", per_cent(off(one, measured)), f"{own:.3f}" if own else "–", per_cent(off(own, measured)) if own else "–"])
    return table(["film", "voltage", "cycles 6 to 10", "cycle 50", "left", "computed, 3.4·10¹³ Ω m", "error", "8.8·10¹² Ω m", "error"], rows)


POUCH_RESISTIVITY = {15: 2.2e13, 18: 4.8e12}  # ohm m, by all rows of a film
TWO_TIMES = {"medium.resistivity": 1e15, "electro.leak_share": 0.5, "electro.leak_ratio": 1e3}  # by those of 18 um


def pouch_cycles(runs, film, voltage, keys):
    """Largest strokes of a pouch in cycles 6 to 10, their mean, and in the last of 50, m."""
    rows = runs.rows("charge-retention-pouch", {"insulator.thickness": f"{film:g} um", "drive.voltage": f"{voltage:g} kV", **keys})
    cycles = [0] * 51
    for row in rows:
        cycle = int(row["time_s"] / 2)
        cycles[cycle] = max(cycles[cycle], row["stroke_m"] - rows[0]["stroke_m"])
    return sum(cycles[5:10]) / 5, cycles[49]


def voltage_left(rows, row):
    """Share of the voltage at which the last stroke would have been a first one, by the straight lines through the first
    strokes of that film; None far below them."""
    points = [(r["first_mm"], r["voltage_kV"]) for r in rows if r["film_um"] == row["film_um"]]
    if row["last_mm"] < 0.5 * points[0][0]:
        return None
    (s, a), (t, b) = next((pair for pair in zip(points, points[1:]) if row["last_mm"] < pair[1][0]), points[-2:])
    return (a + (b - a) * (row["last_mm"] - s) / (t - s)) / row["voltage_kV"]


def pouch_retention_table(runs):
    rows = published("charge-retention")
    one = [pouch_cycles(runs, r["film_um"], r["voltage_kV"], {"medium.resistivity": POUCH_RESISTIVITY[r["film_um"]]}) for r in rows]
    two = [pouch_cycles(runs, r["film_um"], r["voltage_kV"], TWO_TIMES) if r["film_um"] == 18 else None for r in rows]
    scale = sum(first * r["first_mm"] for (first, _), r in zip(one, rows)) / sum(first**2 for first, _ in one)  # mm/m
    lines = []
    for r, (first, last), both in zip(rows, one, two):
        left = voltage_left(rows, r)
        lines.append([f"{r['film_um']:g} µm", f"{r['voltage_kV']:g} kV", f"{r['first_mm']:.2f} mm", f"{scale * first:.2f} mm", f"{r['last_mm'] / r['first_mm']:.2f}",
                      f"{last / first:.2f}", f"{both[1] / both[0]:.2f}" if both else "–", f"{left:.2f}" if left else "–"])
    return table(["film", "voltage", "cycles 6 to 10", "pouch", "left", "pouch", "with two time constants", "voltage left"], lines)


def pouch_strain(curve, voltage):
    """Strain of a followed branch at a voltage, over that without."""
    for (a, s), (b, t) in zip(curve, curve[1:]):
        if a <= voltage <= b:
            return s + (t - s) * (voltage - a) / (b - a) - curve[0][1]
    return None


def pouch_strokes(runs):
    """Rows of the measurement, each with the displacement above the lowest one of its load and the computed one, mm; and
    the two numbers fitted to 133 g: adhesion over that of the scenario, and length of all films, mm."""
    loads = {}
    for row in published("pouch-strokes"):
        loads.setdefault(row["load_g"], []).append(row)
    curves = {load: [(row["voltage_V"], row["strain"]) for row in runs.rows("pouch-strokes", {"load.mass": f"{load:g} g"}) if row["branch"] == 0]
              for load in loads}
    rises = {load: [row["displacement_mm"] - min(r["displacement_mm"] for r in rows) for row in rows] for load, rows in loads.items()}

    def strains(load, scale):
        return [pouch_strain(curves[load], 1e3 * scale * row["voltage_kV"]) for row in loads[load]]

    def fit(scale):  # of all voltages: adhesion goes with their square
        model, seen = strains(133, scale), rises[133]
        length = sum(m * y for m, y in zip(model, seen)) / sum(m * m for m in model)
        return sum((length * m - y) ** 2 for m, y in zip(model, seen)), length

    scale = min((k / 1000 for k in range(200, 1500)), key=lambda k: fit(k)[0])
    length = fit(scale)[1]
    return [(row, rise, length * strain) for load, rows in loads.items() for row, rise, strain in zip(rows, rises[load], strains(load, scale))], scale**2, length


def pouch_strokes_table(runs):
    rows, adhesion, length = pouch_strokes(runs)
    lines = [[f"{row['load_g']:g} g", f"{row['voltage_kV']:g} kV", f"{seen:.3f} mm", f"{found:.3f} mm", f"{found - seen:+.3f} mm".replace("-", "−"),
              "fitted" if row["load_g"] == 133 else "predicted"] for row, seen, found in rows]
    return (table(["load", "voltage", "measured", "computed", "difference", ""], lines) +
            f"\n\nFitted: {adhesion:.3f} of the adhesion of the scenario, and films of {length:.0f} mm in all.")


def retention_curves(runs):
    found = retention(runs)
    curves = {f"{film} µm, measured": [(row["voltage_kV"], left) for row, left, _, _ in found if row["film_um"] == film] for film in (15, 18)}
    curves["3.4·10¹³ Ω m"] = [(row["voltage_kV"], one) for row, _, one, _ in found if row["film_um"] == 15]
    curves["8.8·10¹² Ω m"] = [(row["voltage_kV"], own) for row, _, _, own in found if own]
    return curves
def small_beams(runs):
    """Published finite elements of beams over a wide electrode, beside ours without and with the edges."""
    def pull_in(end, length, width, thick, gap, edges, tension="0 N"):
        keys = {"actuator.right_end": end, "ribbon.length": length, "ribbon.width": width, "ribbon.thickness": thick, "electro.gap_offset": gap}
        return runs.summary("small-beam", {**keys, "ribbon.tension": tension, "electro.edges": edges})["pull_in_voltage_V"]

    thick, long = ("20 um", "2 um", "4 um"), ("300 um", "50 um", "3 um", "2.5 um")
    beams = [("100 × 20 × 2 µm, gap 4 µm, clamped at both ends, without stretching", "{:.0f} V", 992, lambda e: pull_in("guided", "50 um", *thick, e)),
             ("the same with stretching", "{:.0f} V", 1270, lambda e: pull_in("clamped", "100 um", *thick, e)),
             ("the same with stretching and 100 MPa of tension", "{:.0f} V", 1408, lambda e: pull_in("clamped", "100 um", *thick, e, "4 mN")),
             ("300 × 50 × 3 µm, gap 2.5 µm: clamped at both ends over clamped at one", "{:.3g}", 6.75,
              lambda e: pull_in("clamped", *long, e) / pull_in("free", *long, e))]
    rows = []
    for name, form, published, found in beams:
        plates, edges = found("false"), found("true")
        rows.append((name, form.format(published), form.format(plates), per_cent(100 * (plates / published - 1)),
                     form.format(edges), per_cent(100 * (edges / published - 1))))
    return table(("beam", "published", "plates", "off", "with edges", "off"), rows)


def quick_sections(runs):
    force, strokes = field_force(runs), chain_strokes(runs)
    yield "field-limits", limits(force, "plates against field, ribbons of 100 mm", mm, "not up to 78 mm")
    yield "field-force", grid(force, "opening", mm)
    yield "chain-limits", limits(strokes, "chain against rod", "stroke {:.2f} of the half length".format, "not up to 0.64")
    yield "chain-stroke", grid(strokes, "stroke / half length", "{:.3f}".format)
    yield "small-beams", small_beams(runs)
    yield "experiments", experiments_table(runs)
    yield "experiments-spread", spread_table(runs)
    yield "converter-steps", converter_table(runs)


def slow_sections(runs):
    edges = edges_force(runs)
    yield "edges-limits", limits(edges, "plates without edges", mm, "–")
    yield "edges-force", grid(edges, "width", mm)
    yield "field-pull-in", pull_in_table(runs)
    yield "contact-zip", zip_table(zip_times(runs))
    yield "contact-release", release_table(closed_lengths(runs))
    yield "chain-motion", grid(chain_motion(runs), "N", "{:g}".format)
    yield "zip-band", zip_band(runs)
    yield "bead-volume", bead_volumes(runs)
    yield "charge-retention", retention_table(runs)
    yield "charge-retention-pouch", pouch_retention_table(runs)
    yield "pouch-strokes", pouch_strokes_table(runs)
    yield from validity_comb.Comparison(runs).sections(table)


def markers(name):
    return f"<!-- made: {name} -->\n", f"\n<!-- end: {name} -->"


def part(page, name):
    """Where a table stands in the page, without its markers."""
    begin, end = markers(name)
    start = page.index(begin) + len(begin)
    return start, page.index(end, start)


# The pictures.


def panel(title, x_label, y_label, curves, extra="", points=True):
    """gnuplot text of one panel of a picture."""
    blocks, plots = [], []
    for k, (label, found) in enumerate(curves.items()):
        blocks.append(f"$c{k} << EOD\n" + "\n".join(f"{x:.9g} {abs(y):.9g}" for x, y in found) + "\nEOD\n")
        style = f"linespoints lw 2 pt {5 + 2 * (k % 6)} ps 0.6" if points else "lines lw 2"
        plots.append(f"$c{k} using 1:2 with {style} lc rgb '{INK[k % len(INK)]}' title '{label}'")
    return ("".join(blocks) + f"set title '{title}'\nset xlabel '{x_label}' offset 0, 0.5\nset ylabel '{y_label}'\n{extra}\nplot "
            + ", ".join(plots) + "\n")


LOG = """set logscale y
set format y '%g %%'
set yrange [{low}:{high}]
set object 1 rectangle from graph 0, first {low} to graph 1, first 1 fc rgb '#e6f4ea' fs solid noborder behind
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 2.5 lc rgb '#b91c1c'
set label 1 '1 %' at graph 0.02, first 1 offset 0, 0.6 left tc rgb '#b91c1c'
"""
CLEAR = "unset logscale\nunset object 1\nunset arrow 1\nunset label 1\nset format y '%g'\nset xtics auto\n"


def draw(name, panels):
    script = (f"set terminal svg size 480,{390 * len(panels)} font 'sans,14' background '#ffffff'\n"
              f"set output '{os.path.join(HOME, 'docs', 'images', name)}.svg'\n"
              "set grid lc rgb '#d0d0d0'\nset border lc rgb '#404040'\nset key below samplen 2 maxrows 3 font ',13'\n"
              "set tmargin 2.2\nset lmargin 11\n"
              f"set multiplot layout {len(panels)},1\n" + CLEAR.join(panels) + "unset multiplot\n")
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


def draw_experiments(found, bands):
    """Computed over measured with its band, point by point, with a colour for each of the published plots."""
    plots = list(dict.fromkeys(e.plot for e in found))
    points = ["\n".join(f"{x} {b.middle / e.measured} {b.range['all'][0] / e.measured} {b.range['all'][1] / e.measured}"
                        for x, (e, b) in enumerate(zip(found, bands)) if e.plot == plot) for plot in plots]
    blocks = "".join(f"$c{k} << EOD\n{text}\nEOD\n" for k, text in enumerate(points))
    curves = ", ".join(f"$c{k} using 1:2:3:4 with yerrorbars lw 2 pt {5 + 2 * k} ps 0.7 lc rgb '{INK[k]}' title 'by {plot}'"
                       for k, plot in enumerate(plots))
    ticks = ", ".join(f"'{e.varied()}' {x}" for x, e in enumerate(found))
    draw("validity-experiments", [blocks + f"""set title 'Opening under the largest load, two standard deviations'
set ylabel 'computed / measured'
set xrange [-0.8:{len(found) - 0.2}]
set yrange [0.5:1.7]
set xtics ({ticks}) rotate by 60 right
set key maxrows 1
set bmargin 6.5
set object 1 rectangle from graph 0, first {1 - READING} to graph 1, first {1 + READING} fc rgb '#e6f4ea' fs solid noborder behind
set arrow 1 from graph 0, first 1 to graph 1, first 1 nohead lw 1.5 lc rgb '#15803d'
set label 1 'measured, ±15 %' at graph 0.98, first {1 - READING} offset 0, -0.7 right tc rgb '#15803d'
set bars 1.5
plot {curves}
"""])


def pictures(runs):
    widths = "set logscale x\nset xrange [2:100]\nset xtics (2, 5, 10, 20, 50, 100)\n"
    nodes = "set logscale x\nset xrange [8:100]\nset xtics (11, 21, 41, 61, 81)\n"
    draw("validity-plates", [
        panel("Force: plates law against field", "opening of ribbons of 100 mm / mm", "difference", field_force(runs),
              LOG.format(low=0.001, high=10) + "set logscale x\nset xrange [1:80]\nset xtics (1, 2, 5, 10, 20, 40, 80)\n"),
        panel("Without lateral edges against with", "width of the ribbons / mm", "difference", edges_force(runs),
              LOG.format(low=0.1, high=20) + widths)])
    draw("validity-contact", [
        panel("Zip time: sequential against unilateral", "voltage / static pull-in voltage", "difference",
              zip_times(runs), LOG.format(low=0.5, high=100) + "set logscale x\nset xrange [0.9:25]\nset xtics (1, 2, 5, 10, 20)\n"),
        panel("Closed length after the voltage fell from 10 kV", "voltage it fell to / kV", "closed length of one half / mm",
              closed_lengths(runs), "set xrange [0:2]\nset yrange [-2:50]\n")])
    draw_experiments(experiments(runs), bands(runs))
    rises, falls = converter_curves(runs)
    draw("validity-converter", [
        panel("Steps on an actuator: rise, 10 to 90 %", "output / kV", "rise / ms", rises, "set yrange [0:150]\n"),
        panel("Steps on an actuator: fall, 90 to 10 %", "output / kV", "fall / ms", falls, "set yrange [0:600]\n")])
    draw("validity-retention", [
        panel("Displacement in cycle 50 over that in cycles 6 to 10", "voltage / kV", "left", retention_curves(runs),
              "set yrange [0:1.3]\nset xrange [4.5:8.5]\nset key maxrows 2\n")])
    draw("validity-bead", [
        panel("Beads of several volumes at each front, 8 g, 10 kV", "time / ms", "contraction / %", bead_contractions(runs),
              "set yrange [60:101]\nset arrow 2 from graph 0, first 99 to graph 1, first 99 nohead dt 2 lc rgb '#404040'\n", points=False)])
    draw("validity-pouch", [validity_pouch.panel(runs, INK)])
    draw("validity-comb", list(validity_comb.Comparison(runs).panels(panel)))
    draw("validity-chain", [
        panel("Stroke: chain against rod", "stroke / half length", "difference", chain_strokes(runs),
              LOG.format(low=0.003, high=20) + "set xrange [0:0.7]\n"),
        panel("Motion: chain against rod, 8 g", "N, nodes per ribbon", "difference", chain_motion(runs),
              LOG.format(low=0.03, high=20) + nodes)])


def main():
    check = sys.argv[1:2] == ["--check"]
    with tempfile.TemporaryDirectory() as folder, open(PAGE, encoding="utf-8") as file:
        page, runs = file.read(), Runs(sys.argv[-1], folder)
        if check:
            old = [name for name, text in quick_sections(runs) if page[slice(*part(page, name))] != text]
            sys.exit(f"docs/validity.md is out of date ({', '.join(old)}): make validity" if old else print("1 passed, 0 failed"))
        for sections in quick_sections, slow_sections:
            for name, text in sections(runs):
                start, end = part(page, name)
                page = page[:start] + text + page[end:]
        pictures(runs)
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
