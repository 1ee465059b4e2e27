#!/usr/bin/env python3
"""Faults that a maintainer could make, and whether a test notices: mutants.py [BUILD] [OPTIONS]

tests/mutants/*.txt has the faults: a file, a name, the text and what replaces it.

    src/run/supply_coupling.c leaves_out_the_cable
    - charge + [[cable]]
    + 0

replaces the text in double brackets, or the whole text where there are none. It stands once in its file, and is an
expression or whole statements. All faults of C are compiled at once, into a copy of the sources in BUILD/mutants, and one
is chosen when a program starts (ZP_MUTANT=NUMBER). A file that is not C, and one marked `compiled`, is changed and
compiled for its fault alone. A line `? WHY` says why a fault changes nothing that could be tested: it is not counted.

Faults of python/, octave/ and web/ meet the tests of `make python`, `make octave` and `make check-web`, the others those of
`make check`.

Each test function of `make check` runs once without a fault, which shows the faults that it reaches and what it costs. Then
each fault meets the tests that reach it, the quickest first, until one fails or all have taken --limit seconds. Pages that
are made from the program's numbers are no tests. BUILD/mutants/results.json keeps the results, so that a second call continues
where the first one ended.
Status 1 if less than 95 % of the faults are noticed, or less than 90 % in one room.
"""
import argparse
import collections
import concurrent.futures
import functools
import glob
import hashlib
import json
import math
import os
import re
import random
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import time

HOME = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
# What looks at texts and packages, not at what the program does.
PAGES = re.compile(r"_current$|^(links|rules|deps|embedded|test_install|binaries)$")
WANTED, WANTED_IN_A_ROOM = 0.95, 0.90
UNKNOWN = 10  # times the limit for a fault alone in its file: which tests reach it is not known

# The header is included by each file with a fault: reaching a fault marks it in a file that all processes of a test share.
RUNTIME_H = """#ifndef ZP_MUTANT_H
#define ZP_MUTANT_H
#include <math.h>
#include <stdbool.h>

__attribute__((visibility("hidden"))) extern int zp_mutant_chosen;
__attribute__((visibility("hidden"))) extern unsigned char *zp_mutant_reached;
#define ZP_MUTANT(k) (zp_mutant_reached[k] = 1, zp_mutant_chosen == (k))
#endif
"""
RUNTIME_C = """#include <zipact/mutant.h>
#ifndef __wasi__
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

static unsigned char nowhere[SIZE];
int zp_mutant_chosen;
unsigned char *zp_mutant_reached = nowhere;

#ifndef __wasi__ /* the core of the page has all faults, and none is chosen */
__attribute__((constructor)) static void choose(void) {
  const char *number = getenv("ZP_MUTANT"), *path = getenv("ZP_MUTANTS_REACHED");
  zp_mutant_chosen = number ? atoi(number) : 0;
  int file = path ? open(path, O_RDWR) : -1;
  if (file < 0) return;
  void *map = mmap(NULL, SIZE, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (map != MAP_FAILED) zp_mutant_reached = map;
  close(file);
}
#endif
"""


class Mutant:
    def __init__(self, file, name, compiled, place):
        self.file, self.name, self.place = file, name, place
        self.compiled = compiled or not re.search(r"\.[ch]$", file)
        self.old, self.new, self.why = [], [], []
        self.number = 0

    def key(self):
        return f"{self.file} {self.name}"

    def room(self):
        parts = self.file.split("/")
        return "/".join(parts[:2]) if parts[0] == "src" else parts[0]

    def find(self, text):
        """Where it begins and ends in the text, and what replaces it."""
        old, new = "\n".join(self.old), "\n".join(self.new)
        inner = marked(old)
        whole = old if not inner else inner[0] + inner[1] + inner[2]
        pattern = r"\s+".join(re.escape(word) for word in whole.split())
        places = list(re.finditer(pattern, text))
        if re.search(r";.*\*/$", inner[1] if inner else old):
            raise SystemExit(f"{self.place}: statements end with ; or }}, not with a comment")
        if len(places) != 1:
            raise SystemExit(f"{self.place}: {self.file} has this text {len(places)} times, not once: {whole}")
        begin, end = places[0].span()
        if inner:
            before = r"\s+".join(re.escape(word) for word in inner[0].split())
            part = r"\s+".join(re.escape(word) for word in inner[1].split())
            found = re.compile(before + r"\s*(" + part + ")").match(text, begin)
            begin, end = found.span(1)
        return begin, end, new

    def choice(self, old, new):
        """Both texts, of which the program takes one."""
        if re.search(r"[;}]$", old) and not re.match(r"\(\w+\){", old):  # statements, but no compound literal
            return f"{{ if (ZP_MUTANT({self.number})) {{ {new} }} else {{ {old} }} }}"
        return f"(ZP_MUTANT({self.number}) ? ({new}) : ({old}))"


