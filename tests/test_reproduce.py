#!/usr/bin/env python3
"""The page of the paper:  python3 tests/test_reproduce.py [--interrupted] ZIPACT SCRATCH

Runs `zipact reproduce` once and checks the numbers of its data against the
paper's at stated tolerances, that the page is well-formed, shows the same numbers, needs nothing from outside and has no
dead link. With --interrupted (where the whole takes too long) it is stopped on the way, and what was done must be kept.
Standard library only. Last line: "N passed, N failed".
"""

import collections
import csv
import html.parser
import json
import os
import pty
import re
import select
import shutil
import signal
import statistics
import subprocess
import sys
import time

passed = failed = 0


def check(ok, what):
    global passed, failed
    passed, failed = passed + bool(ok), failed + (not ok)
    if not ok:
        print("FAILED: " + what)


class Page(html.parser.HTMLParser):
    """Tags must close in order; ids, links and text are kept."""

    VOID = {"meta", "br", "hr", "img", "link", "input"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.links, self.outside, self.text, self.faults = [], [], [], [], [], []
        self.pictures = 0
        self.feed(text)
        self.close()
        self.faults += ["<%s> is never closed" % tag for tag in self.open]

    def look(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.ids.append(value)
            if name in ("href", "src", "xlink:href", "srcset", "data"):
                (self.links if value.startswith("#") else self.outside).append(value)
        self.pictures += tag == "svg"

    def handle_starttag(self, tag, attributes):
        self.look(tag, attributes)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        self.look(tag, attributes)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append("</%s> closes nothing" % tag)

    def handle_data(self, data):
        self.text.append(data)


def check_page(folder, sections):
    text = open(folder + "/report.html", encoding="utf-8").read()
    page = Page(text)
    check(not page.faults, "the page is not well-formed: %s" % page.faults[:3])
    check(len(set(page.ids)) == len(page.ids), "ids are not unique")
    check(not page.outside, "the page needs something from outside: %s" % page.outside[:3])
    check(not re.search(r"url\((?!#)|@import|<script", text), "the page loads or runs something")
    dead = set(page.links) - {"#" + i for i in page.ids}
    check(not dead, "dead links: %s" % sorted(dead)[:3])
    check(sections <= set(page.ids), "sections are missing: %s" % (sections - set(page.ids)))
    check("None of them predicts" in text.replace("\n", " "), "zip times stand without the sentence on drag")
    return page


# Verdicts that follow from the tolerance; the others are given whatever the numbers are.
JUDGED = {"agrees", "reference_not_converged", "not_their_program", "guess"}


def check_comparisons_mislead_nobody(rows, summary):
    """One count of "differ" held strokes of another actuator, errors against other references, and the residual of a search
    by hand against an optimiser's zero: each comparison has a verdict, and only what can be judged has a tolerance."""
    counts = collections.Counter(r["verdict"] for r in rows)
    check({word: n for word, n in summary["verdicts"].items() if n} == counts, "verdicts: %s" % counts)
    for r in rows:
        what = "%(place)s, %(quantity)s, N = %(nodes)s, %(load_g)s g: %(verdict)s" % r
        check((r["verdict"] == "agrees") == (r["why"] == ""), what + ": a difference without a reason")
        check((r["verdict"] in JUDGED) == (r["tolerance"] != ""), what + ": only what is judged has a tolerance")
        if r["tolerance"]:
            within = abs(float(r["ours"]) - float(r["paper"])) <= float(r["tolerance"])
            check(within == (r["verdict"] == "agrees"), what + ": not what the tolerance says")
    shown = [(r["place"], r["quantity"], r["nodes"], r["load_g"]) for r in rows]
    check(len(set(shown)) == len(shown), "a number is compared twice")
    elements = [r for r in rows if r["quantity"] == "stroke of the finite elements"]
    check(len(elements) == 9 and all(r["nodes"] == "0" for r in elements), "finite elements, which have no N, for each N")
    verdict_of = {(r["place"], r["quantity"]): r["verdict"] for r in rows}
    for place, quantity, verdict in [("Table I", "stroke error", "not_comparable"), ("Table I", "area error", "other_reference"),
                                     ("Table II", "area error", "other_reference"),
                                     ("Table II", "stroke of the finite elements", "reference_not_converged"),
                                     ("Section III", "cost of a simulated second", "not_comparable"),
                                     ("Fig. 9", "zip time at 6 kV with N = 21", "guess"),
                                     ("Fig. 9", "zip time at 10 kV with N = 21", "not_comparable")]:
        check(verdict_of[place, quantity] == verdict, "%s, %s: %s" % (place, quantity, verdict_of[place, quantity]))


def check_guesses_read_so(folder):
    """Nobody tested that contact makes the difference of fig. 9; and a constant was inferred from the run at 10 kV."""
    text = open(folder + "/report.html", encoding="utf-8").read()
    reasons = dict(re.findall(r'<li id="why-\w" value="\d+"><b>(.*?)</b>(.*?)</li>', text, re.S))
    guesses = [title for title, sentence in reasons.items() if "This is a guess" in sentence]
    check(any("momentum" in title for title in guesses), "contact's momentum is not called a guess: %s" % guesses)
    inferred = [sentence for title, sentence in reasons.items() if "inferred from this very run" in title]
    check(len(inferred) == 1 and "electro.switch_offset" in inferred[0], "the inferred constant is not named")


def check_numbers(folder):
    rows = list(csv.DictReader(open(folder + "/comparison.csv", encoding="utf-8")))
    summary = json.load(open(folder + "/summary.json", encoding="utf-8"))
    check(len(rows) == len(summary["rows"]) == sum(summary["verdicts"].values()) == 140, "comparisons: %d" % len(rows))
    check(summary["verdicts"]["not_run"] == 0, "not all were run")
    check(all(abs(float(r["relative_difference"]) - (float(r["ours"]) / float(r["paper"]) - 1)) < 1e-12 for r in rows),
          "a difference is not ours / paper - 1")
    check_comparisons_mislead_nobody(rows, summary)

    def ours(place, quantity):
        return [(int(r["nodes"]), float(r["load_g"]), float(r["paper"]), float(r["ours"])) for r in rows
                if (r["place"], r["quantity"]) == (place, quantity)]

    # place, quantity, rows, relative tolerance, absolute tolerance
    misprints = {(21, 60), (21, 80), (130, 80)}
    for place, quantity, count, relative, absolute in [
            ("Table I", "shear coefficient fitted to the stroke", 9, 0.06, 0),  # printed: two digits, cut off
            ("Table I", "shear coefficient from theory", 9, 0.06, 0),
            ("Table II", "stroke", 18, 7e-4, 0),
            ("Table II", "stroke error", 18, 0, 0.02),  # a difference of strokes printed to 0.01 mm
            ("Factor", "factor by the paper's method", 1, 4e-3, 0),
            ("Section III", "axial spring K_D", 3, 1e-4, 0),
            ("Section III", "mean time step", 3, 0.02, 0),
            ("Fig. 9", "zip time at 6 kV with N = 21", 1, 0.06, 0),
            ("Fig. 9", "zip time at 10 kV with N = 21", 1, 0.085, 0)]:
        found = ours(place, quantity)
        check(len(found) == count, "%s, %s: %d rows" % (place, quantity, len(found)))
        for nodes, load, paper, value in found:
            if place == "Table II" and (nodes, load) in misprints:
                continue
            check(abs(value - paper) <= relative * abs(paper) + absolute,
                  "%s, %s, N = %d, %g g: paper %g, ours %g" % (place, quantity, nodes, load, paper, value))
    strokes = {(nodes, load): paper for nodes, load, paper, _ in ours("Table II", "stroke")}
    for nodes, load, paper, value in ours("Table II", "relative error"):
        if (nodes, load) not in misprints:
            allowed = 100 * 0.02 / strokes[nodes, load]
            check(abs(value - paper) <= allowed, "relative error, N = %d, %g g: paper %g, ours %g" % (nodes, load, paper, value))
    # converged strokes of the finite elements, of an independent solution, mm
    converged = {0: 0.071, 8: 2.592, 40: 11.81, 60: 16.39, 61: 16.60, 80: 20.04, 100: 22.91, 150: 27.75, 200: 30.65}
    for place in ("Table I", "Table II"):
        for _, load, _, value in ours(place, "stroke of the finite elements"):
            check(abs(value / converged[load] - 1) < 1.2e-3, "finite elements, %g g: %g mm" % (load, value))
    text = csv.DictReader(open(folder + "/runs/table-2-text/table.csv", encoding="utf-8"))
    for r in text:
        nodes, load = int(r["mesh.nodes"]), round(1e3 * float(r["load.mass_kg"]))
        check(1e3 * float(r["stroke_m"]) > 1.2 * strokes[nodes, load], "the text's actuator opens further, N = %d, %g g" % (nodes, load))
    check(abs(ours("Factor", "factor by the field")[0][3] - 1) < 1e-4, "the field over the right law is 1")
    check(all(value < paper / 20 for _, _, paper, value in ours("Section III", "cost of a simulated second")), "cost")
    return rows


def check_shown(rows, page):
    """The page shows the numbers of the data: strokes of Table II, with one digit more than is printed, each with its
    tolerance; and a tolerance beside every tick."""
    cells = {cell.strip() for cell in page.text}
    ticks = [at for at, cell in enumerate(page.text) if cell == "✓"]
    check(len(ticks) == sum(r["verdict"] == "agrees" for r in rows), "%d ticks" % len(ticks))
    check(all("±" in "".join(page.text[at - 4:at]) for at in ticks), "a tick without a tolerance")
    for r in rows:
        if (r["place"], r["quantity"]) == ("Table II", "stroke"):
            check("%.3f" % float(r["ours"]) in cells, "the page does not show %s" % r["ours"])


def check_runs(folder):
    for name in sorted(os.listdir(folder + "/runs")):
        run = folder + "/runs/" + name
        summary = json.load(open(run + "/summary.json", encoding="utf-8"))
        check(os.path.getsize(run + "/results.h5") > 1000, name + ": no results.h5")
        check(summary["outcome"] in ("converged", "zipped", "end_time", "followed"), name + ": " + summary["outcome"])


def check_close(value, expected, what, tolerance=1e-12):
    check(abs(value - expected) <= tolerance * abs(expected), "%s: %g, not %g" % (what, value, expected))


def check_derived(folder, rows):
    """Numbers of the comparison that follow from others, or from the table of a run."""
    def ours(place, quantity):
        return {(r["nodes"], r["load_g"]): r for r in rows if (r["place"], r["quantity"]) == (place, quantity)}

    for quantity in ("stroke", "shear coefficient from theory", "axial spring K_D", "mean time step", "factor by the paper's method"):
        for r in (r for r in rows if r["quantity"] == quantity and r["tolerance"]):
            digits, _, exponent = r["paper"].partition("e")
            last = 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))
            check_close(float(r["tolerance"]), max(0.005 * float(r["paper"]), last), "tolerance of %s, %s" % (quantity, r["paper"]), 1e-9)
    strokes, errors = ours("Table II", "stroke"), ours("Table II", "stroke error")
    for case, r in ours("Table II", "relative error").items():
        check_close(float(r["ours"]), 100 * float(errors[case]["ours"]) / float(strokes[case]["ours"]), "relative error %s %s" % case)
    factors = [float(r["paper_factor"]) for r in csv.DictReader(open(folder + "/runs/factor/table.csv", encoding="utf-8"))]
    deviation, = ours("Factor", "its standard deviation").values()
    check_close(float(deviation["ours"]), statistics.pstdev(factors), "standard deviation of %d factors" % len(factors), 1e-9)
    costs, steps = ours("Section III", "cost of a simulated second"), ours("Section III", "mean time step")
    for r in csv.DictReader(open(folder + "/runs/cost/table.csv", encoding="utf-8")):
        cost, = (row for case, row in costs.items() if case[0] == r["mesh.nodes"])
        step, = (row for case, row in steps.items() if case[0] == r["mesh.nodes"])
        more_steps = 1e6 * float(r["mean_time_step_s"]) / float(step["paper"])
        seconds = json_row(folder + "/runs/cost", r["mesh.nodes"])["real_time_factor"]
        check_close(float(cost["ours"]), more_steps / seconds / 60, "cost with N = " + r["mesh.nodes"], 1e-9)
    for r, row in zip(rows, json.load(open(folder + "/summary.json", encoding="utf-8"))["rows"]):
        check((r["place"], r["quantity"], int(r["nodes"]), float(r["load_g"])) == (row["place"], row["quantity"], row["nodes"], row["load_g"]), "summary.json has another row than comparison.csv: %s" % row)


