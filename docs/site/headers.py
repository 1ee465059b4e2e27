#!/usr/bin/env python3
"""A public header as Doxygen wants it: our plain comments marked, the tables of keys and words written out.

    docs/site/headers.py HEADER      a filter of docs/site/Doxyfile
"""

import pathlib
import re
import sys

TYPES = {"REAL": "double", "REAL_AUTO": "double", "INT": "int", "BOOL": "bool"}
STRING = r'"((?:[^"\\]|\\.)*)"'


def choices(text, studies):
    """The enumerations of choices.def; the studies have a table of their own."""
    rows = re.findall(r'^ZP_STUDY\((\w+), (\w+), \w+, \w+, (%s)\)$' % STRING, studies, re.M)
    text = re.sub(r"^#define ZP_STUDY.*\n#include.*\n", "".join('ZP_CHOICE(%s, "%s", %s)\n' % row[:3] for row in rows), text, flags=re.M)
    text = re.sub(r"^ZP_CHOICES\((\w+)\)", r"/* Words of a choice key. */\ntypedef enum \1 {", text, flags=re.M)
    text = re.sub(r"^ZP_CHOICES_END\((\w+)\)", r"  \1_COUNT\n} \1;", text, flags=re.M)
    return re.sub(r"^ZP_CHOICE\((\w+), %s, %s\)" % (STRING, STRING), r'  \1, /* "\2": \3 */', text, flags=re.M)


def field(match):
    """A field of the definition from a line of keys.def."""
    kind, arguments = match.groups()
    name, help_line = re.match(r"[\w.]*, (\w+)", arguments).group(1), re.search(STRING + r"$", arguments).group(1)
    unit = re.search(r'^[\w.]*, \w+, "([^"]*)"', arguments) if kind.startswith("REAL") else None
    unit = ", " + unit.group(1) if unit and unit.group(1) != "1" else ""
    type_name = arguments.split(", ")[2] if kind == "ENUM" else TYPES.get(kind, "char")
    return "%s %s%s; /* %s%s */" % (type_name, name, "[ZP_TEXT_SIZE]" if kind == "TEXT" else "", help_line, unit)


def keys(text):
    """The fields of keys.def."""
    text = re.sub(r"^ZP_OF_SCENARIO\(.*\)\n|^#undef .*\n", "", text, flags=re.M)
    text = re.sub(r"^ZP_GROUP\(\w+\)", "struct {", text, flags=re.M)
    text = re.sub(r"^ZP_GROUP_END\((\w+)\)", r"} \1; /* the keys of \1 */", text, flags=re.M)
    return re.sub(r"^ZP_(\w+)\((.*)\)$", field, text, flags=re.M)


def body(path):
    """What a table holds, without the comment at its head."""
    return re.sub(r"^/\*.*?\*/", "", path.read_text(encoding="utf-8"), count=1, flags=re.S)


def main():
    header = pathlib.Path(sys.argv[1])
    text = header.read_text(encoding="utf-8")
    text = re.sub(r"^ZP_API |\s+ZP_PRINTF\([^)]*\)", "", text, flags=re.M)
    if header.name == "def.h":  # the macros that read the tables are nobody's business
        text = re.sub(r"^#define ZP_\w+\((?:[^\n]*\\\n)*[^\n]*\n|^#undef [^\n]*\n", "", text, flags=re.M)
        text = text.replace("#include <zipact/choices.def>", choices(body(header.parent / "choices.def"), body(header.parent / "studies.def")))
        text = text.replace("#include "def/keys.def"", keys(body(header.parent / "keys.def")))
    text = re.sub(r"^/\*", "/** @file\n *", text, count=1)  # the first comment says what the file is,
    text = re.sub(r"^( *)/\* ", r"\1/** ", text, flags=re.M)  # one before a declaration belongs to it,
    text = re.sub(r"^(.*\S) +/\* ", r"\1 /**< ", text, flags=re.M)  # one behind a member to that
    sys.stdout.write(text)


if __name__ == "__main__":
    main()
