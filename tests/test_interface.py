#!/usr/bin/env python3
"""The binary interface:  python3 tests/test_interface.py REPO BUILD SCRATCH [grown | keep]

The shared libraries export what the headers mark ZP_API and nothing else, under the SOVERSION that the headers say. A
program that was compiled when this SOVERSION began runs with them: tests/abi keeps its source and the headers of that
time (a binary would be of one machine). With `grown` it also runs, without another compilation, with a library that has
more keys, words, signals and outcomes; this compiles the core. `keep` replaces the kept headers by those of today, which is
allowed only until a release has this interface.
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


KEPT = REPO / "tests/abi"
HEADERS = "".join("#include <zipact/%s.h>\n" % name for name in ("zipact", "io", "batch", "calibrate", "campaign", "optimize", "fmu"))


def keep():
    """Replace abi-2.h by the headers of today. This is allowed only until a release has this interface."""
    (SCRATCH / "all.c").write_text(HEADERS, encoding="utf-8")
    lines, ours = [], False
    for line in run("cc", "-E", "-I", REPO / "include", SCRATCH / "all.c").stdout.splitlines():
        if line.startswith("# "):
            ours = "zipact/" in line
        elif ours and line.strip():
            lines.append(re.sub(r'__attribute__ ?\(\((visibility\("default"\)|format\([^()]*\))\)\) ?', "", line.rstrip()))
    head = re.match(r".*?\*/\n(#include[^\n]*\n)*", (KEPT / "abi-2.h").read_text(encoding="utf-8"), re.S).group(0)
    (KEPT / "abi-2.h").write_text(head + "\n" + "\n".join(lines) + "\n", encoding="utf-8")
    run("clang-format", "-i", KEPT / "abi-2.h")


def kept_names():
    """What abi-2.h declares: functions, enumerators, structs."""
    text = (KEPT / "abi-2.h").read_text(encoding="utf-8")
    functions = re.findall(r"\b(zp_\w+)\(", text)
    enumerators = [name for inside in re.findall(r"enum \w+ \{(.*?)\}", text, re.S) for name in re.findall(r"\b(ZP_\w+)", inside)]
    structs = re.findall(r"^\} (Zp\w+);", re.sub(r"typedef enum.*?\} \w+;", "", text, flags=re.S), re.M)
    return functions, enumerators, structs, text


def fields_of(name, text):
    """Names of the members of a struct."""
    inside = re.search(r"typedef struct %s \{(.*?)\n\} %s;" % (name, name), text, re.S).group(1)
    inside = re.sub(r"\(\*(\w+)\)\([^;]*\)", r"\1", inside)  # pointers to functions
    pieces = [piece for line in inside.split(";") for piece in line.split(",") if piece.strip()]
    return [re.findall(r"\w+", re.sub(r"\[.*?\]", "", piece))[-1] for piece in pieces]


def built(folder, source, *more):
    folder.mkdir(parents=True, exist_ok=True)
    flags = re.search(r"^ZIPACT_SANITIZE:STRING=(.+)$", (BUILD / "CMakeCache.txt").read_text(encoding="utf-8"), re.M)
    done = run("cc", "-std=c17", "-Wall", "-Wextra", "-Werror", *(["-fsanitize=" + flags.group(1)] if flags else []), "-o", folder / "program", source, *more)
    check(done.returncode == 0, "%s does not compile: %s" % (source, done.stderr[:2000]))
    return folder / "program"


def layout(folder, headers, enumerators, structs, text):
    """(name, number) of each size, place and enumerator that a program has compiled in."""
    asks = ['  printf("%s %%lld\\n", (long long)%s);' % (name, name) for name in enumerators if not name.endswith("_COUNT")]
    for name in structs:
        asks.append('  printf("sizeof %s %%zu\\n", sizeof(%s));' % (name, name))
        asks += ['  printf("%s.%s %%zu\\n", offsetof(%s, %s));' % (name, field, name, field) for field in fields_of(name, text)]
    folder.mkdir(parents=True, exist_ok=True)
    source = folder / "layout.c"
    source.write_text("%s\n#include <stddef.h>\n#include <stdio.h>\nint main(void) {\n%s\n  return 0;\n}\n" % (headers, "\n".join(asks)), encoding="utf-8")
    return run(built(folder, source, "-I", REPO / "include", "-I", KEPT)).stdout.splitlines()


def test_nothing_moved():
    """Sizes of structs, places of their members and numbers of words are those of the beginning of the interface."""
    functions, enumerators, structs, text = kept_names()
    check(len(functions) > 120 and len(enumerators) > 120 and len(structs) > 20, "abi-2.h: is its form still known here?")
    gone = set(functions) - exported(LIBRARIES[0]) - exported(LIBRARIES[1])
    check(not gone, "no longer exported: " + ", ".join(sorted(gone)))
    kept = layout(SCRATCH / "kept", '#include "abi-2.h"', enumerators, structs, text)
    now = layout(SCRATCH / "now", HEADERS, enumerators, structs, text)
    check(len(kept) > 250, "only %d numbers" % len(kept))
    for before, after in zip(kept, now):
        check(before == after, "a program has %s, the headers say %s" % (before, after))


def test_headers_show_no_struct_that_grows():
    text = "".join(path.read_text(encoding="utf-8") for path in (REPO / "include/zipact").glob("*.h"))
    for name in ("ZpActuatorDef", "ZpResult", "ZpRunInfo", "ZpTable", "ZpShapes", "ZpModel", "ZpSim", "ZpScenario"):
        check(re.search(r"^typedef struct %s %s;" % (name, name), text, re.M), name + " is not opaque")
        check(not re.search(r"^(typedef )?struct %s \{" % name, text, re.M), name + " shows its members")


def test_older_program():
    """A program of the beginning of the interface runs with this library."""
    program = built(SCRATCH / "older", KEPT / "program.c", "-DWITH_FILES", "-L", BUILD, "-lzipact-io", "-lzipact", "-lm", "-Wl,-rpath," + str(BUILD))
    done = run(program)
    check(done.returncode == 0 and done.stdout, "the older program: %s" % done.stdout)
    return done.stdout


# What a later library may have: (file, pattern, by).
GROWTH = (
    ("src/def/keys.def", r"^(ZP_BOOL\(ribbon\., plasticity,.*\n)", r'\1ZP_REAL(ribbon., depth, "m", "mm", 1, 0, 2, "new")\nZP_TEXT(ribbon., name, "", "new")\n'),
    ("include/zipact/choices.def", r"^(ZP_CHOICES_END\(ZpContactModel\))", r'ZP_CHOICE(ZP_CONTACT_NEW, "new", "new")\n\1'),
    ("src/base/signals.def", r"^(ZP_SIGNAL\(stroke,.*\n)", r'ZP_SIGNAL(newest, "1", "", "new")\n\1'),
    ("include/zipact/sim.h", r"^(\} ZpOutcome;)", r"  , ZP_NEWEST\n\1"),
    ("src/run/info.h", r"^(struct ZpRunInfo \{\n)", r"\1  double newest;\n"),
    ("src/study/result.h", r"^(struct ZpResult \{\n)", r"\1  double newest;\n"),
)


def test_grown_library():
    """The same program, not compiled again, runs with a library that has more keys, words, signals and outcomes."""
    grown = SCRATCH / "grown"
    shutil.rmtree(grown, ignore_errors=True)
    rooms = re.search(r"GLOB core_sources CONFIGURE_DEPENDS (.*?)\)", (REPO / "CMakeLists.txt").read_text(encoding="utf-8"), re.S).group(1)
    for folder in ("include", "src"):
        shutil.copytree(REPO / folder, grown / folder)
    for path, pattern, by in GROWTH:
        text, count = re.subn(pattern, by, (grown / path).read_text(encoding="utf-8"), count=1, flags=re.M)
        check(count == 1, "%s not found in %s" % (pattern, path))
        (grown / path).write_text(text, encoding="utf-8")
    sources = [path for room in rooms.split() for path in sorted(grown.glob(room))]
    (grown / "lib").mkdir()
    objects = [grown / "lib" / ("%d.o" % number) for number in range(len(sources))]
    for source, object_ in zip(sources, objects):
        done = run("cc", "-std=c17", "-O1", "-ffp-contract=off", "-fPIC", "-fvisibility=hidden", "-I", grown / "include", "-I", grown / "src", "-c", source, "-o", object_)
        check(done.returncode == 0, "the grown library does not compile: %s" % done.stderr[:2000])
        if done.returncode:
            return
    done = run("cc", "-shared", "-Wl,-soname,libzipact.so.2", "-o", grown / "lib/libzipact.so.2", *objects, "-lm")
    check(done.returncode == 0, "the grown library does not link: %s" % done.stderr[:2000])
    program = built(SCRATCH / "core", KEPT / "program.c", "-L", BUILD, "-lzipact", "-lm")
    said = [run(program, env={"LD_LIBRARY_PATH": str(folder), "LC_ALL": "C"}) for folder in (BUILD, grown / "lib")]
    for name, done in zip(("this", "the grown"), said):
        check(done.returncode == 0 and done.stdout, "with %s library: %s%s" % (name, done.stdout, done.stderr))
    check(said[0].stdout == said[1].stdout, "%s became %s" % (said[0].stdout, said[1].stdout))


SCRATCH.mkdir(parents=True, exist_ok=True)
if "keep" in sys.argv:
    keep()
elif "grown" in sys.argv:
    test_grown_library()
else:
    test_exports()
    test_headers_show_no_struct_that_grows()
    test_nothing_moved()
    test_older_program()
print("%d passed, %d failed" % (passed, failed))
sys.exit(failed > 0)