def json_row(folder, nodes):
    return next(row for row in json.load(open(folder + "/summary.json", encoding="utf-8"))["rows"] if row["mesh.nodes"] == int(nodes))


def curves(path):
    """Indices of a .dat file => of each the rows."""
    text = open(path, encoding="utf-8").read().split("\n", 1)[1]
    return [[[float(x) for x in line.split()] for line in part.splitlines()] for part in text.split("\n\n\n") if part.strip()]


def check_figures(folder):
    """The data of the pictures are those of the runs."""
    def table(run):
        return list(csv.DictReader(open(folder + "/runs/%s/table.csv" % run, encoding="utf-8")))

    def column(run, name, rows=slice(None)):
        return [float(r[name]) for r in table(run)[rows]]

    shapes = curves(folder + "/plots/fig-6.dat")
    for k, load in enumerate((0.04, 0.06, 0.08, 0.1, 0.15, 0.2)):
        for run, shape in (("finite-elements", shapes[2 * k]), ("table-2-n61", shapes[2 * k + 1])):
            stroke, = (float(r["stroke_m"]) for r in table(run) if abs(float(r["load.mass_kg"]) / load - 1) < 1e-9)
            check_close(max(abs(y) for _, y in shape), stroke, "end of the curve of %s at %g kg" % (run, load), 1e-6)
    for got, (run, name) in zip(curves(folder + "/plots/fig-7.dat"), (("fig-7", "field_N_per_m"), ("fig-7", "plates_N_per_m"), ("fig-7-paper", "plates_N_per_m"))):
        wanted = column(run, name)
        check(len(got) == len(wanted) and all(abs(y - force) <= 1e-6 * abs(force) for (_, y), force in zip(got, wanted)), "fig. 7: %s of %s" % (name, run))
    half = len(table("fig-8")) // 2
    for got, (run, part) in zip(curves(folder + "/plots/fig-8.dat"), (("fig-8", slice(half)), ("fig-8", slice(half, None)), ("fig-8-paper", slice(half)))):
        wanted = column(run, "force_N", part)
        check(len(got) == len(wanted) and all(abs(y - force) <= 1e-6 * abs(force) for (_, y), force in zip(got, wanted)), "fig. 8: %s, %s" % (run, part))
    check(column("fig-8", "force_N", slice(half)) != column("fig-8", "force_N", slice(half, None)), "breakdown does not matter")


