#!/usr/bin/env python3
"""The binary interface:  python3 tests/test_interface.py REPO BUILD SCRATCH

The shared libraries export what the headers mark ZP_API and nothing else, under the SOVERSION that the headers say. A
program that was compiled with headers of other keys gets a sentence, no shifted keys, and nothing of it is written over.
"""

import pathlib
import re
import shutil
import subprocess
import sys

REPO, BUILD, SCRATCH = (pathlib.Path(name).resolve() for name in sys.argv[1:4])
LIBRARIES = [BUILD / "libzipact.so", BUILD / "libzipact-io.so"]
passed = failed = 0


def check(ok, what):
    global passed, failed
    passed += bool(ok)
    failed += not ok
    if not ok:
        print("FAILED: " + what)


def run(*command, **more):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, **more)


def declarations():
    """(header, is it marked?, name) of each function that a public header declares."""
    for header in sorted((REPO / "include/zipact").glob("*.h")):
        text = re.sub(r"/\*.*?\*/", "", header.read_text(encoding="utf-8"), flags=re.S)
        for found in re.finditer(r"^(ZP_API )?(?!typedef|static|return)\w[\w\s*]*?\b(zp_\w+)\([^;{}]*\)\s*(?:ZP_PRINTF\([^)]*\))?;", text, re.M):
            yield header.name, bool(found.group(1)), found.group(2)


def exported(library):
    lines = run("nm", "-D", "--defined-only", library).stdout.splitlines()
    return {line.split()[-1] for line in lines if line.split()[-2] in "TWBDRi"}


def test_exports():
    declared = list(declarations())
    for header, marked, name in declared:
        check(marked, "%s: %s is not marked ZP_API" % (header, name))
    marked = {name for _, _, name in declared}
    check(len(marked) > 80, "only %d functions found: is their form still known here?" % len(marked))
    both = [exported(library) for library in LIBRARIES]
    for library, names in zip(LIBRARIES, both):
        print("%s exports %d symbols" % (library.name, len(names)))
        check(names <= marked, "%s exports %s" % (library.name, ", ".join(sorted(names - marked))))
    missing = marked - both[0] - both[1]
    check(not missing, "not exported: %s" % ", ".join(sorted(missing)))
    check(not both[0] & both[1], "exported twice: %s" % ", ".join(sorted(both[0] & both[1])))
    abi = re.search(r"#define ZP_ABI (\d+)", (REPO / "include/zipact/version.h").read_text(encoding="utf-8")).group(1)
    for library in LIBRARIES:
        check("soname: [%s.%s]" % (library.name, abi) in run("readelf", "-d", library, env={"LC_ALL": "C", "PATH": "/usr/bin:/bin"}).stdout,
              "%s has another SOVERSION than ZP_ABI %s" % (library.name, abi))


# Whatever takes a Def, and canaries beyond one. Prints a line for each call: status and message.
PROGRAM = r"""
#include <math.h>
#include <stdio.h>
#include <zipact/calibrate.h>
#include <zipact/io.h>
#include <zipact/zipact.h>

static void say(const char *call, ZpStatus status, ZpError *err) {
  printf("%s: %d %s\n", call, (int)status, status ? err->message : "");
}

int main(void) {
  static struct { ZpActuatorDef def; unsigned char beyond[4096]; } guarded;
  ZpError err = {ZP_OK, ""};
  ZpModel *model = NULL;
  ZpResult *result = NULL;
  memset(guarded.beyond, 0x5A, sizeof guarded.beyond);
  ZpScenario *scenario = zp_scenario_create();
  say("zp_def_resolve", zp_def_resolve(&guarded.def, NULL, 0, &err), &err);
  say("zp_scenario_def", zp_scenario_def(scenario, 0, &guarded.def, &err), &err);
  guarded.def = zp_actuator_def_default();
  guarded.def.mesh.nodes = 7;
  guarded.def.solver.end_time = 1e-4;
  say("zp_def_set", zp_def_set(&guarded.def, zp_key_find("load.mass"), 0.01, &err), &err);
  say("zp_def_set_text", zp_def_set_text(&guarded.def, zp_key_find("data.file"), "", &err), &err);
  say("zp_def_check", zp_def_check(&guarded.def, &err), &err);
  say("zp_def_check_motion", zp_def_check_motion(&guarded.def, &err), &err);
  say("zp_def_check_voltage", zp_def_check_voltage(&guarded.def, 1, &err), &err);
  say("zp_model_create", zp_model_create(&guarded.def, &model, &err), &err);
  say("zp_study_check", zp_study_check(ZP_STUDY_ACTUATE, &guarded.def, &err), &err);
  say("zp_study_run", zp_study_run(ZP_STUDY_STATIONARY, &guarded.def, NULL, NULL, &result, &err), &err);
  zp_result_destroy(result);
  say("zp_data_study_run", zp_data_study_run(ZP_STUDY_STATIONARY, &guarded.def, NULL, &result, &err), &err);
  zp_result_destroy(result);
  printf("zp_def_get: %d\n", isnan(zp_def_get(&guarded.def, zp_key_find("load.mass"))) ? 2 : 0);
  printf("zp_def_text: %d\n", zp_def_text(&guarded.def, zp_key_find("data.file")) ? 0 : 2);
  printf("zp_def_liquid: %d\n", zp_def_liquid(&guarded.def) == ZP_LIQUID_BEAD ? 0 : 2);
  size_t changed = 0;
  for (size_t i = 0; i < sizeof guarded.beyond; i++)
    changed += guarded.beyond[i] != 0x5A;
  printf("beyond: %zu\nversion: %s\n", changed, zp_version());
  zp_model_destroy(model);
  zp_scenario_destroy(scenario);
  return 0;
}
"""


