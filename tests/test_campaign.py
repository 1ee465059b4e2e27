#!/usr/bin/env python3
"""Campaigns from outside:  python3 tests/test_campaign.py [--kills N] [--flips N] ZIPACT SCRATCH

The same cases give the same bytes for any number of workers, and after any number of kills at random instants, each
followed by --resume. What is compared: table.csv and results.h5 byte by byte, summary.json without what follows from
wall time. N kills are made (default 6), and N bits of a journal flipped (20). Standard library only. Last line: "N passed, N failed".
"""

import json
import os
import pathlib
import pty
import random
import re
import resource
import shutil
import signal
import sqlite3
import statistics
import subprocess
import sys
import time

from counting import finish, ok


def listed(first, last, count, unit):
    step = (last - first) / (count - 1)
    return "[%s]" % ", ".join("%.6g %s" % (first + i * step, unit) for i in range(count))


CASES = {
    "rest": ["stationary", "--set", "load.mass=" + listed(1, 100, 30, "g"), "--set", "ribbon.thickness=" + listed(20, 200, 20, "um"), "--set", "mesh.nodes=15"],
    "limits": ["limits", "--set", "liquid.model=none", "--set", "load.mass=" + listed(2, 20, 12, "g"), "--set", "ribbon.thickness=" + listed(40, 80, 5, "um"), "--set", "mesh.nodes=15", "--set", "output.errors=false"],
    "samples": ["limits", "--set", "liquid.model=none", "--set", "load.mass=[8 g, 9 g]", "--set", "ribbon.thickness=normal(50 um, 1 um)", "--set", "insulator.thickness=uniform(120 um, 140 um)",
                "--set", "sampling.count=8", "--set", "sampling.indices=true", "--set", "mesh.nodes=11", "--set", "output.errors=false"],
    "closing": ["actuate", "--set", "bead.volume=[50 uL, 300 uL]", "--set", "mesh.nodes=11", "--set", "solver.end_time=0.3 s", "--set", "solver.tolerance=1e-4", "--set", "output.errors=false"],
    "motion": ["actuate", "--set", "drive.voltage=[0, 6 kV, 8 kV]", "--set", "mesh.nodes=11", "--set", "solver.end_time=5 ms", "--set", "output.errors=false"],
}