PICTURES = ["plots/fig-%d" % k for k in (6, 7, 8)] + ["runs/%s/plots/contraction" % run for run in ("fig-9", "fig-9-code-n21", "fig-9-code-n61", "fig-9-text")] + [
    "runs/fig-10/plots/profiles", "runs/fig-10-code/plots/profiles", "runs/factor/plots/factors"]


def check_pictures(folder):
    """The longest line of each picture is on the page."""
    page = open(folder + "/report.html", encoding="utf-8").read()
    for name in PICTURES:
        lines = re.findall(r"""\bd=(['"])([^'"]*)\1""", open(folder + "/" + name + ".svg", encoding="utf-8").read())
        check(max((line for _, line in lines), key=len) in page, name + " is not on the page")


def check_cells(folder, rows, page):
    """Factors, openings and reasons as the page shows them."""
    cells, text = [cell.strip() for cell in page.text], " ".join(page.text)
    small = ["÷ %.0f" % (float(r["paper"]) / float(r["ours"])) for r in rows if 1e-3 < float(r["ours"]) / float(r["paper"]) < 0.1]
    check(small and sorted(small) == sorted(cell for cell in cells if cell.startswith("÷")), "small numbers: %s" % small)
    for run in ("fig-10", "fig-10-code"):
        summary = json.load(open(folder + "/runs/%s/summary.json" % run, encoding="utf-8"))
        for name in ("start_opening_m", "widest_opening_m"):
            check("%.3f" % (1e3 * summary[name]) in cells, "%s of %s" % (name, run))
    def of(run):
        return json.load(open(folder + "/runs/%s/summary.json" % run, encoding="utf-8"))["rows"]

    for run in ("fig-8", "fig-8-paper"):
        for row in of(run):
            if row["isometric.separation"] in (1e-3, 2e-3, 4e-3):
                check("%.4f" % row["force_N"] in cells, "force of %s at %g m" % (run, row["isometric.separation"]))
    elements = {row["load.mass"]: row["stroke_m"] for row in of("finite-elements")}
    for run in ("table-2-n21", "table-2-n61", "table-2-n130"):
        for row in of(run):
            check("%.2f" % (100 * abs(1 - elements[row["load.mass"]] / row["stroke_m"])) in cells, "error of %s" % run)
    check_reasons(rows, text)