def program(name, change):
    """Compile PROGRAM with headers on which `change` (file, pattern, by) was made, and run it."""
    folder = SCRATCH / name
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(REPO / "include", folder / "include")
    if change:
        path, pattern, by = change
        text = (folder / "include/zipact" / path).read_text(encoding="utf-8")
        text, count = re.subn(pattern, by, text, count=1, flags=re.M)
        check(count == 1, "%s: %s not found in %s" % (name, pattern, path))
        (folder / "include/zipact" / path).write_text(text, encoding="utf-8")
    (folder / "program.c").write_text(PROGRAM, encoding="utf-8")
    flags = re.search(r"^ZIPACT_SANITIZE:STRING=(.+)$", (BUILD / "CMakeCache.txt").read_text(encoding="utf-8"), re.M)
    done = run("cc", "-std=c17", "-Wall", "-Wextra", "-Werror", *(["-fsanitize=" + flags.group(1)] if flags else []), "-I", folder / "include",
               "-o", folder / "program", folder / "program.c", "-L", BUILD, "-lzipact-io", "-lzipact", "-lm", "-Wl,-rpath," + str(BUILD))
    check(done.returncode == 0, "%s does not compile: %s" % (name, done.stderr))
    done = run(folder / "program")
    check(done.returncode == 0, "%s ends with %s" % (name, done.returncode))
    return dict(line.split(": ", 1) for line in done.stdout.splitlines())


def test_same_headers():
    says = program("same", None)
    version = re.search(r'#define ZP_VERSION "(.*)"', (REPO / "include/zipact/version.h").read_text(encoding="utf-8")).group(1)
    check(says.pop("version") == version, "zp_version is another than ZP_VERSION")
    for call, answer in says.items():
        check(answer.split()[0] == "0", "with its own headers, %s: %s" % (call, answer))


def test_other_headers():
    others = {
        "key_removed": ("keys.def", r"^ZP_REAL\(ribbon\., width,.*\n", ""),
        "key_added": ("keys.def", r"^(ZP_REAL\(ribbon\., width,.*\n)", r'\1ZP_REAL(ribbon., depth, "m", "mm", 1, 0, 2, "new")\n'),
        "last_key_removed": ("keys.def", r"^ZP_\w+\(\w+\., \w+, [^\n]*\n(?=ZP_GROUP_END\(\w+\)\s*#undef)", ""),
        "key_renamed": ("keys.def", r"^ZP_REAL\(ribbon\., width,", "ZP_REAL(ribbon., depth,"),
        "keys_exchanged": ("keys.def", r"^(ZP_REAL\(ribbon\., length,.*\n)(ZP_REAL\(ribbon\., width,.*\n)", r"\2\1"),
        "type_changed": ("keys.def", r"^ZP_INT\(mesh\., nodes, (\w+), (\w+), (\w+),", r'ZP_REAL(mesh., nodes, "1", "", \1, \2, \3,'),
        "word_removed": ("choices.def", r"^ZP_CHOICE\(ZP_CONTACT_SEQUENTIAL,.*\n", ""),
        "older_interface": ("version.h", r"#define ZP_ABI \d+", "#define ZP_ABI 0"),
    }
    for name, change in others.items():
        says = program(name, change)
        check(says.pop("beyond") == "0", name + ": writes beyond the program's ZpActuatorDef")
        del says["version"]
        for call, answer in says.items():
            check(answer.split()[0] == "2", "%s: %s takes it: %s" % (name, call, answer))
            quiet = call in ("zp_def_get", "zp_def_text", "zp_def_liquid")
            check(quiet or "compiled with headers of another version" in answer, "%s: %s says %s" % (name, call, answer))


SCRATCH.mkdir(parents=True, exist_ok=True)
test_exports()
test_same_headers()
test_other_headers()
print("%d passed, %d failed" % (passed, failed))
sys.exit(failed > 0)
