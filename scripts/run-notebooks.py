#!/usr/bin/env python3
"""Runs the notebooks of python/notebooks and writes their outputs into them; with --check compares what they print with
what is in them, and writes nothing. Pictures are not compared, but must be there.

    run-notebooks.py [--check] [NOTEBOOK...]

Run it by the Python that has the package: build/python/venv/bin/python after `make python`. Needs nbclient, nbformat and ipykernel.
"""

import difflib
import glob
import json
import os
import resource
import sys
import tempfile

import nbclient
import nbformat

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def use_this_python(folder):
    """A kernel that is this interpreter, whatever kernels are installed. => its name"""
    kernel = os.path.join(folder, "kernels", "zipact")
    os.makedirs(kernel)
    with open(os.path.join(kernel, "kernel.json"), "w", encoding="utf-8") as file:
        argv = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
        json.dump({"argv": argv, "display_name": "zipact", "language": "python"}, file)
    os.environ["JUPYTER_PATH"] = folder
    os.environ["MPLBACKEND"] = "module://matplotlib_inline.backend_inline"  # pictures into the notebook
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # a warning of the debugger, which nobody uses here
    return "zipact"


def run(book, kernel, folder):
    nbclient.NotebookClient(book, timeout=600, kernel_name=kernel, resources={"metadata": {"path": folder}}).execute()
    for cell in book.cells:
        cell.metadata.pop("execution", None)  # times of day


def printed(book):
    """What the cells print, as lines; a picture is a line of its own."""
    lines = []
    for number, cell in enumerate(book.cells):
        for output in cell.get("outputs", []):
            data = output.get("data", {})
            text = "<picture>" if "image/png" in data else output.get("text") or data.get("text/plain", "")
            lines += [f"cell {number}: {line}\n" for line in text.splitlines()]
    return lines


def cpu_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main(arguments):
    check = "--check" in arguments
    paths = [name for name in arguments if name != "--check"] or sorted(glob.glob(f"{ROOT}/python/notebooks/*.ipynb"))
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        kernel = use_this_python(folder)
        for path in paths:
            book, before = nbformat.read(path, 4), cpu_seconds()
            committed = printed(book)
            run(book, kernel, folder)
            print(f"{os.path.basename(path)}: {cpu_seconds() - before:.1f} s of CPU")
            if not check:
                nbformat.write(book, path)
            elif printed(book) != committed:
                failed += 1
                sys.stdout.writelines(difflib.unified_diff(committed, printed(book), "committed", "now", n=0))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
