"""What is built loads no library from the current folder and is hardened.   test_binaries.py [--fortified] FILE|BUILD...

Of a build folder: the command, the shared libraries and the tests. Of each program and library, by readelf: no entry of
RPATH or RUNPATH is empty or relative (the loader would look in the current folder), symbols are bound at the start and
read-only from then on, the stack is not executable and guarded, programs are position independent; with --fortified, calls
into the C library are checked.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

OF_OTHERS = {"CMakeFiles", "python", "octave", "scratch", "docs"}


def readelf(file):
    command = ["readelf", "--wide", "--file-header", "--program-headers", "--dynamic", "--dyn-syms", file]
    environment = {**os.environ, "LC_ALL": "C"}
    return subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout


def is_linked(file):
    """An ELF file that is a program or a shared library, not an object or an archive."""
    with open(file, "rb") as opened:
        header = opened.read(18)
    return header[:4] == b"\x7fELF" and header[16] in (2, 3)


def linked_files(path):
    if path.is_file():
        return [path]
    found = []
    for folder, folders, names in os.walk(path):
        folders[:] = sorted(set(folders) - OF_OTHERS)
        files = [pathlib.Path(folder, name) for name in sorted(names)]
        found += [file for file in files if not file.is_symlink() and is_linked(file)]
    return found


def faults(file, fortified):
    text = readelf(file)
    paths = re.findall(r"\((?:RPATH|RUNPATH)\).*\[(.*)\]", text)
    flags = re.findall(r"\(FLAGS(?:_1)?\) +(?:Flags: )?(.*)", text)
    imports = set(re.findall(r"UND (\w+)", text))
    if any(not entry.startswith(("/", "$ORIGIN")) for entry in ":".join(paths).split(":") if paths):
        yield "looks for libraries in %r" % paths
    if not re.search(r"^ +GNU_RELRO ", text, re.M) or not re.search(r"\b(BIND_NOW|NOW)\b", " ".join(flags)):
        yield "no full RELRO: flags %s" % flags
    if re.search(r"^ +GNU_STACK .* RWE ", text, re.M):
        yield "executable stack"
    if not re.search(r"Type: +DYN ", text):
        yield "not position independent"
    if "__stack_chk_fail" not in imports:
        yield "no stack protector"
    if fortified and not any(re.fullmatch(r"__\w+_chk", name) for name in imports):
        yield "no fortified call"


def starts_beside_fakes(command):
    """The command runs as ever where the current folder has libraries of the names that it needs."""
    needed = re.findall(r"\(NEEDED\).*\[(.*)\]", readelf(command))
    with tempfile.TemporaryDirectory() as folder:
        for name in needed:
            subprocess.run(["cc", "-shared", "-x", "c", "/dev/null", "-o", os.path.join(folder, name)], check=True)
        environment = {key: value for key, value in os.environ.items() if key != "LD_LIBRARY_PATH"}
        run = subprocess.run([command, "--version"], cwd=folder, env=environment, capture_output=True, text=True)
    return bool(needed) and run.returncode == 0 and not run.stderr


def main():
    fortified = sys.argv[1:2] == ["--fortified"]
    files = [file for path in sys.argv[1 + fortified :] for file in linked_files(pathlib.Path(path).resolve())]
    failed = 0
    for file in files:
        found = list(faults(file, fortified))
        if file.name == "zipact" and not starts_beside_fakes(file):
            found.append("loads a library from the current folder")
        failed += bool(found)
        for fault in found:
            print("%s: %s" % (file, fault))
    print("%d passed, %d failed" % (len(files) - failed, failed))
    return failed > 0 or not files


if __name__ == "__main__":
    sys.exit(main())
