#!/usr/bin/env python3
"""Adds the reed to a copy of the source of zipact:  python3 examples/extend/reed/add.py TREE

Copies the device, its law and its test to their rooms, and writes the lines that name them into four tables.
"""
import pathlib
import re
import shutil
import sys

HERE = pathlib.Path(__file__).resolve().parent
FILES = {"reed.c": "src/device/reed.c", "term_reed.c": "src/term/reed.c", "test_reed.c": "tests/test_reed.c", "reed.yaml": "examples/reed.yaml"}
LINES = (  # a table, the lines, after the last line that begins with these words
    ("include/zipact/devices.def", 'ZP_KIND(ZP_KIND_REED, reed, "a reed: one ribbon clamped below a flat electrode, its free end on a return spring")\n', "ZP_KIND("),
    ("src/term/terms.def", "ZP_TERM(reed) ZP_ROW(reed_energy)\n", "ZP_TERM("),
    ("src/def/keys.def", 'ZP_GROUP(reed)\nZP_REAL(reed., stiffness, "N/m", "N/m", 0, 0, 1e6, "kind reed: stiffness of the return spring at the right end (0: there is none)")\nZP_GROUP_END(reed)\n\n', "ZP_GROUP_END(hinge)"),
    ("tests/test_stiffness.c", '    {"reed", SET(SOFT, {"actuator.kind", ZP_KIND_REED}, {"electro.gap_offset", 2e-4}, {"reed.stiffness", 5}), 1e-4, 1e3, false},\n', '    {"flange", SET('),
)


def add_lines(path, lines, after):
    text = path.read_text(encoding="utf-8")
    if lines.rstrip("\n") in text:  # an earlier call added them
        return
    end = [found.end() for found in re.finditer("^%s.*\n" % re.escape(after), text, re.M)][-1]
    path.write_text(text[:end] + ("\n" if lines.startswith("ZP_GROUP") else "") + lines.rstrip("\n") + "\n" + text[end:], encoding="utf-8")


def add(tree):
    for name, place in FILES.items():
        shutil.copy(HERE / name, tree / place)
    for name, lines, after in LINES:
        add_lines(tree / name, lines, after)


if __name__ == "__main__":
    add(pathlib.Path(sys.argv[1]))