def check_reasons(rows, text):
    """The reasons that are listed are those of the comparisons, with their number."""
    counts = collections.Counter(r["why"] for r in rows if r["why"])
    listed = [int(n) for n in re.findall(r"docs/theory.md, section [^;]*; (\d+) numbers?\)", text)]
    check(sorted(listed) == sorted(counts.values()), "reasons of %s numbers, not %s" % (listed, sorted(counts.values())))


def stop_while_it_is_timed(child, folder):
    """A second in which the program is stopped while its cost is measured => the longest that it may have measured, s."""
    before = time.monotonic()
    while child.poll() is None and not os.path.exists(folder + "/runs/cost"):
        before = time.monotonic()
        time.sleep(0.005)
    child.send_signal(signal.SIGSTOP)
    time.sleep(1)
    child.send_signal(signal.SIGCONT)
    while child.poll() is None and not os.path.exists(folder + "/runs/cost/summary.json"):
        time.sleep(0.005)
    return time.monotonic() - before - 1


def whole(zipact, folder):
    start = time.monotonic()
    with open(folder + ".json", "w+", encoding="utf-8") as shown, open(folder + ".log", "w+", encoding="utf-8") as said:
        child = subprocess.Popen([zipact, "reproduce", "-o", folder, "--json"], stdout=shown, stderr=said)
        longest = stop_while_it_is_timed(child, folder)
        check(child.wait() == 0, "exit status %d" % child.returncode)
        shown.seek(0)
        check(json.load(shown)["study"] == "reproduce", "--json prints the summary")
    print("reproduce: %.1f s" % (time.monotonic() - start))
    measured = sum(row["simulated_time_s"] / row["real_time_factor"] for row in json.load(open(folder + "/runs/cost/summary.json", encoding="utf-8"))["rows"])
    check(measured < longest, "the cost is CPU time: %.2f s in %.2f s" % (measured, longest))
    sections = {"table-1", "table-2", "fig-6", "fig-7", "fig-8", "fig-9", "fig-10", "factor", "cost", "why", "files"}
    rows = check_numbers(folder)
    page = check_page(folder, sections)
    check_shown(rows, page)
    check_guesses_read_so(folder)
    check_derived(folder, rows)
    check_figures(folder)
    check_cells(folder, rows, page)
    check_overview(rows, page)
    check_runs(folder)
    if shutil.which("gnuplot"):
        check(page.pictures == len(PICTURES), "%d pictures" % page.pictures)
        check_pictures(folder)


