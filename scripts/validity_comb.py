"""A measured gap-closing comb in air and in water against kind plate, for docs/validity.md: make-validity-page.py has the
runs. One unknown is fitted, the undercut of every edge, to the five pull-in voltages."""
import csv
import os

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
UM = 1e-6


def data(name):
    with open(os.path.join(HOME, "examples", "data", name + ".csv"), encoding="utf-8") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [{key: float(value) if value else None for key, value in row.items()} for row in rows]


def comb(undercut, overlap):
    """Keys of the comb with this undercut and this overlap of its fingers, m: gaps and travel grow by two undercuts, beams
    and fingers shrink by as much. Two beams, clamped and guided, hold a spine of 20 um x 860 um and the fingers, which are
    10 um longer than the overlap; its etch holes are not known and not counted."""
    depth, finger, beam, length = 40 * UM, 5 * UM - 2 * undercut, 3 * UM - 2 * undercut, 241 * UM
    spine = (20 * UM - 2 * undercut) * 860 * UM
    return {
        "plate.gap": 4.83 * UM + 2 * undercut,
        "plate.back_gap": 7.75 * UM + 2 * undercut,
        "plate.stiffness": 2 * 169e9 * depth * beam**3 / length**3,
        "plate.mass": 2300 * depth * (spine + 70 * finger * (overlap + 10 * UM)),
        "ribbon.length": overlap,
        "ribbon.thickness": finger,
    }


def limits(runs, undercut, overlap, medium=None):
    found = runs.summary("comb-limits", {**comb(undercut, overlap), **(medium or {})})
    return found["pull_in_voltage_V"], found["release_voltage_V"]


def misfit(runs, undercut):
    """Sum of squared differences of the pull-in voltages, which are all known to 1 V."""
    return sum((limits(runs, undercut, UM * row["overlap_um"])[0] - row["pull_in_V"])**2 for row in data("comb-limits"))


def fitted(runs):
    """The undercut, m, by golden sections."""
    part, low, high = 0.6180339887498949, 0.3 * UM, 0.8 * UM
    while high - low > 1e-3 * UM:
        one, other = high - part * (high - low), low + part * (high - low)
        if misfit(runs, one) < misfit(runs, other):
            high = other
        else:
            low = one
    return 0.5 * (low + high)


def opens(rows):
    """Time from where the voltage falls until the gap is first back at its value at rest, s; None: not within the run."""
    rest = rows[0]["opening_m"]
    fall = next(i for i, row in enumerate(rows) if row["time_s"] > rows[-1]["time_s"] / 4 and row["voltage_V"] == 0)
    for row in rows[fall:]:
        if row["opening_m"] >= rest:
            return row["time_s"] - rows[fall]["time_s"]
    return None


def ratio(computed, measured):
    return "–" if computed is None or measured is None else f"{computed / measured:.2f}"


def shown(value, digits=3):
    return "–" if value is None else f"{value:.{digits}g}"


class Comparison:
    def __init__(self, runs):
        self.undercut = fitted(runs)
        u = self.undercut
        self.limits = [(row, *limits(runs, u, UM * row["overlap_um"])) for row in data("comb-limits")]
        self.air, self.water = [], []
        for row in data("comb-air"):
            settings = {**comb(u, 76.5 * UM), "drive.voltage": row["voltage_V"]}
            self.air.append((row, 1e6 * runs.summary("comb-air", settings)["zip_time_s"], 1e6 * opens(runs.rows("comb-air", settings))))
        water = {"medium.material": "water", "medium.permittivity": 80, "drive.voltage": 10}
        for row in data("comb-water"):
            settings = {**comb(u, UM * row["overlap_um"]), "drive.voltage": row["voltage_V"]}
            time = runs.summary("comb-water", settings)["zip_time_s"]
            self.water.append((row, row["voltage_V"] / limits(runs, u, UM * row["overlap_um"], water)[0], time and 1e3 * time))

    def sections(self, table):
        fit = comb(self.undercut, 76.5 * UM)
        yield "comb-fit", (f"The undercut that fits best is {self.undercut / UM:.3f} µm: the spring then has "
                           f"{fit['plate.stiffness']:.2f} N/m, and {1e9 * fit['plate.mass']:.2f} µg move with fingers of 76.5 µm.")
        yield "comb-limits", table(
            ["overlap", "pull-in, measured", "computed", "computed / measured", "release, measured", "computed", "computed / measured"],
            [[f"{m['overlap_um']:g} µm", f"{m['pull_in_V']:g} V", f"{up:.1f} V", ratio(up, m["pull_in_V"]), f"{m['release_V']:g} V",
              f"{down:.1f} V", ratio(down, m["release_V"])] for m, up, down in self.limits])
        yield "comb-air", table(
            ["voltage", "closes, measured", "computed", "computed / measured", "opens, measured", "computed", "computed / measured"],
            [[f"{m['voltage_V']:g} V", f"{m['closes_us']:g} µs", f"{t:.1f} µs", ratio(t, m["closes_us"]), shown(m["opens_us"]) + " µs" * bool(m["opens_us"]),
              f"{back:.1f} µs", ratio(back, m["opens_us"])] for m, t, back in self.air])
        yield "comb-water", table(
            ["overlap", "voltage", "over the computed pull-in", "closes, measured", "computed", "computed / measured"],
            [[f"{m['overlap_um']:g} µm", f"{m['voltage_V']:.2f} V", f"{above:.2f}", f"{m['closes_ms']:g} ms", f"{shown(t)} ms", ratio(t, m["closes_ms"])]
             for m, above, t in self.water])

    def panels(self, panel):
        axes = "set logscale x\nset xrange [{0}]\nset yrange [0:1.6]\nset arrow 3 from graph 0, first 1 to graph 1, first 1 nohead lw 1.5 lc rgb '#15803d'\n"
        yield panel("A comb in air and in water: pull-in", "overlap of the fingers / µm", "computed / measured",
                    {"pull-in": [(m["overlap_um"], up / m["pull_in_V"]) for m, up, _ in self.limits],
                     "release": [(m["overlap_um"], down / m["release_V"]) for m, _, down in self.limits]},
                    axes.format("12:100") + "set xtics (15, 30, 45, 60, 75)\n")
        water = {}
        for m, above, t in self.water:
            water.setdefault(f"in water, overlap {m['overlap_um']:g} µm", []).append((above, t / m["closes_ms"]))
        pull_in = self.limits[-1][1]
        yield panel("Closing time", "voltage / computed pull-in voltage", "computed / measured",
                    {"in air": [(m["voltage_V"] / pull_in, t / m["closes_us"]) for m, t, _ in self.air], **water},
                    axes.format("1:6") + "set xtics (1, 1.5, 2, 3, 4, 5)\n")
