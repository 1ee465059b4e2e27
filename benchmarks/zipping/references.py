#!/usr/bin/env python3
"""The references of the benchmark.

    references.py > references.csv              closed forms and boundary-value problems, solved here; the others from converged.csv
    references.py --converge ZIPACT > converged.csv     these again: meshes that double, steps at a tolerance of 1e-6 (five minutes)

What is solved here shares no code with zipact: quadratures and shooting with Runge's and Kutta's method.
"""

import csv
import math
import os
import sys
import tempfile

import zipact

HERE = os.path.dirname(os.path.abspath(__file__))


# -- beams that bend far ------------------------------------------------------------------------------------------------


def elliptic(modulus, amplitude):
    """(F, E): Legendre's integrals of the first and second kind, by Gauss' rule of 8 points on 64 pieces."""
    nodes = (0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363)
    weights = (0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763)
    first = second = 0
    half = amplitude / 128
    for piece in range(64):
        for node, weight in zip(nodes, weights):
            for sign in (-1, 1):
                root = math.sqrt(1 - (modulus * math.sin(half * (2 * piece + 1 + sign * node))) ** 2)
                first += weight * half / root
                second += weight * half * root
    return first, second


def bisect(function, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if (function(middle) > 0) == (function(low) > 0) else (low, middle)
    return 0.5 * (low + high)


def cantilever(load):
    """Deflection over length under a dead end load in units of EI / L^2."""
    def parts(k):
        start = math.asin(1 / (k * math.sqrt(2)))
        whole, half = elliptic(k, math.pi / 2), elliptic(k, start)
        return whole[0] - half[0], whole[1] - half[1]

    k = bisect(lambda k: parts(k)[0] - math.sqrt(load), math.sqrt(0.5) + 1e-12, 1 - 1e-12)
    return 1 - 2 * parts(k)[1] / math.sqrt(load)


def guided(load):
    """The same with both ends horizontal: two cantilevers of half the length."""
    return cantilever(load / 4)


def runge_kutta(slope, state, steps, start=0, end=1, power=1):
    """State at `end` from that at `start`; steps are shorter near `start` where `power` is above 1."""
    for i in range(steps):
        t = start + (end - start) * (i / steps) ** power
        h = start + (end - start) * ((i + 1) / steps) ** power - t
        a = slope(t, state)
        b = slope(t + h / 2, [s + h / 2 * k for s, k in zip(state, a)])
        c = slope(t + h / 2, [s + h / 2 * k for s, k in zip(state, b)])
        d = slope(t + h, [s + h * k for s, k in zip(state, c)])
        state = [s + h / 6 * (ka + 2 * kb + 2 * kc + kd) for s, ka, kb, kc, kd in zip(state, a, b, c, d)]
    return state


def heavy_cantilever(weight):
    """Deflection of the tip over length under the own weight in units of EI / L^3: theta'' = -weight (1 - s) cos theta."""
    def end(curvature):
        return runge_kutta(lambda s, y: [y[1], -weight * (1 - s) * math.cos(y[0]), math.sin(y[0])], [0, curvature, 0], 2000)

    return end(bisect(lambda curvature: end(curvature)[1], 0, weight))[2]


# -- small deflections ----------------------------------------------------------------------------------------------------


def solve_linear(A, b):
    """By Gauss' elimination with pivots."""
    n = len(b)
    rows = [row[:] + [right] for row, right in zip(A, b)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def newton(function, x):
    """A zero of n functions of n unknowns; derivatives by differences."""
    for _ in range(30):
        value = function(x)
        columns = []
        for i in range(len(x)):
            h = 1e-6 * max(1, abs(x[i]))
            columns.append([(a - b) / h for a, b in zip(function([v + h * (k == i) for k, v in enumerate(x)]), value)])
        step = solve_linear([list(row) for row in zip(*columns)], [-v for v in value])
        x = [v + s for v, s in zip(x, step)]
        if max(abs(s) for s in step) < 1e-10:
            break
    return x


def electrode(free, power=0, eta=0, curls=0, travels=(0.35, 0.5)):
    """Largest b of w'''' = b / (eta + x^power - w)^2 with a clamped left end and the right one free or guided: pull-in.
    The natural curvature is `curls` times the root of b, towards the electrode."""
    def load(travel, start):
        def misses(x):
            w, slope, bending, shear = runge_kutta(lambda s, y: [y[1], y[2], y[3], x[2] / (eta + s**power - y[0]) ** 2], [0, 0, x[0], x[1]], 400)
            return [w - travel, bending - curls * math.sqrt(abs(x[2])) if free else slope, shear]

        return newton(misses, start)

    (low, high), steps = travels, 12
    start = [1e-3, -2e-3, 2e-3]
    for k in range(1, steps + 1):  # from a small travel on, each solution the start of the next
        start = load(k * low / steps, start)
    golden = 0.5 * (math.sqrt(5) - 1)
    for _ in range(30):
        left, right = high - golden * (high - low), low + golden * (high - low)
        low, high = (left, high) if load(left, start)[2] < load(right, start)[2] else (low, right)
    return load(0.5 * (low + high), start)[2]


def frequency(guided_end, mode):
    """Of a clamped strip of 45 mm x 100 um of steel, the other end guided (tan x = -tanh x) or free (cos x cosh x = -1)."""
    if guided_end:
        root = bisect(lambda x: math.tan(x) + math.tanh(x), (mode - 0.5) * math.pi + 1e-9, mode * math.pi - 1e-9)
    else:
        root = bisect(lambda x: math.cos(x) + 1 / math.cosh(x), (mode - 1) * math.pi, mode * math.pi)
    return (root / 45e-3) ** 2 / (2 * math.pi) * math.sqrt(200e9 * 100e-6**2 / 12 / 7850)


# -- forces -----------------------------------------------------------------------------------------------------------------


def wedge(separation, strength):
    """Force on one ribbon of one half for gap = separation (3 xi^2 - 2 xi^3) over 45 mm at 6 kV, the field in the liquid at most
    `strength`. Of layers in series; a field solution of the cross-section with 126 000 unknowns differs by 1e-4 at most."""
    eps0, liquid, offset, voltage, n = 8.8541878128e-12, 2.75, 2 * 130e-6 * 2.75 / 4.62, 6e3, 20000
    total = 0
    for i in range(n + 1):
        x = i / n
        field = min(strength, voltage / (separation * x * x * (3 - 2 * x) + offset))
        total += (1 if i in (0, n) else 4 if i % 2 else 2) * field**2
    return 0.5 * eps0 * liquid * 12.7e-3 * total * 45e-3 / n / 3


def opening(mass):
    """Of two weightless ribbons, each of whose halves is a guided beam of 45 mm and 50 um that carries half the load."""
    return 2 * 45e-3 * guided(mass / 2 * 9.81 * 45e-3**2 / (200e9 * 12.7e-3 * 50e-6**3 / 12))


def pouch(strain):
    """(force, N, capacitance, F) of a pouch that is held at a strain: films of 20 x 50 mm and 18 um that stretch, but do not bend, with
    electrodes on half of them, at 8 kV. Where they lie on each other they are straight; from there on tension times curvature is the
    attraction per area by the plates law less the pressure of the liquid."""
    length, electrode, width, stretching, voltage, volume = 20e-3, 10e-3, 50e-3, 72e3, 8e3, (10e-3) ** 2 / math.pi
    permittivity, offset = 8.8541878128e-12 * 2.75, 18e-6 * 2.75 / 3.3  # of the liquid; of one film in liquid
    angle = bisect(lambda a: length**2 * (a - math.sin(a) * math.cos(a)) / (2 * a * a) - volume, 1e-6, math.pi / 2)
    chord = length * math.sin(angle) / angle - strain * length

    def film(zipped, tension, pressure):
        """Angle, x and height, volume, capacitance at the lower end."""
        along = 1 + tension / stretching

        def slope(s, y):
            capacitance = permittivity / (2 * (y[2] + offset)) if s < electrode else 0
            attraction = 0.5 * capacitance**2 * voltage**2 / permittivity
            return [along * (attraction - pressure) / tension, along * math.cos(y[0]), along * math.sin(y[0]), 2 * y[2] * along * math.cos(y[0]),
                    width * capacitance]

        parted = runge_kutta(slope, [0, zipped * along, 0, 0, width * permittivity / (2 * offset) * zipped], 2000, zipped, electrode * (1 - 1e-15), 4)
        return runge_kutta(slope, parted, 500, electrode, length)

    def misses(x):
        end = film(1e-3 * x[0], x[1], 1e3 * x[2])
        return [1e3 * end[2], 1e3 * (end[1] - chord), end[3] / volume - 1]

    x = newton(misses, [5.8, 95, 9])
    end = film(1e-3 * x[0], x[1], 1e3 * x[2])
    return 2 * width * x[1] * math.cos(end[0]), end[4]


EXACT, SHOT, SERIES = "closed form", "boundary-value problem", "quadrature"
# case: value, how, tolerance
SOLVED = {
    "rest_guided_4": (lambda: guided(4), EXACT, 5e-3),
    "rest_guided_16": (lambda: guided(16), EXACT, 5e-3),
    "rest_free_1": (lambda: cantilever(1), EXACT, 5e-3),
    "rest_free_10": (lambda: cantilever(10), EXACT, 5e-3),
    "rest_weight_10": (lambda: heavy_cantilever(10), SHOT, 5e-3),
    "rest_opening_8g": (lambda: opening(8e-3), EXACT, 5e-3),
    "rest_opening_30g": (lambda: opening(30e-3), EXACT, 5e-3),
    "modes_guided_1": (lambda: frequency(True, 1), EXACT, 5e-3),
    "modes_guided_2": (lambda: frequency(True, 2), EXACT, 5e-3),
    "modes_free_1": (lambda: frequency(False, 1), EXACT, 5e-3),
    "pull_in_guided": (lambda: electrode(False), SHOT, 5e-3),
    "pull_in_free": (lambda: electrode(True), SHOT, 5e-3),
    "pull_in_curved_1": (lambda: electrode(True, 1, 0.2, travels=(0.45, 0.6)), SHOT, 5e-3),
    "pull_in_curved_1.5": (lambda: electrode(True, 1.5, 0.05, travels=(0.33, 0.43)), SHOT, 5e-3),
    "pull_in_curling": (lambda: electrode(True, curls=0.5, travels=(0.35, 0.6)), SHOT, 5e-3),
    "pull_in_plate": (lambda: 8 / 27, EXACT, 1e-3),
    "release_plate": (lambda: 2 * 0.8 * 0.2**2, EXACT, 1e-3),
    "force_wedge_1mm": (lambda: wedge(1e-3, math.inf), SERIES, 5e-3),
    "force_wedge_2mm": (lambda: wedge(2e-3, math.inf), SERIES, 5e-3),
    "force_wedge_4mm": (lambda: wedge(4e-3, math.inf), SERIES, 5e-3),
    "force_wedge_2mm_breakdown": (lambda: wedge(2e-3, 20e6), SERIES, 5e-3),
    "pouch_force": (lambda: pouch(0.0215853)[0], SHOT, 1e-2),
    "pouch_capacitance": (lambda: pouch(0.0215853)[1], SHOT, 5e-3),
    "energy_dry_zip": (lambda: 0, EXACT, 1e-3),
    "energy_film_zip": (lambda: 0, EXACT, 1e-3),
}
# case: tolerance; the values are in converged.csv
CONVERGED = {
    "rest_hanging": 5e-3, "modes_hanging": 5e-3, "modes_hanging_5kV": 1e-2, "pull_in_8g": 5e-3, "pull_in_8g_no_breakdown": 5e-3, "closing_61g": 5e-3,
    "largest_load": 1e-2, "release_8g": 1e-2, "release_8g_no_platform": 1e-2, "force_held_2mm": 1e-2, "zip_dry_opening_40ms": 5e-3,
    "zip_dry_time": 2e-2, "zip_dry_61g": 2e-2, "film_zip_time": 2e-2, "film_zip_time_inertia": 2e-2,
}
# fronts in a film between two ribbons: travelling waves, solved as boundary-value problems by another code
WAVES = {"film_front_speed_0.3": 0.3030, "film_front_speed_0.5": 0.2476, "film_front_speed_0.7": 0.1411, "film_front_film_0.5": 0.3191}


def unit(case):
    for start, word in (("rest_opening", "m"), ("rest_hanging", "m"), ("rest", "1"), ("modes", "Hz"), ("pull_in_8g", "V"), ("pull_in", "1"), ("release_plate", "1"), ("closing", "V"),
                        ("largest", "kg"), ("release", "V"), ("force", "N"), ("pouch_force", "N"), ("pouch", "F"), ("zip_dry_opening", "m"), ("zip", "s"), ("film_zip", "s")):
        if case.startswith(start):
            return word
    return "1"


def converge(program):
    """Meshes of 120, 240, 480 elements; second order takes a third of the last difference off."""
    print("case,reference,uncertainty,on_120_elements,on_240,on_480")
    with tempfile.TemporaryDirectory() as folder:
        for case in CONVERGED:
            found = [zipact.answer(program, case, folder, [("mesh.nodes", n + 1), ("solver.tolerance", "7e-5")]) for n in (120, 240, 480)]
            if None in found:
                best, error = None, None
            else:
                best, error = found[2] + (found[2] - found[1]) / 3, abs(found[2] - found[1])
            row = [case, best, error, *found]
            print(",".join("none" if v is None else v if isinstance(v, str) else "%.7g" % v for v in row), flush=True)


def main():
    if sys.argv[1:2] == ["--converge"]:
        converge(sys.argv[2])
        return
    print("case,unit,reference,uncertainty,tolerance,kind")
    with open(os.path.join(HERE, "converged.csv"), encoding="utf-8") as file:
        found = {row["case"]: row for row in csv.DictReader(file)}
    for case in [*zipact.CASES, *zipact.FRONTS]:
        if case in SOLVED:
            value, kind, tolerance = SOLVED[case]
            row = "%.8g,0,%g,%s" % (value(), tolerance, kind)
        elif case in WAVES:
            row = "%g,%g,%g,%s" % (WAVES[case], 1e-4, 2e-2, SHOT)
        else:
            row = "%s,%s,%g,converged" % (found[case]["reference"], found[case]["uncertainty"], CONVERGED[case])
        print("%s,%s,%s" % (case, unit(case), row))


if __name__ == "__main__":
    main()
