#!/usr/bin/env python3
"""A law is one file, and so is a device:  python3 tests/law_is_one_file.py REPO FOLDER [--quick]

Copies what the command is built from to FOLDER/tree, adds law/damper.c to its src/term/ with one line of keys.def and
one of terms.def, adds the device of examples/extend/reed as docs/extending.md says, and builds. Then the keys, the
columns and the numbers of both stand in all that users read, and tests/test_law.c and the device's test pass with what
is in the library. Without one of the lines it does not compile, or a rule fails. The last line is "N passed, N failed".

With --quick it builds nothing: the files of both compile, and docs/extending.md shows the reed as its files are.
"""

import json
import os
import re
import shutil
import subprocess
import sys

KEY = 'ZP_REAL(load., damping, "N s/m", "N s/m", 0, 0, 1e6, "coefficient of a damper beside the load, which grows while it works")\n'
LAW = "ZP_TERM(damper) ZP_ROW(damper_loss) ZP_ROW(damper_coefficient)\n"
COLUMNS = ["damper_loss_J", "damper_coefficient_N_s_per_m"]

repo, folder = map(os.path.abspath, sys.argv[1:3])
tree, build = folder + "/tree", folder + "/build"
results = []


def check(ok, what):
    results.append(bool(ok))
    if not ok:
        print("FAILED: " + what)


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    return done.returncode, done.stdout + done.stderr


def must(*command):
    status, text = run(*command)
    if status:
        sys.exit("%s\n%s" % (" ".join(command), text[-3000:]))
    return text


def add_line(name, line, after):
    """Put a line after the one that begins with `after`."""
    path = os.path.join(tree, name)
    text = open(path).read()
    found = re.search("^%s.*\n" % re.escape(after), text, re.M)
    open(path, "w").write(text[: found.end()] + line + text[found.end() :])


def remove(name, text, other=""):
    path = os.path.join(tree, name)
    old = open(path).read()
    assert old.count(text) == 1, (name, text)
    open(path, "w").write(old.replace(text, other))
    return lambda: open(path, "w").write(old)


def copy():
    shutil.rmtree(tree, ignore_errors=True)
    for name in ("src", "include", "cli", "reproduce", "plots", "scripts", "docs", "tests", "windows", "web", "bench", "examples"):
        shutil.copytree(os.path.join(repo, name), os.path.join(tree, name))
    for name in ("CMakeLists.txt", "LICENSE", "README.md"):
        shutil.copy(os.path.join(repo, name), tree)
    shutil.copy(tree + "/tests/law/damper.c", tree + "/src/term/damper.c")
    add_line("src/def/keys.def", KEY, "ZP_REAL(load., stop_stiffness,")
    add_line("src/term/terms.def", LAW, "ZP_TERM(drag)")
    must(sys.executable, tree + "/examples/extend/reed/add.py", tree)


def make():
    must("cmake", "-S", tree, "-B", build, "-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_C_FLAGS_DEBUG=-O0", "-DZIPACT_TESTS=OFF", "-DZIPACT_WERROR=ON")
    must("cmake", "--build", build, "-j2", "--target", "zipact_command")


def users_see_it():
    """The key, the columns and the numbers, wherever a user looks."""
    command = build + "/zipact"
    key = [k for k in json.loads(must(command, "keys", "--json")) if k["key"] == "load.damping"]
    check(len(key) == 1 and key[0]["unit"] == "N s/m", "`zipact keys` has load.damping")
    check('"damping"' in must(command, "schema"), "the schema has load.damping")
    page = must("sh", tree + "/scripts/make-keys-page.sh", command)
    page += open(tree + "/docs/keys.md").read()
    for word in ["`load.damping`"] + ["`%s`" % column for column in COLUMNS]:
        check(word in page, "docs/keys.md has %s" % word)
    out = folder + "/out"
    must(command, "actuate", "--set", "load.damping=0.3 N s/m", "--set", "mesh.nodes=11", "--out", out)
    summary = json.load(open(out + "/summary.json"))
    header = open(out + "/table.csv").readline().strip().split(",")
    stored = open(out + "/results.h5", "rb").read()
    for column in COLUMNS:
        check(summary.get(column, 0) > 0, "summary.json has %s" % column)
        check(column in header, "table.csv has %s" % column)
        check(column.encode() in stored, "results.h5 has %s" % column)
    check(summary.get("energy_error", 1) < 1e-7, "energy error %s" % summary.get("energy_error"))
    must(command, "actuate", "--set", "mesh.nodes=11", "--set", "solver.end_time=1 ms", "--out", out)
    check(not set(COLUMNS) & set(json.load(open(out + "/summary.json"))), "without the law the summary does not have it")
    status, text = run(command, "actuate", "--set", "load.damping=1", "--set", "platform.rotates=true", "--set", "actuator.symmetry=none",
                       "--set", "platform.electrode=false", "--set", "liquid.model=none", "--out", out)
    check(status != 0 and "level platforms only" in text, "the law refuses what it does not know")