def marked(text):
    """What stands before, between and after double brackets; None where there are none. Brackets between are in pairs."""
    for begin in re.finditer(r"\[\[(?!\[)", text):
        for end in re.finditer(r"(?=\]\])", text[begin.end():]):
            part = text[begin.end():begin.end() + end.start()]
            if part.count("[") == part.count("]"):
                return text[:begin.start()], part, text[begin.end() + end.start() + 2:]
    return None


def read_tables():
    mutants = []
    for path in sorted(glob.glob(os.path.join(HOME, "tests/mutants/*.txt"))):
        for number, line in enumerate(open(path, encoding="utf-8"), 1):
            line = line.rstrip("\n")
            if not line.strip() or line.startswith("#"):
                continue
            if line[:2] in ("- ", "+ ", "? ") or line in ("-", "+"):
                {"-": mutants[-1].old, "+": mutants[-1].new, "?": mutants[-1].why}[line[0]].append(line[2:])
                continue
            words = line.split()
            mutants.append(Mutant(words[0], words[1], "compiled" in words[2:], f"{os.path.basename(path)}:{number}"))
    for k, mutant in enumerate(mutants):
        mutant.number = k + 1
    keys = [mutant.key() for mutant in mutants]
    for key in keys:
        if keys.count(key) > 1:
            raise SystemExit(f"tests/mutants: two faults are called {key}")
    return mutants


def sources():
    """All files of the project, by their path in it."""
    listed = subprocess.run(["git", "-C", HOME, "ls-files", "-co", "--exclude-standard"], check=True, stdout=subprocess.PIPE, text=True)
    return [file for file in listed.stdout.splitlines() if os.path.isfile(os.path.join(HOME, file))]


def read(path):
    with open(path, "rb") as file:
        return file.read()


def write(path, content):
    """Only if it changes: what has not changed is not compiled again."""
    if os.path.exists(path) and read(path) == content:
        return
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "wb") as file:
        file.write(content)


def planted(file, mutants):
    """The text of a file with all its faults that are chosen at run time."""
    text = read(os.path.join(HOME, file)).decode()
    places = sorted((mutant.find(text) + (mutant,) for mutant in mutants), key=lambda place: place[0])
    places = [place for place in places if not place[3].compiled]
    for this, following in zip(places, places[1:]):
        if this[1] > following[0]:
            raise SystemExit(f"{following[3].place}: overlaps {this[3].name}")
    for begin, end, new, mutant in reversed(places):
        text = text[:begin] + mutant.choice(text[begin:end], new) + text[end:]
    return '#include "zipact/mutant.h"\n#line 1\n' + text if places else text


def copy_sources(mutants, tree):
    by_file = {}
    for mutant in mutants:
        by_file.setdefault(mutant.file, []).append(mutant)
    for file in sources():
        content = planted(file, by_file[file]).encode() if file in by_file else read(os.path.join(HOME, file))
        if file == "CMakeLists.txt":  # the shared library of files has its own copy of what libzipact does not export
            content = content.replace(b"src/base/fail.c ", b"src/base/fail.c src/base/mutant.c ")
        write(os.path.join(tree, file), content)
        shutil.copymode(os.path.join(HOME, file), os.path.join(tree, file))
    write(os.path.join(tree, "include/zipact/mutant.h"), RUNTIME_H.encode())
    write(os.path.join(tree, "src/base/mutant.c"), RUNTIME_C.replace("SIZE", str(len(mutants) + 1)).encode())


def build(folder):
    command = ["cmake", "--build", os.path.join(folder, "build"), "-j", str(os.cpu_count() or 2)]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode == 0, done.stdout


