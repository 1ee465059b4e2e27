#!/usr/bin/env python3
"""walk.py [STEP [KEY=VALUE ...]]: one implicit step as it is read.

Each function of src/ is read where the step first calls it. A return is a function in a room (a folder of src/) that
was left before: its reader goes back there. Functions of headers count with their caller. The program is built in
build-walk without optimisation, so that nothing is inlined; a small library notes the order of the calls.
"""
import os
import pathlib
import subprocess
import sys

TRACER = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#define PLAIN __attribute__((no_instrument_function))
static char *base, *begins;
static long before, depth;
static FILE *out;
static char buffer[1 << 16];
PLAIN void __cyg_profile_func_enter(void *f, void *from) {
  (void)from;
  if (!base) {
    Dl_info at;
    dladdr(f, &at);
    base = at.dli_fbase;
    begins = base + strtol(getenv("WALK_FROM"), NULL, 16);
    before = strtol(getenv("WALK_STEP"), NULL, 10);
    out = fopen(getenv("WALK_OUT"), "w");
    setvbuf(out, buffer, _IOFBF, sizeof buffer); /* the program has its own malloc */
  }
  if (depth > 0 || (f == begins && before-- == 1)) depth++;
  if (depth > 0) fprintf(out, "%lx\n", (long)((char *)f - base));
}
PLAIN void __cyg_profile_func_exit(void *f, void *from) {
  (void)f, (void)from;
  if (depth > 0 && --depth == 0) fflush(out);
}
"""
FLAGS = "-O0 -g1 -finstrument-functions"
SCENARIO = ["actuate", "--no-plots", "--set", "output.errors=false", "--set", "solver.end_time=0.002"]


def run(*words, **more):
    return subprocess.run(words, check=True, capture_output=True, text=True, **more).stdout


def build(root):
    folder = root / "build-walk"
    run("cmake", "-S", str(root), "-B", str(folder), "-DCMAKE_BUILD_TYPE=None", "-DCMAKE_C_FLAGS=" + FLAGS)
    run("cmake", "--build", str(folder), "-j2", "--target", "zipact_command")
    (folder / "tracer.c").write_text(TRACER)
    run("cc", "-O1", "-shared", "-fPIC", str(folder / "tracer.c"), "-o", str(folder / "tracer.so"))
    return folder


def calls(folder, step, keys):
    """Functions of the step in the order of their first call: (name, file below src)."""
    program, out = folder / "zipact", folder / "calls"
    begin = next(line.split()[0] for line in run("nm", str(program)).splitlines() if line.endswith(" zp_sim_advance"))
    work = folder / "work"
    work.mkdir(exist_ok=True)
    run(str(program), *SCENARIO, *[word for key in keys for word in ("--set", key)], cwd=work,
        env={**os.environ, "LD_PRELOAD": str(folder / "tracer.so"), "WALK_STEP": str(step), "WALK_OUT": str(out),
             "WALK_FROM": begin})
    addresses = list(dict.fromkeys(out.read_text().split()))
    found = run("addr2line", "-f", "-e", str(program), *addresses).splitlines()
    for name, place in zip(found[::2], found[1::2]):
        path = place.split(":")[0].rpartition("/src/")[2]
        if path.endswith(".c"):
            yield name.split(".")[0], path


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    step = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    functions = list(dict.fromkeys(calls(build(root), step, sys.argv[2:])))
    seen, room, returns = set(), None, 0
    for name, path in functions:
        now = path.split("/")[0]
        back = now != room and now in seen
        returns += back
        print(f"{'back' if back else '':5}{path:32}{name}")
        seen.add(now)
        room = now
    print(f"{len(functions)} functions, {len(seen)} rooms, {returns} returns to rooms already left")


if __name__ == "__main__":
    main()