def interrupted(zipact, folder):
    """Stop it when the first runs are there. On a terminal its progress never goes back."""
    master, slave = pty.openpty()
    child = subprocess.Popen([zipact, "reproduce", "-o", folder], stdout=subprocess.DEVNULL, stderr=slave)
    os.close(slave)
    shown = b""
    while child.poll() is None and not os.path.exists(folder + "/runs/table-2-text/summary.json"):
        if select.select([master], [], [], 0.05)[0]:
            shown += os.read(master, 4096)
    child.send_signal(signal.SIGINT)
    try:
        while piece := os.read(master, 4096):
            shown += piece
    except OSError:
        pass  # it has ended
    os.close(master)
    progress = [int(percent) for percent in re.findall(rb"\] +(\d+) %", shown)]
    check(progress == sorted(progress) and len(set(progress)) > 1, "progress goes back: %s" % progress)
    check(child.wait() == 130, "exit status %d after Ctrl-C" % child.returncode)
    summary = json.load(open(folder + "/summary.json", encoding="utf-8"))
    check(summary["outcome"] == "interrupted" and summary["message"] == "interrupted; the results so far are kept", "outcome " + summary["outcome"])
    check(0 < summary["verdicts"]["not_run"] < 30, "%d not run" % summary["verdicts"]["not_run"])
    page = check_page(folder, {"table-1", "fig-10", "why"})
    check("not run" in " ".join(page.text), "the page does not say what was not run")
    lines = list(csv.reader(open(folder + "/comparison.csv", encoding="utf-8")))
    check(all(len(line) == len(lines[0]) for line in lines), "a row of comparison.csv has a cell too few")
    rows = [dict(zip(lines[0], line)) for line in lines[1:]]
    check_reasons(rows, " ".join(page.text))
    check_overview(rows, page)


def check_overview(rows, page):
    """Of the numbers that were run, how many agree."""
    text = "|".join(cell.strip() for cell in page.text)
    for place, quantity in {(r["place"], r["quantity"]): 0 for r in rows if r["tolerance"]}:
        verdicts = [r["verdict"] for r in rows if (r["place"], r["quantity"]) == (place, quantity)]
        wanted = "|%s|%s|%d of %d|" % (place, quantity, verdicts.count("agrees"), len(verdicts) - verdicts.count("not_run"))
        check(wanted in text, "the overview does not have " + wanted)


def main():
    only_interrupted = "--interrupted" in sys.argv
    zipact, scratch = [a for a in sys.argv[1:] if a != "--interrupted"]
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    if not only_interrupted:
        whole(zipact, scratch + "/whole")
    interrupted(zipact, scratch + "/interrupted")
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
