#!/usr/bin/env python3
"""A public header as Doxygen wants it: our plain comments marked, the table of words written out.

    docs/site/headers.py HEADER      a filter of docs/site/Doxyfile
"""

import pathlib
import re
import sys

STRING = r'"((?:[^"\\]|\\.)*)"'


def choices(text, studies, devices):
    """The enumerations of choices.def; studies and devices have tables of their own."""
    for macro, rows in (("ZP_STUDY", re.findall(r'^ZP_STUDY\((\w+), (\w+), \w+, \w+, (%s)\)$' % STRING, studies, re.M)),
                        ("ZP_KIND", re.findall(r'^ZP_KIND\((\w+), (\w+), (%s)\)$' % STRING, devices, re.M))):
        text = re.sub(r"^#define %s\(.*\n#include.*\n" % macro, "".join('ZP_CHOICE(%s, "%s", %s)\n' % row[:3] for row in rows), text, flags=re.M)
    text = re.sub(r"^ZP_CHOICES\((\w+)\)", r"/* Words of a choice key. */\ntypedef enum \1 {", text, flags=re.M)
    text = re.sub(r"^ZP_CHOICES_END\((\w+)\)", r"} \1;", text, flags=re.M)
    return re.sub(r"^ZP_CHOICE\((\w+), %s, %s\)" % (STRING, STRING), r'  \1, /* "\2": \3 */', text, flags=re.M)


def body(path):
    """What a table holds, without the comment at its head."""
    return re.sub(r"^/\*.*?\*/", "", path.read_text(encoding="utf-8"), count=1, flags=re.S)


def main():
    header = pathlib.Path(sys.argv[1])
    text = header.read_text(encoding="utf-8")
    text = re.sub(r"^ZP_API |\s+ZP_PRINTF\([^)]*\)", "", text, flags=re.M)
    if header.name == "def.h":  # the macros that read the tables are nobody's business
        text = re.sub(r"^#define ZP_\w+\((?:[^\n]*\\\n)*[^\n]*\n|^#undef [^\n]*\n", "", text, flags=re.M)
        text = text.replace("#include <zipact/choices.def>", choices(*(body(header.parent / name) for name in ("choices.def", "studies.def", "devices.def"))))
    text = re.sub(r"^/\*", "/** @file\n *", text, count=1)  # the first comment says what the file is,
    text = re.sub(r"^( *)/\* ", r"\1/** ", text, flags=re.M)  # one before a declaration belongs to it,
    text = re.sub(r"^(.*\S) +/\* ", r"\1 /**< ", text, flags=re.M)  # one behind a member to that
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