class Zipact:
    def __init__(self, program):
        self.program = program

    def command(self, case, folder, *more):
        return [self.program, *CASES[case], "--no-plots", "--quiet", "-o", str(folder), *more]

    def run(self, case, folder, *more):
        return subprocess.run(self.command(case, folder, *more), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def timeless(value):
    """A summary without what follows from wall time."""
    if isinstance(value, dict):
        return {name: timeless(item) for name, item in value.items() if name not in ("wall_time_s", "real_time_factor")}
    return [timeless(item) for item in value] if isinstance(value, list) else value


def results(folder):
    files = [(folder / name).read_bytes() for name in ("table.csv", "results.h5", "scenario.yaml")]
    return files, timeless(json.loads((folder / "summary.json").read_text()))


def check_workers(zipact, scratch):
    for case in CASES:
        alone = scratch / (case + "-1")
        ok("%s by one worker: done" % case, zipact.run(case, alone, "--jobs", "1").returncode == 0)
        for jobs in (7,) if case == "limits" else (3,):
            other = scratch / ("%s-%d" % (case, jobs))
            ok("%s by %d workers: done" % (case, jobs), zipact.run(case, other, "--jobs", str(jobs)).returncode == 0)
            ok("%s by %d workers: the same bytes" % (case, jobs), results(other) == results(alone))


def rows_of(folder):
    base = sqlite3.connect("file:%s?mode=ro" % (folder / "journal.sqlite"), uri=True)
    with base:
        rows = base.execute("SELECT number, outcome FROM row ORDER BY number").fetchall()
    base.close()
    return rows


def check_kills(zipact, scratch, kills):
    """kill -9 at random instants of a run that takes some seconds, and of what writes its files."""
    chance = random.Random(20)
    for case in ("rest", "limits"):
        whole, torn = scratch / (case + "-1"), scratch / (case + "-torn")
        begin = time.monotonic()
        zipact.run(case, scratch / (case + "-timed"))
        span, left = time.monotonic() - begin, (kills + 1) // 2
        while left > 0:
            process = subprocess.Popen(zipact.command(case, torn, "--resume"), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            while process.poll() is None and not (torn / "journal.sqlite-wal").exists():
                time.sleep(0.001)
            time.sleep(chance.uniform(0, span / 2))
            process.send_signal(signal.SIGKILL)
            if process.wait() == -signal.SIGKILL:
                left -= 1
            else:  # it was quicker: from the beginning, with less time
                shutil.rmtree(torn)
                span *= 0.7
        ok("%s after kills: done" % case, zipact.run(case, torn, "--resume").returncode == 0)
        ok("%s after kills: the bytes of an uninterrupted run" % case, results(torn) == results(whole))
        ok("%s after kills: no other file is left" % case, sorted(os.listdir(torn)) == sorted(os.listdir(whole)))


def blobs_of(folder):
    """Results as the journal has them, with their wall times: those of a case that is computed again differ."""
    base = sqlite3.connect("file:%s?mode=ro" % (folder / "journal.sqlite"), uri=True)
    rows = dict(base.execute("SELECT number, record FROM row"))
    base.close()
    return rows


def spoil(folder, sql):
    base = sqlite3.connect(str(folder / "journal.sqlite"))
    with base:
        base.execute(sql)
    base.close()


def check_resume(zipact, scratch):
    """Rows count for the same case only; what is missing is computed, nothing else."""
    whole, part = scratch / "limits-1", scratch / "limits-part"
    shutil.copytree(whole, part)
    spoil(part, "DELETE FROM row WHERE number IN (3, 40)")
    before = blobs_of(part)
    ok("a journal that lacks rows: done", zipact.run("limits", part, "--resume").returncode == 0)
    ok("a journal that lacks rows: the same table", (part / "table.csv").read_bytes() == (whole / "table.csv").read_bytes())
    ok("rows that are there are not computed again", all(blobs_of(part)[number] == blob for number, blob in before.items()))
    other = zipact.run("limits", part, "--resume", "--set", "ribbon.width=13 mm")
    ok("rows of another case do not count", other.returncode == 0 and (part / "table.csv").read_bytes() != (whole / "table.csv").read_bytes())
    light, cases = scratch / "limits-light", listed(2, 20, 12, "g")
    shutil.copytree(whole, light)
    lighter = ["--resume", "--set", "load.mass=" + cases.replace("2 g", "1.9 g", 1)]
    said = subprocess.run([word for word in zipact.command("limits", light, *lighter) if word != "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    ok("rows whose chunks start from another one do not count", said.returncode == 0 and "done before" not in said.stderr)
    fresh = zipact.run("limits", part)
    ok("without --resume all is computed", fresh.returncode == 0 and results(part) == results(whole))
    (part / "journal.sqlite").write_text("no database\n" * 100)
    refused = zipact.run("limits", part, "--resume")
    ok("a file that is no journal is refused", refused.returncode in (2, 3) and "journal.sqlite" in refused.stderr)
    single = subprocess.run([zipact.program, "stationary", "--resume", "-o", str(scratch / "single")], stderr=subprocess.PIPE, text=True)
    ok("--resume of a single case is refused", single.returncode == 2 and "list" in single.stderr and not (scratch / "single").exists())


def check_changed_files(zipact, scratch):
    """Files that a key names are part of a case: a campaign that is resumed after their contents have changed is a fresh one."""
    folder = scratch / "files"
    folder.mkdir()
    quick = ["--set", "mesh.nodes=5", "--set", "liquid.model=none", "--set", "output.errors=false", "--no-plots", "--quiet", "-o"]
    fit = ["calibrate", "--set", "data.file=%s; %s" % (folder / "light.csv", folder / "heavy.csv"), "--set", "calibrate.fit=ribbon.young_modulus", "--set", "ribbon.thickness=[50 um, 60 um]", *quick]
    run = ["actuate", "--set", "drive.waveform=table", "--set", "drive.file=%s" % (folder / "drive.csv"), "--set", "load.mass=[8 g, 9 g]", "--set", "solver.end_time=1 ms", *quick]

    def write(light, heavy, volts):
        (folder / "light.csv").write_text("load_g,stroke_mm\n2,%g\n4,9.9\n" % light)
        (folder / "heavy.csv").write_text("load_g,stroke_mm\n6,9.95\n9,%g\n" % heavy)
        (folder / "drive.csv").write_text("time_ms,voltage_V\n0,0\n1,%g\n" % volts)

    def resumed_is_fresh(name, words, stays):
        resumed = subprocess.run([zipact.program, *words, str(folder / name), "--resume"])
        fresh = subprocess.run([zipact.program, *words, str(folder / (name + "-fresh"))])
        ok("changed files, %s: done" % name, resumed.returncode == 0 and fresh.returncode == 0)
        ok("changed files, %s: resumed as fresh" % name, results(folder / name) == results(folder / (name + "-fresh")))
        ok("changed files, %s: the results %s" % (name, "stay" if stays else "change"), ((folder / name / "table.csv").read_bytes() == before.get(name)) == stays)
        before[name] = (folder / name / "table.csv").read_bytes()

    before = {}
    for change, (light, heavy, volts) in enumerate(((9.8, 10.1, 5000), (9.8, 10.2, 6000), (9.7, 10.2, 6000))):
        write(light, heavy, volts)
        resumed_is_fresh("fit", fit, False)
        resumed_is_fresh("drive", run, change == 2)


def check_flipped_bits(zipact, scratch, flips):
    """A bit that the disk has lost: the results of a resumed campaign are those of an uninterrupted one, or it says that
    the journal is damaged. Without checksums 8 of 40 flipped bits gave a wrong number and status 0."""
    chance, whole, torn = random.Random(16), scratch / "flip-1", scratch / "flip-torn"
    words = [zipact.program, "stationary", "--set", "load.mass=1 g .. 9 g : 24", "--set", "mesh.nodes=5", "--set", "output.errors=false", "--no-plots", "--quiet", "--resume", "-o"]
    ok("flipped bits: a whole campaign", subprocess.run([*words, str(whole)]).returncode == 0)
    journal = bytearray((whole / "journal.sqlite").read_bytes())
    wrong = said = repaired = 0
    for _ in range(flips):
        shutil.rmtree(torn, ignore_errors=True)
        torn.mkdir()
        place, bit = chance.randrange(len(journal)), 1 << chance.randrange(8)
        journal[place] ^= bit
        (torn / "journal.sqlite").write_bytes(journal)
        journal[place] ^= bit
        run = subprocess.run([*words, str(torn)], stderr=subprocess.PIPE, text=True)
        if run.returncode != 0:
            said += 1
            wrong += run.returncode not in (2, 3) or "journal.sqlite" not in run.stderr
        else:
            repaired += 1
            wrong += results(torn) != results(whole)
    ok("flipped bits: %d of %d reported, %d with the right results, %d wrong" % (said, flips, repaired, wrong), wrong == 0)


def check_damaged_rows(zipact, scratch):
    """Whatever part of a row has changed on the disk: it is computed again."""
    whole, torn = scratch / "flip-1", scratch / "damaged"
    words = [zipact.program, "stationary", "--set", "load.mass=1 g .. 9 g : 24", "--set", "mesh.nodes=5", "--set", "output.errors=false", "--no-plots", "--quiet", "--resume", "-o", str(torn)]
    shutil.copytree(whole, torn)
    spoil(torn, "UPDATE row SET hash = hash + 1 WHERE number = 1")
    spoil(torn, "UPDATE row SET names = 99 WHERE number = 2")
    spoil(torn, "UPDATE row SET record = (SELECT record FROM row WHERE number = 7) WHERE number = 3")
    spoil(torn, "UPDATE row SET sum = sum + 1 WHERE number = 4")
    spoil(torn, "UPDATE row SET (record, sum) = (SELECT record, sum FROM row WHERE number = 7) WHERE number = 5")
    ok("damaged rows: computed again", subprocess.run(words).returncode == 0 and results(torn) == results(whole))


def check_second_interrupt(zipact, scratch):
    """A program that prints into a pipe which nobody empties ends by a second Ctrl-C."""
    words = [zipact.program, "stationary", "--set", "load.mass=1 g .. 9 g : 300", "--set", "mesh.nodes=5", "--set", "output.errors=false", "--no-plots", "--quiet", "--json", "-o", str(scratch / "pipe")]
    process = subprocess.Popen(words, stdout=subprocess.PIPE)
    while process.poll() is None and not (scratch / "pipe" / "summary.json").exists():
        time.sleep(0.01)
    sent = 0
    while process.poll() is None and sent < 40:
        process.send_signal(signal.SIGINT)
        sent += 1
        time.sleep(0.1)
    ok("second interrupt: ends at once, by the signal, and not by the first one", process.poll() == -signal.SIGINT and sent > 1)
    process.kill()
    process.communicate()


def check_time_left(zipact, scratch):
    """Two runs that would take hours: what is left is told in hours, minutes and seconds."""
    words = [zipact.program, "actuate", "--set", "solver.end_time=[10000 s, 9000 s]", "--set", "mesh.nodes=5", "--set", "drive.voltage=0", "--set", "solver.time_step=1 us", "--set", "solver.tolerance=0.1",
             "--set", "output.errors=false", "--no-plots", "--jobs", "1", "-o", str(scratch / "left")]
    master, slave = pty.openpty()
    process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=slave)
    os.close(slave)
    shown = b""
    while not (left := re.findall(rb"(\d+):(\d+):(\d+) left", shown)) and process.poll() is None:
        shown += os.read(master, 4096)
    process.send_signal(signal.SIGINT)
    try:
        while os.read(master, 4096):
            continue
    except OSError:
        pass  # it has ended
    os.close(master)
    ok("time left: hours, minutes and seconds", left and all(int(h) > 0 and int(m) < 60 and int(s) < 60 for h, m, s in left))
    ok("time left: interrupted", process.wait() == 130)


def check_time_limit(zipact, scratch):
    """A case that takes too long is a row without numbers, which is tried again; the limit is not part of the case."""
    folder, whole = scratch / "limited", scratch / "unlimited"
    words = [zipact.program, "actuate", "--set", "solver.end_time=[0.1 ms, 40 ms]", "--set", "solver.tolerance=1e-6", "--set", "liquid.model=none", "--set", "output.errors=false", "--no-plots", "--quiet", "-o"]
    limited = subprocess.run([*words, str(folder), "--set", "solver.max_cpu_time=0.05 s"])
    rows = json.loads((folder / "summary.json").read_text())["rows"]
    ok("time limit: status 1", limited.returncode == 1)
    ok("time limit: the outcomes", [row["outcome"] for row in rows] == ["end_time", "time_limit"])
    numbers = [value for name, value in rows[1].items() if isinstance(value, (int, float)) and name not in ("wall_time_s", "real_time_factor", "solver.end_time")]
    ok("time limit: numbers are null, and the message says why", numbers == [] and "solver.max_cpu_time = 0.05 s" in rows[1]["message"])
    before = blobs_of(folder)
    ok("time limit: resumed without it", subprocess.run([*words, str(folder), "--resume"]).returncode == 0)
    ok("time limit: the row that was done is kept", blobs_of(folder)[0] == before[0])
    ok("time limit: a whole one", subprocess.run([*words, str(whole)]).returncode == 0)
    ok("time limit: the same results", results(folder) == results(whole))
    single = subprocess.run([*[word.replace("[0.1 ms, 40 ms]", "40 ms") for word in words], str(scratch / "limited-single"), "--set", "solver.max_cpu_time=0.05 s", "--json"], stdout=subprocess.PIPE, text=True)
    ok("time limit: of a single run", single.returncode == 1 and json.loads(single.stdout)["outcome"] == "time_limit" and json.loads(single.stdout)["zip_time_s"] is None)


def check_samples(zipact, scratch):
    """Statistics are those of the rows; a longer sequence begins with the same samples, whose rows are kept."""
    folder, longer = scratch / "samples-1", scratch / "samples-longer"
    summary = json.loads((folder / "summary.json").read_text())
    for k, mass in enumerate((0.008, 0.009)):
        of_mass = [row for row in summary["rows"] if row["load.mass"] == mass]
        ok("samples: all rows of %g kg" % mass, len(of_mass) == 8 * 4)
        drawn = [row["pull_in_voltage_V"] for i, row in enumerate(of_mass) if i % 4 < 2]
        found = summary["statistics"][k]["outputs"]["pull_in_voltage_V"]
        ok("samples: mean of the rows", abs(found["mean"] / statistics.fmean(drawn) - 1) < 1e-14 and found["count"] == 16)
        ok("samples: deviation of the rows", abs(found["standard_deviation"] / statistics.stdev(drawn) - 1) < 1e-12)
        ok("samples: indices by key", set(found["total_indices"]) == {"ribbon.thickness", "insulator.thickness"} and found["total_indices"]["ribbon.thickness"] > 0.5)
    words = [zipact.program, "stationary", "--set", "ribbon.thickness=normal(50 um, 1 um)", "--set", "mesh.nodes=11", "--set", "output.errors=false", "--no-plots", "--quiet", "-o", str(longer), "--resume"]
    ok("samples: 8", subprocess.run([*words, "--set", "sampling.count=8"]).returncode == 0)
    before = blobs_of(longer)
    ok("samples: 16", subprocess.run([*words, "--set", "sampling.count=16"]).returncode == 0)
    after = blobs_of(longer)
    ok("samples: the first 8 are kept", len(before) == 8 and len(after) == 16 and all(after[number] == before[number] for number in before))
    missing = subprocess.run([zipact.program, "limits", "--set", "liquid.model=none", "--set", "drive.voltage=uniform(4 kV, 7 kV)", "--set", "mesh.nodes=21", "--set", "sampling.count=16",
                              "--set", "output.errors=false", "--no-plots", "--json", "-o", str(scratch / "censored")], stdout=subprocess.PIPE, text=True)
    found = json.loads(missing.stdout)["statistics"][0]["outputs"]["pull_in_voltage_V"]
    ok("samples: those that do not pull in are counted", missing.returncode == 0 and 0 < found["missing"] < 16 and found["count"] + found["missing"] == 16)


def check_interrupt(zipact, scratch):
    """Ctrl-C: 130, rows without a gap are reported, the rest is in the journal. A case whose estimated errors it came
    into was a row without them."""
    whole, torn, fine = scratch / "rest-fine", scratch / "rest-interrupted", ("--set", "mesh.nodes=121")
    ok("interrupted: a whole one", zipact.run("rest", whole, *fine).returncode == 0)
    torn_apart = 0
    for after in (0, 0.02, 0.05):
        shutil.rmtree(torn, ignore_errors=True)
        process = subprocess.Popen(zipact.command("rest", torn, *fine), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not (torn / "journal.sqlite-wal").exists() and process.poll() is None:
            time.sleep(0.002)
        time.sleep(after)
        process.send_signal(signal.SIGINT)
        done = process.wait() == 0  # a fast machine has ended before
        ok("interrupted: 130", done or process.returncode == 130)
        if (torn / "summary.json").exists():
            summary = json.loads((torn / "summary.json").read_text())
            done = done or len(summary["rows"]) == 600  # the signal may come when only files are left to be written
            ok("interrupted: the summary says so", done or summary["outcome"] == "interrupted" and ("cases" in summary["message"] or "before the first" in summary["message"]))
            ok("interrupted: rows are in the journal", len(summary["rows"]) <= len(rows_of(torn)))
        torn_apart += not done
        ok("interrupted: resumed", zipact.run("rest", torn, *fine, "--resume").returncode == 0)
        ok("interrupted: the bytes of an uninterrupted run", results(torn) == results(whole))
    ok("interrupted: some of them while cases were left", torn_apart > 0)


def check_unfinished(zipact, scratch):
    """The journal of an unfinished campaign was replaced without a word when --resume was forgotten."""
    whole, torn = scratch / "limits-1", scratch / "limits-forgotten"
    shutil.copytree(whole, torn)
    spoil(torn, "DELETE FROM row WHERE number IN (3, 40)")
    before = rows_of(torn)
    forgotten = zipact.run("limits", torn)
    ok("unfinished, without --resume: refused", forgotten.returncode == 2 and "58 of 60 cases" in forgotten.stderr and "--resume" in forgotten.stderr)
    ok("unfinished, without --resume: all rows are kept", rows_of(torn) == before)
    said = subprocess.run([word for word in zipact.command("limits", torn, "--resume") if word != "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    ok("unfinished, with --resume: done", said.returncode == 0 and results(torn) == results(whole))
    ok("unfinished, with --resume: how many were done", "zipact: 36 of 60 cases were done before\n" in said.stderr)  # all but two chunks of twelve
    spoil(torn, "DELETE FROM row")
    ok("a journal without rows is replaced", zipact.run("limits", torn).returncode == 0)


def rows_so_far(folder):
    try:
        return [number for number, _ in rows_of(folder)]
    except sqlite3.OperationalError:  # not made yet
        return []


def check_gap(zipact, scratch):
    """Two workers: the third case is done while the second still runs. Files show rows up to that gap."""
    folder = scratch / "gap"
    words = [zipact.program, "actuate", "--set", "solver.end_time=[1 ms, 10000 s, 1 ms]", "--set", "mesh.nodes=11", "--set", "drive.voltage=1 kV", "--set", "drive.waveform=sine", "--set", "drive.frequency=50 Hz",
             "--set", "output.errors=false", "--no-plots", "--quiet", "--jobs", "2", "-o", str(folder)]
    process = subprocess.Popen(words)
    while rows_so_far(folder) != [0, 2] and process.poll() is None:
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    ok("a gap: 130", process.wait() == 130)
    summary = json.loads((folder / "summary.json").read_text())
    ok("a gap: rows before it", len(summary["rows"]) == 1 and summary["message"] == "stopped after 1 of 3 cases")
    ok("a gap: the journal has those behind it", rows_so_far(folder) == [0, 2])


def has_open(process, path):
    """Has the process a file open?"""
    try:
        return any(link.exists() and link.samefile(path) for link in pathlib.Path("/proc/%d/fd" % process.pid).iterdir())
    except OSError:  # it has ended
        return False


def check_locked(zipact, scratch):
    """Another program that locks the journal for a moment delays a campaign, no more."""
    folder = scratch / "locked"
    folder.mkdir()
    other = sqlite3.connect(folder / "journal.sqlite", isolation_level=None)
    other.execute("BEGIN EXCLUSIVE")
    process = subprocess.Popen(zipact.command("rest", folder, "--resume"), stdout=subprocess.DEVNULL)
    while process.poll() is None and not has_open(process, folder / "journal.sqlite"):
        time.sleep(0.01)
    time.sleep(0.2)
    other.close()
    ok("a locked journal: waited for", process.wait() == 0 and len(rows_of(folder)) == 600)


def check_broken_files(zipact, scratch):
    """A file that cannot be written is named, whichever thread writes it, and summary.json stays away: it says that all others are complete."""
    for name in ("table.csv", "results.h5"):
        for jobs in ("1", "2", "3"):
            folder = scratch / "broken"
            shutil.rmtree(folder, ignore_errors=True)
            (folder / name / "in the way").mkdir(parents=True)
            done = zipact.run("motion", folder, "--jobs", jobs)
            ok("%s in the way, %s workers: said" % (name, jobs), done.returncode == 3 and name in done.stderr)
            ok("%s in the way, %s workers: no summary.json, nothing temporary" % (name, jobs), not list(folder.glob("*summary*")) and not list(folder.glob("*tmp*")))


def small_disk():
    """No file may become longer than a small disk holds."""
    resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))


def check_full_disk(zipact, scratch):
    """A disk that is full is status 3 and says which file; what was done before counts when there is room again."""
    folder = scratch / "full"
    words = zipact.command("rest", folder)
    full = subprocess.run(words, stderr=subprocess.PIPE, text=True, preexec_fn=small_disk, restore_signals=False)  # SIGXFSZ stays ignored
    ok("a full disk: status 3, and the journal is named", full.returncode == 3 and "journal.sqlite" in full.stderr)
    kept, whole = (place / "table.csv" for place in (folder, scratch / "rest-1"))  # a slow machine has put some rows before
    ok("a full disk: no table but of the rows before", not kept.exists() or whole.read_text().startswith(kept.read_text()) and kept.read_text().count("\n") - 1 <= len(rows_of(folder)) < 600)
    again = zipact.run("rest", folder, "--resume")
    ok("with room again: the bytes of an uninterrupted run", again.returncode == 0 and results(folder) == results(scratch / "rest-1"))
    folder = scratch / "filling"
    words = [zipact.program, "stationary", "--set", "output.errors=false", "--no-plots", "--quiet", "-o", str(folder), "--set"]
    subprocess.run([*words, "mesh.nodes=[5, 9]"], check=True)
    before = (folder / "table.csv").read_text().splitlines()
    (folder / "table.csv").unlink()
    full = subprocess.run([*words, "mesh.nodes=[5, 9, 2001]", "--resume"], stderr=subprocess.PIPE, text=True, preexec_fn=small_disk, restore_signals=False)
    ok("a disk that a row fills: status 3, and the journal is named", full.returncode == 3 and "journal.sqlite" in full.stderr)
    ok("a disk that a row fills: a table of the rows before", (folder / "table.csv").exists() and (folder / "table.csv").read_text().splitlines() == before)


def check_outcomes(zipact, scratch):
    """Rows keep the outcomes of their runs; that of an actuator that opens again is an answer."""
    folder = scratch / "outcomes"
    done = zipact.run("closing", folder)
    rows = json.loads((folder / "summary.json").read_text())["rows"]
    ok("outcomes of rows", done.returncode == 0 and [row["outcome"] for row in rows] == ["reopened", "zipped"])
    ok("closed from", rows[0]["closed_from_s"] is None and rows[1]["closed_from_s"] > rows[1]["zip_time_s"])


def check_failures(zipact, scratch):
    """A case whose solver fails is a row; the campaign goes on and its status says 1."""
    folder = scratch / "failing"
    run = subprocess.run([zipact.program, "actuate", "--set", "liquid.model=none", "--set", "solver.max_steps=[3, 1000000]", "--set", "drive.voltage=[0, 8 kV]", "--set", "mesh.nodes=11",
                          "--set", "solver.end_time=2 ms", "--set", "output.errors=false", "--no-plots", "--quiet", "-o", str(folder)])
    outcomes = [outcome for _, outcome in rows_of(folder)]
    ok("failures: status 1", run.returncode == 1)
    ok("failures: all rows", len(outcomes) == 4 and outcomes.count("step_limit") == 2)
    again = subprocess.run([zipact.program, "run", str(folder / "scenario.yaml"), "--resume", "--quiet", "-o", str(folder)])
    ok("failures: a failed row counts when resumed", again.returncode == 1)


def check_batch(zipact):
    """Lines in, lines out: in order, as the command would answer, at once, whatever is wrong with others."""
    good = [{"study": "stationary", "load.mass": "%d g" % mass, "mesh": {"nodes": 21}} for mass in range(1, 40)]
    bad = ["", "hello", "[]", '{"load.mass": [1, 2]}', '{"load.mas": 1}', '{"load.mass": "1 m"}', '{"load.mass": 1', '{"study": "isometric", "isometric.separation": 1}']
    lines = [json.dumps(case) for case in good] + bad + [json.dumps(good[0])]
    command = [zipact.program, "batch", "--set", "output.errors=false", "--set", "load.mass=77 g"]
    answers = {}
    for jobs in ("1", "7"):
        run = subprocess.run([*command, "--jobs", jobs], input="\n".join(lines), stdout=subprocess.PIPE, text=True)
        answers[jobs] = [timeless(json.loads(line)) for line in run.stdout.splitlines()]
        ok("batch by %s: status 0" % jobs, run.returncode == 0)
        ok("batch by %s: an answer for each line" % jobs, len(answers[jobs]) == len(lines))
    ok("batch: the same for any number of workers", answers["1"] == answers["7"])
    ok("batch: a message does not repeat its line", not any("line " in a["error"][:6] for a in answers["1"] if "error" in a))
    ok("batch: errors where they belong", [list(a) == ["error"] for a in answers["1"]] == [False] * len(good) + [True] * len(bad) + [False])
    ok("batch: a line wins over --set", answers["1"][0]["stroke_m"] < answers["1"][30]["stroke_m"] and answers["1"][-1] == answers["1"][0])
    alone = subprocess.run([zipact.program, "stationary", "--set", "output.errors=false", "--set", "load.mass=5 g", "--set", "mesh.nodes=21", "--no-plots", "--json", "-o", "batch-alone"], stdout=subprocess.PIPE, text=True)
    ok("batch: what the command answers", timeless(json.loads(alone.stdout)) == answers["1"][4])
    dialog = subprocess.Popen([*command, "--jobs", "2"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    for line, answer in list(zip(lines, answers["1"]))[:5]:
        dialog.stdin.write(line + "\n")
        dialog.stdin.flush()
        ok("batch: answers before the next line comes", timeless(json.loads(dialog.stdout.readline())) == answer)
    dialog.stdin.close()
    ok("batch: ends with its input", dialog.wait() == 0)
    bare = subprocess.run([zipact.program, "batch", "--set", "drive.voltage=6000"], input='{"load.mass": "1 m"}\n' * 3, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    ok("batch: a number without a unit is told once, not for each line", bare.stderr.count("drive.voltage: 6000 taken as 6000 V") == 1)
    ok("batch: wrong common input is status 2", subprocess.run([zipact.program, "batch", "--set", "load.mas=1"], stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode == 2)
    with open("/dev/full", "w") as full:
        broken = subprocess.run(command, input="\n".join(lines), stdout=full, stderr=subprocess.PIPE, text=True)
    ok("batch: a full disk is status 3", broken.returncode == 3)


def main():
    kills, flips = 6, 20
    arguments = sys.argv[1:]
    if arguments[:1] == ["--kills"]:
        kills = int(arguments[1])
        arguments = arguments[2:]
    if arguments[:1] == ["--flips"]:
        flips = int(arguments[1])
        arguments = arguments[2:]
    program, scratch = os.path.abspath(arguments[0]), pathlib.Path(arguments[1]).resolve()
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    zipact = Zipact(program)
    check_workers(zipact, scratch)
    check_kills(zipact, scratch, kills)
    check_resume(zipact, scratch)
    check_changed_files(zipact, scratch)
    check_flipped_bits(zipact, scratch, flips)
    check_damaged_rows(zipact, scratch)
    check_second_interrupt(zipact, scratch)
    check_time_left(zipact, scratch)
    check_time_limit(zipact, scratch)
    check_samples(zipact, scratch)
    check_unfinished(zipact, scratch)
    check_interrupt(zipact, scratch)
    check_gap(zipact, scratch)
    check_locked(zipact, scratch)
    check_broken_files(zipact, scratch)
    check_full_disk(zipact, scratch)
    check_failures(zipact, scratch)
    check_outcomes(zipact, scratch)
    os.chdir(scratch)
    check_batch(zipact)
    return finish()


if __name__ == "__main__":
    sys.exit(main())