def refused(build, file, mutants, folder):
    """What the compiler of the build says of a file with its faults; "" if it accepts it, or does not compile it."""
    commands = commands_for(build, file)
    if not commands:
        return ""
    place = os.path.join(folder, file)
    write(place, planted(file, [mutant for mutant in mutants if mutant.file == file]).encode())
    words = shlex.split(commands[0]["command"])
    words = words[words.index(next(word for word in words if re.search(r"(gcc|clang|cc)(-\d+)?$", word))):words.index("-o")]
    done = subprocess.run([*words, f"-I{folder}/include", f"-I{os.path.dirname(os.path.join(HOME, file))}", "-Werror", "-fsyntax-only", place],
                          cwd=commands[0]["directory"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.stdout if done.returncode else ""


def commands_for(build, file):
    return [entry for entry in compile_commands(build) if entry["file"] == os.path.join(HOME, file)]


@functools.lru_cache
def compile_commands(build):
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        return json.load(file)


def check_syntax(build, mutants, jobs):
    """Is what replaces the texts C? => whether it is"""
    files = sorted({mutant.file for mutant in mutants if mutant.file.endswith(".c")})
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        write(os.path.join(folder, "include/zipact/mutant.h"), RUNTIME_H.encode())
        said = [text for text in pool.map(lambda file: refused(build, file, mutants, folder), files) if text]
    known = sum(bool(commands_for(build, file)) for file in files)
    print("".join(said)[:4000] + f"{len(files)} files, {known} of which the build compiles, {len(said)} of them no C with their faults")
    return known > 0 and not said


class Test:
    """A test of ctest, or one function of a test program."""

    def __init__(self, entry, function=None, room=None):
        """`room`: whose faults it meets; None for a test of make check, which meets those of all rooms without tests of their own."""
        self.room = room
        self.name, self.command = entry["name"] + (f"/{function}" if function else ""), entry.get("command", [])
        properties = {p["name"]: p["value"] for p in entry.get("properties", [])}
        self.environment = dict(pair.split("=", 1) for pair in properties.get("ENVIRONMENT", []))
        if function:
            self.environment["ZP_TEST"] = function
        self.folder = properties["WORKING_DIRECTORY"]
        self.skipped = properties.get("SKIP_RETURN_CODE")
        self.cost, self.reached = None, frozenset()

    def run(self, folder, number, reached=None):
        """Does it pass? And the CPU time that it takes, s."""
        scratch = os.path.join(folder, "build/tests/scratch")
        own = f"{scratch}-{threading.current_thread().name}"
        os.makedirs(self.folder.replace(scratch, own), exist_ok=True)
        environment = dict(os.environ, **self.environment, ZP_MUTANT=str(number))
        if reached:
            environment["ZP_MUTANTS_REACHED"] = reached
        limit = int(3 * self.cost + 10) if self.cost is not None else 3600
        process = subprocess.Popen(["prlimit", f"--cpu={limit}"] + [word.replace(scratch, own) for word in self.command],
                                   cwd=self.folder.replace(scratch, own), env=environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

        def end():
            try:
                os.killpg(process.pid, 9)
            except ProcessLookupError:
                pass
        alarm = threading.Timer(60 + 20 * limit, end)  # a process that waits for ever uses no CPU time
        alarm.start()
        _, status, used = os.wait4(process.pid, 0)
        alarm.cancel()
        end()  # and what it has left
        code = process.returncode = os.waitstatus_to_exitcode(status)
        return code == 0 or code == self.skipped, used.ru_utime + used.ru_stime


def functions_of(entry):
    """The test functions of a program of check's; None for another test."""
    source = os.path.join(HOME, "tests", entry["name"] + ".c")
    if not os.path.exists(source):
        return [None]
    return sorted(set(re.findall(r"^\w*TESTS?(?:_ENDED_BY)?\((\w+)", read(source).decode(), re.MULTILINE))) or [None]


def tests_of(folder):
    listed = subprocess.run(["ctest", "--test-dir", os.path.join(folder, "build"), "-LE", "nightly", "--show-only=json-v1"], check=True,
                            stdout=subprocess.PIPE, text=True)
    return [Test(entry, function) for entry in json.loads(listed.stdout)["tests"] if not PAGES.search(entry["name"])
            for function in functions_of(entry)]


def baseline(folder, test, count):
    """A test without a fault: whether it passes, its CPU time, the faults that it reaches."""
    path = os.path.join(folder, f"reached-{threading.current_thread().name}")
    write(path, bytes(count + 1))
    passes, cost = test.run(folder, 0, path)
    marks = read(path)
    os.remove(path)
    return passes, cost, [k for k in range(1, count + 1) if marks[k]]


class Noticed:
    """How often each test has noticed a fault, by the fault's file and room: what has noticed others like it goes first."""

    def __init__(self):
        self.counts = collections.Counter()

    def add(self, mutant, test):
        self.counts.update([(test, mutant.file), (test, mutant.room())])

    def order(self, mutant, tests):
        return sorted(tests, key=lambda test: (test.cost + 0.02) / (1 + 4 * self.counts[test.name, mutant.file] +
                                                                     self.counts[test.name, mutant.room()]))


def notice(folder, mutant, tests, noticed, limit):
    """The first test that fails with a fault, or None; and what the tests took together, s."""
    spent = 0
    for test in noticed.order(mutant, tests):
        if spent + test.cost > limit:
            continue
        passes, cost = test.run(folder, mutant.number)
        spent += cost
        if not passes:
            noticed.add(mutant, test.name)
            return test.name, spent
    return None, spent


def placed(folder, mutant):
    """The file that a fault which is not chosen at run time is put in: packages are installed without compiling."""
    directory, name = os.path.split(mutant.file)
    if directory == "python/zipact":
        return glob.glob(os.path.join(folder, "build/python/venv/lib/python3*/site-packages/zipact", name))[0]
    if directory == "octave":
        return os.path.join(folder, "build/octave", name)
    return os.path.join(folder, mutant.file)


def build_alone(folder, mutant):
    """Rebuilds what depends on the file with the fault."""
    if mutant.room() == "web":
        done = subprocess.run([os.path.join(folder, "scripts/web.sh")], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return done.returncode == 0
    return placed(folder, mutant) != os.path.join(folder, mutant.file) or build(folder)[0]


def notice_compiled(folder, mutant, tests, noticed, limit):
    """As notice(), for a fault that is alone in its file; the copy is as it was after it."""
    path = placed(folder, mutant)
    before = read(path)
    text = read(os.path.join(HOME, mutant.file)).decode()
    begin, end, new = mutant.find(text)
    write(path, (text[:begin] + new + text[end:]).encode())
    try:
        return notice(folder, mutant, tests, noticed, limit) if build_alone(folder, mutant) else ("the compiler", 0)
    finally:
        write(path, before)


# Rooms with tests of their own: how these are built, which files they are, and how one of them runs. {} is the copy of the sources.
ROOMS = {
    "python": ("{}/scripts/test-python.sh {}/build --build", "python/tests/test_*.py",
               "{}/scripts/test-python.sh {}/build --built -x {}/"),
    "octave": ("{}/scripts/test-octave.sh {}/build --build", "octave/tests/test_*.m",
               "{}/scripts/test-octave.sh {}/build --built {}/"),
    "web": ("{}/scripts/web.sh", "web/test/*.test.mjs", "env ZIPACT={}/build/zipact node --test {}/"),
}


def tests_of_rooms(folder, mutants):
    """Builds and lists the tests of the rooms that have their own and a fault among these."""
    tests = []
    for room in sorted({mutant.room() for mutant in mutants} & set(ROOMS)):
        prepare, pattern, command = ROOMS[room]
        subprocess.run(prepare.replace("{}", folder).split(), check=True, stdout=subprocess.DEVNULL)
        for path in sorted(glob.glob(os.path.join(HOME, pattern))):  # the copy may have old ones
            file = os.path.relpath(path, HOME)
            words = (command.replace("{}", folder) + file).split()
            tests.append(Test({"name": file, "command": words, "properties": [{"name": "WORKING_DIRECTORY", "value": folder}]}, room=room))
    return tests


def tests_for(mutant, tests):
    """Those that may notice a fault: they are of its room, and reach it, if that is known."""
    own = mutant.room() if mutant.room() in ROOMS else None
    return [test for test in tests if test.room == own and (mutant.compiled or mutant.number in test.reached)]


def fingerprint():
    """Of all that the results depend on."""
    digest = hashlib.sha256()
    for file in sources():
        if not file.startswith("docs/"):
            digest.update(file.encode() + b"\0" + read(os.path.join(HOME, file)) + b"\0")
    return digest.hexdigest()


class Results:
    """What is known so far, in a file that a second call reads."""

    def __init__(self, path, arguments):
        self.path, self.known = path, {"tests": {}, "faults": {}}
        key = fingerprint()
        if os.path.exists(path) and not arguments.again:
            with open(path, encoding="utf-8") as file:
                kept = json.load(file)
            if kept["of"] == key or arguments.unnoticed:
                self.known = kept
            if arguments.unnoticed and kept["of"] != key:
                self.known["tests"] = {}
                self.known["faults"] = {fault: test for fault, test in kept["faults"].items() if test}
        self.known["of"] = key
        self.lock = threading.Lock()

    def keep(self, part, name, value):
        with self.lock:
            self.known[part][name] = value
            with open(self.path + ".new", "w", encoding="utf-8") as file:
                json.dump(self.known, file, indent=1)
            os.replace(self.path + ".new", self.path)


def report(mutants, faults):
    """Prints what no test notices, and the shares by room; are these as wanted?"""
    counted = [mutant for mutant in mutants if not mutant.why and mutant.key() in faults]
    for mutant in counted:
        if faults[mutant.key()] is None:
            print(f"not noticed: {mutant.key()} ({mutant.place})")
    rooms = sorted({mutant.room() for mutant in counted})
    enough = True
    print(f"\n{'room':<16} {'faults':>6} {'noticed':>8}")
    for room in rooms + ["all"]:
        of_room = [mutant for mutant in counted if room in (mutant.room(), "all")]
        noticed = sum(faults[mutant.key()] is not None for mutant in of_room)
        print(f"{room:<16} {len(of_room):>6} {noticed:>8}")
        enough &= noticed >= (WANTED if room == "all" else WANTED_IN_A_ROOM) * len(of_room)
    reasons = sum(bool(mutant.why) for mutant in mutants)
    print(f"{reasons} more change nothing that could be tested, each for a reason in the table; "
          f"{len(mutants) - reasons - len(counted)} were not tried")
    return enough


def known_tests(folder, mutants, results, pool, wanted):
    """Those that pass without a fault, with what they cost and reach."""
    tests = tests_of(folder) + tests_of_rooms(folder, wanted)

    def know(test):
        if test.name not in results.known["tests"]:
            results.keep("tests", test.name, baseline(folder, test, len(mutants)))
        passes, test.cost, reached = results.known["tests"][test.name]
        test.reached = frozenset(reached)
        if not passes:
            print(f"fails without a fault: {test.name}", flush=True)
        return passes
    return [test for test, passes in zip(tests, pool.map(know, tests)) if passes]


def try_all(folder, mutants, results, arguments):
    noticed, began = Noticed(), time.monotonic()

    def attempt(mutant, one):
        if time.monotonic() - began > arguments.seconds:
            return
        limit = arguments.limit * (UNKNOWN if mutant.compiled else 1)
        test, spent = one(folder, mutant, tests_for(mutant, tests), noticed, limit)
        results.keep("faults", mutant.key(), test)
        print(f"{mutant.key()}: {test or 'NOT NOTICED'} ({spent:.1f} s)", flush=True)
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs, "worker") as pool:
        wanted = [mutant for mutant in mutants if arguments.only in mutant.key() and not mutant.why
                  and mutant.key() not in results.known["faults"]]
        tests = known_tests(folder, mutants, results, pool, wanted)
        random.Random(results.known["of"]).shuffle(wanted)
        list(pool.map(lambda mutant: attempt(mutant, notice), [mutant for mutant in wanted if not mutant.compiled]))
    for mutant in wanted:
        if mutant.compiled:
            attempt(mutant, notice_compiled)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", help="build folder; without one, only whether each text stands once in its file")
    parser.add_argument("--syntax", action="store_true", help="only whether the compiler of BUILD accepts them")
    parser.add_argument("--only", default="", help="faults whose file and name have this text")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 2)
    parser.add_argument("--again", action="store_true", help="start over")
    parser.add_argument("--unnoticed", action="store_true", help="only what the last call did not notice, though sources have changed since")
    parser.add_argument("--limit", type=float, default=60, help="CPU time of the tests for one fault, s")
    parser.add_argument("--seconds", type=float, default=math.inf, help="no new fault after this time; the order is random")
    arguments = parser.parse_args()
    mutants = read_tables()
    if not arguments.build:
        for file in {mutant.file for mutant in mutants}:
            planted(file, [mutant for mutant in mutants if mutant.file == file])
        return print(f"{len(mutants)} faults, each text once in its file") or 0
    if arguments.syntax:
        return 0 if check_syntax(arguments.build, [m for m in mutants if arguments.only in m.key()], arguments.jobs) else 1
    folder = os.path.abspath(os.path.join(arguments.build, "mutants"))
    copy_sources(mutants, folder)
    configure = ["cmake", "-S", folder, "-B", os.path.join(folder, "build"), "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                 "-DCMAKE_C_FLAGS_RELWITHDEBINFO=-O2"]
    subprocess.run(configure, check=True, stdout=subprocess.DEVNULL)
    built, printed = build(folder)
    if not built:
        raise SystemExit(printed[-4000:])
    results = Results(os.path.join(folder, "results.json"), arguments)
    try_all(folder, mutants, results, arguments)
    return 0 if report([m for m in mutants if arguments.only in m.key()], results.known["faults"]) else 1


if __name__ == "__main__":
    sys.exit(main())
