"""What bending takes from the strain of a pouch, for a picture of docs/theory.md, section 40: make-validity-page.py has the
runs. Pouches are those of examples/validity/pouch-bending.yaml."""
import math

EPS0, EPS_FILM, EPS_LIQUID = 8.8541878128e-12, 3.3, 2.75
LENGTH, ELECTRODE, WIDTH, FILM, VOLTAGE = 20e-3, 10e-3, 50e-3, 18e-6, 8e3  # m, V
AREA = (LENGTH - ELECTRODE) ** 2 / math.pi
ADHESION = EPS0 * EPS_FILM * WIDTH * VOLTAGE**2 / (4 * FILM)  # N, (40.3)
MODULUS, THINNEST = 1e12, 1e-6  # Pa; m, the thinnest film that the key takes
ANGLES = 20, 30, 60  # degrees
PARTS = 0.002, 0.005, 0.01, 0.02, 0.05  # bending length over that of the pouch


def arc(angle):
    """Length of an arc, (40.1)."""
    return angle * math.sqrt(2 * AREA / (angle - math.sin(angle) * math.cos(angle)))


def length(angle):
    return LENGTH - arc(angle) * (1 - math.sin(angle) / angle)


def strain(angle):
    """Strain of the closed law; at the start the arcs are as long as the films."""
    low, high = 1e-3, math.pi / 2
    while high - low > 1e-14:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if arc(middle) > LENGTH else (low, middle)
    return (length(low) - length(angle)) / LENGTH


def force(angle):
    return ADHESION * math.cos(angle) / (1 - math.cos(angle))


def wedge(angle):
    """Capacitance of the liquid under the electrodes, (40.9), by Simpson's rule in the logarithm of the place."""
    thickness, steps = 2 * FILM * EPS_LIQUID / EPS_FILM, 2000
    first, last = 1e-3 * thickness, ELECTRODE - (LENGTH - arc(angle))
    step, total = math.log(last / first) / steps, first / thickness
    for k in range(steps + 1):
        s = first * math.exp(k * step)
        slope = 2 * angle * s / arc(angle) - angle
        height = arc(angle) / (2 * angle) * (math.cos(slope) - math.cos(angle))
        total += (1 if k in (0, steps) else 4 if k % 2 else 2) * step / 3 * s * math.cos(slope) / (2 * height + thickness)
    return EPS0 * EPS_LIQUID * WIDTH * total


def lost_to_liquid(angle, by=1e-3):
    """First part of (40.11)."""
    return VOLTAGE**2 / (2 * LENGTH) * (wedge(angle + by) - wedge(angle - by)) / (force(angle + by) - force(angle - by))


def lost_to_bending(angle, part):
    """Second part of (40.11)."""
    return 4 * part * (1 / math.cos(angle / 2) - 1)


def lost(runs, angle, part):
    """What zipact has less than the closed law, without the stretch of the film."""
    stiffness = force(angle) / (2 * math.cos(angle)) * (part * LENGTH) ** 2  # EI, N m2
    modulus = min(MODULUS, 12 * stiffness / (WIDTH * THINNEST**3))
    thickness = (12 * stiffness / (modulus * WIDTH)) ** (1 / 3)
    row = runs.rows("pouch-bending", {"ribbon.young_modulus": modulus, "ribbon.thickness": thickness, "load.force": force(angle)})[-1]
    assert row["voltage_V"] == VOLTAGE
    return strain(angle) - row["strain"] - force(angle) / (2 * modulus * thickness * WIDTH)


def panel(runs, ink):
    """gnuplot text of the picture: points by zipact, lines by (40.11) and by its second part alone."""
    low, high = 0.15, 6.5  # %
    blocks, labels, curves = [], [], []
    for k, degrees in enumerate(ANGLES):
        angle, look = math.radians(degrees), f"lc rgb '{ink[k]}'"
        points = "\n".join(f"{100 * part:g} {100 * lost(runs, angle, part):.4f}" for part in PARTS)
        blocks.append(f"$c{k} << EOD\n{points}\nEOD\n")
        liquid, bending = 100 * lost_to_liquid(angle), lost_to_bending(angle, 1)
        labels.append(f"set label {k + 1} 'α = {degrees}°' at graph 1.02, first {liquid + bending * high} left tc rgb '{ink[k]}'\n")
        curves += [f"{liquid:.6g} + {bending:.6g}*x with lines lw 2 {look} notitle", f"{bending:.6g}*x with lines lw 1.5 dt 2 {look} notitle",
                   f"$c{k} with points pt {5 + 2 * k} ps 0.8 {look} notitle"]
    grey = "lc rgb '#404040'"
    return "".join(blocks + labels) + f"""set title 'What bending takes from the strain of a pouch'
set xlabel 'bending length / length of the pouch'
set ylabel 'strain lost against the closed law' offset 1
set logscale xy
set xrange [{low}:{high}]
set yrange [0.01:5]
set format x '%g %%'
set format y '%g %%'
set xtics (0.2, 0.5, 1, 2, 5)
set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5)
set rmargin 8
set key inside bottom right
plot {", ".join(curves)}, NaN with points pt 7 ps 0.8 {grey} title 'zipact', NaN with lines lw 2 {grey} title 'bending and liquid', \\
     NaN with lines lw 1.5 dt 2 {grey} title 'bending alone'
"""