def device_works():
    """The device of docs/extending.md: its word, its key, its picture, its energy."""
    command = build + "/zipact"
    keys = {k["key"]: k for k in json.loads(must(command, "keys", "--json"))}
    check("reed.stiffness" in keys and "reed" in json.dumps(keys["actuator.kind"]), "`zipact keys` has the reed")
    page = open(tree + "/docs/keys.md").read()
    check("`reed.stiffness`" in page and "`reed_energy_J`" in page, "docs/keys.md has the reed")
    out = folder + "/reed"
    must(command, "run", tree + "/examples/reed.yaml", "--set", "mesh.nodes=21", "--out", out)
    summary = json.load(open(out + "/summary.json"))
    check(0 < summary["release_voltage_V"] < summary["pull_in_voltage_V"] < 200, "the reed closes and opens again")
    check(os.path.getsize(out + "/plots/shapes.svg") > 1000, "the reed has a picture")


def numbers_hold():
    """The tests of law, device and stiffness with what is in the library."""
    flags = must("pkg-config", "--cflags", "--libs", "check").split()
    for name in ("test_law", "test_reed", "test_stiffness"):
        program = folder + "/" + name
        must("cc", "-std=c17", "-D_GNU_SOURCE", "-DZP_UNCONTRACTED", "-DDAMPER_OF_LIBRARY", "-I" + tree + "/include", "-I" + tree + "/src",
             "-I" + tree + "/tests", tree + "/tests/" + name + ".c", tree + "/tests/suite.c", build + "/libzipact.a", "-lm", "-o", program, *flags)
        status, text = run(program)
        print(text.strip())
        check(status == 0, "tests/%s.c" % name)


def page_is_current():
    """docs/extending.md shows no line of the reed that its files do not have."""
    page = open(tree + "/docs/extending.md").read()
    section = page[page.index("## A device in thirty minutes") : page.index("## What a model looks like")]
    folder_of_reed = tree + "/examples/extend/reed/"
    lines = {line.strip() for name in os.listdir(folder_of_reed) if name.endswith(".c") for line in open(folder_of_reed + name)}
    for name in ("include/zipact/devices.def", "src/def/keys.def", "src/term/terms.def", "tests/test_stiffness.c"):
        lines |= {line.strip() for line in open(os.path.join(tree, name))}
    for listing in re.findall("```c\n(.*?)```", section, re.S):
        for line in listing.splitlines():
            check(line.strip() in lines | {"..."}, "docs/extending.md shows a line that no file of the reed has: " + line)


def all_compile():
    """As files of the library, with no warning."""
    flags = must("pkg-config", "--cflags", "check").split()
    for name in ("src/term/damper.c", "src/device/reed.c", "src/term/reed.c", "tests/test_reed.c", "tests/test_law.c", "tests/test_stiffness.c"):
        status, text = run("cc", "-std=c17", "-D_GNU_SOURCE", "-DDAMPER_OF_LIBRARY", "-Wall", "-Wextra", "-Werror", "-fsyntax-only",
                           "-I" + tree + "/include", "-I" + tree + "/src", "-I" + tree + "/tests", os.path.join(tree, name), *flags)
        check(status == 0, "%s compiles:\n%s" % (name, text))


def compiles(name):
    commands = json.load(open(build + "/compile_commands.json"))
    command = [c for c in commands if c["file"] == os.path.join(tree, name)][0]
    return run("sh", "-c", command["command"] + " -fsyntax-only", cwd=command["directory"])[0] == 0


def nothing_is_forgotten():
    """What is left out is a compile error, or a rule fails."""
    rules = lambda: run(sys.executable, tree + "/tests/rules.py", tree)[1]
    check(not re.search("damper|reed", rules()), "the rules pass with law and device:\n" + "\n".join(l for l in rules().splitlines() if re.search("damper|reed", l)))
    check(compiles("src/term/damper.c") and compiles("src/device/reed.c"), "law and device compile")
    back = remove("include/zipact/devices.def", "ZP_KIND(ZP_KIND_REED,", "// ZP_KIND(ZP_KIND_REED,")
    check(not compiles("src/device/reed.c"), "without its line the device does not compile")
    back()
    back = remove("src/def/keys.def", KEY)
    check(not compiles("src/term/damper.c"), "without its key the law does not compile")
    back()
    for line, fault in ((LAW, "has no line"), (" ZP_ROW(damper_loss)", "damper_loss has no place")):
        back = remove("src/term/terms.def", line, "\n" if line == LAW else "")
        check(fault in rules(), "without %s a rule fails" % line.strip())
        back()
    back = remove("src/term/damper.c", ", [COEFFICIENT] = &zp_row_damper_coefficient")
    check("damper_coefficient" in rules(), "a row that the term does not list fails a rule")
    back()


copy()
page_is_current()
all_compile()
if "--quick" not in sys.argv:
    make()
    users_see_it()
    device_works()
    numbers_hold()
    nothing_is_forgotten()
if all(results):
    shutil.rmtree(tree)  # other tests look at all pages below the repository
print("%d passed, %d failed" % (results.count(True), results.count(False)))
sys.exit(results.count(False) > 0)
