#!/usr/bin/env python3
"""Every binary of an FMU computes the same bits: that in it, one that a C99 compiler makes of its sources, and that for
Windows, in wine.   test_fmu_builds.py ZIPACT REPO FOLDER

The Windows part runs where `make fmu` has built that binary and mingw-w64 and wine are there. Also: the XML files are
those of the standard's schemas, and what builds from sources calls nothing that opens files, makes threads or ends a
process.
"""

import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
import zipfile

FLAGS = ["-std=c99", "-O1", "-ffp-contract=off", "-fopenmp-simd", "-Wall", "-Wextra", "-Werror"]
# Names of the C library that the sources may ask for; _-names are the compiler's.
MAY_ASK = {"calloc", "malloc", "free", "aligned_alloc", "memcmp", "memcpy", "memmove", "memset", "memchr", "strcmp", "strlen", "strncmp", "strchr", "strstr",
           "strrchr", "strcspn", "strspn", "snprintf", "vsnprintf", "strtod", "strtol", "qsort", "sqrt", "floor", "ceil", "round", "fmod", "ldexp",
           "frexp", "log10", "rint", "nearbyint", "trunc", "fmax", "fmin", "modf", "scalbn", "lround", "copysign", "remainder", "nextafter"}


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, **options)
    assert done.returncode == 0, "%s: %s%s" % (" ".join(command[:6]), done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def make_fmu(zipact, folder, version):
    path = os.path.join(folder, "arm%d.fmu" % version)
    run(zipact, "fmu", "--fmi", str(version), "--quiet", "-o", path, "--set", "mesh.nodes=13", "--set", "liquid.model=bead", "--set",
        "solver.end_time=5ms")
    inside = os.path.join(folder, "arm%d" % version)
    zipfile.ZipFile(path).extractall(inside)
    return inside


def check_schemas(repo, inside, version):
    def validate(schema, name):
        run("xmllint", "--noout", "--schema", os.path.join(repo, "tests", "fmi", schema), os.path.join(inside, name))

    validate("fmi%dModelDescription.xsd" % version, "modelDescription.xml")
    if version == 3:
        validate("fmi3BuildDescription.xsd", "sources/buildDescription.xml")
        run("xmllint", "--noout", os.path.join(inside, "terminalsAndIcons", "terminalsAndIcons.xml"))


def sources_of(inside, version):
    """The files that the XML names: all .c files there are."""
    if version == 3:
        tree = ET.parse(os.path.join(inside, "sources", "buildDescription.xml"))
        named = [node.get("name") for node in tree.iter("SourceFile")]
    else:
        tree = ET.parse(os.path.join(inside, "modelDescription.xml"))
        named = [node.get("name") for node in tree.iter("File")]
    there = [os.path.relpath(os.path.join(at, name), os.path.join(inside, "sources"))
             for at, _, names in os.walk(os.path.join(inside, "sources")) for name in names if name.endswith(".c")]
    assert sorted(named) == sorted(there), set(named) ^ set(there)
    return named


def build_sources(inside, version, flags=FLAGS, name="built.so"):
    library = os.path.join(inside, name)
    folder = os.path.join(inside, "sources")
    run("cc", *flags, "-fPIC", "-shared", "-fvisibility=hidden", "-I.", *sources_of(inside, version), "-o", library, "-lm",
        "-Wl,--no-undefined", cwd=folder)
    return library


def check_calls(library):
    asked = {line.split()[-1].split("@")[0] for line in run("nm", "-D", "--undefined-only", library).splitlines()}
    other = {name for name in asked if not name.startswith("_")} - MAY_ASK
    assert not other, "the sources ask for %s" % " ".join(sorted(other))


def references(inside):
    tree = ET.parse(os.path.join(inside, "modelDescription.xml")).getroot()
    return tree.get("instantiationToken"), [node.get("valueReference") for node in tree.iter("Float64") if node.get("causality") == "output"]


def outputs(host, library, inside):
    token, names = references(inside)
    rows = run(*host, library, token, "20", "1e-3", *names).splitlines()
    assert len(rows) == 20 and len(rows[0].split()) == len(names)
    return [[float.fromhex(cell).hex() if not re.match("-?nan", cell) else "nan" for cell in row.split()] for row in rows]


def check_tolerance(inside):
    """expected.csv says how far other builds may be."""
    with open(os.path.join(inside, "documentation", "expected.csv")) as file:
        last = file.readlines()[-1]
    assert re.match("# tolerance: 1e-3 of the largest value of each column", last), last


def build_host(repo, compiler, path, *libraries):
    run(compiler, "-O1", "-I" + os.path.join(repo, "src"), os.path.join(repo, "tests", "fmu_host.c"), "-o", path, *libraries)
    return path


def main():
    zipact, repo, folder = map(os.path.abspath, sys.argv[1:])
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    inside = {version: make_fmu(zipact, folder, version) for version in (2, 3)}
    for version in inside:
        check_schemas(repo, inside[version], version)
        sources_of(inside[version], version)
    host = [build_host(repo, "cc", os.path.join(folder, "host"), "-ldl")]
    machine = os.uname().machine
    expected = outputs(host, os.path.join(inside[3], "binaries", machine + "-linux", "zipact.so"), inside[3])
    built = build_sources(inside[3], 3)
    check_calls(built)
    assert outputs(host, built, inside[3]) == expected, "what is built from the sources computes other numbers"
    plain = build_sources(inside[2], 2, ["-O2"], "plain.so")  # where gcc contracts, unless it is told not to
    found = outputs(host, plain, inside[3])
    assert found == expected, "what is built from the sources without special flags computes other numbers"
    print("sources, also without special flags: the same bits as the binary")
    check_tolerance(inside[3])
    dll = os.path.join(inside[3], "binaries", "x86_64-windows", "zipact.dll")
    wine = shutil.which("wine64") or shutil.which("wine") or "/usr/lib/wine/wine64"
    if not os.path.exists(dll) or not os.path.exists(wine) or not shutil.which("x86_64-w64-mingw32-gcc"):
        print("no binary for Windows, or no mingw-w64 and wine to try it with")
        return
    os.environ.update(WINEPREFIX=os.path.join(folder, "wine"), WINEDEBUG="-all", DISPLAY="")
    windows = [wine, build_host(repo, "x86_64-w64-mingw32-gcc", os.path.join(folder, "host.exe"))]
    assert outputs(windows, dll, inside[3]) == expected, "the binary for Windows computes other numbers"
    print("Windows: the same bits")


if __name__ == "__main__":
    main()
