#!/usr/bin/env python3
"""docs/materials.md from the table of materials; with --check, says whether the page is up to date.

    make-materials-page.py [--check]
"""

import pathlib
import re
import sys

from keys_table import rows

REPO = pathlib.Path(__file__).resolve().parent.parent
STRING = r'"([^"]*)"'
GROUPS = (
    ("ZP_STRIP", "ribbon", "Strips: `ribbon.material`, `lower.ribbon.material`"),
    ("ZP_INSULATOR", "insulator", "Insulators: `insulator.material`, `lower.insulator.material`"),
    ("ZP_MEDIUM", "medium", "Liquids: `medium.material`"),
)
HEAD = """# Materials

Made by `make docs` from `src/def/materials.def`.

`ribbon.material`, `insulator.material` and `medium.material` name a material of these tables. A material sets those keys of its group that you do not give. A key
that is given in the file or by `--set` keeps its value ([order](interface.md#which-value-counts)), so `--set ribbon.material=brass` does not change a `ribbon.density` in the file.

    ribbon.material: steel_1.4310
    insulator: {material: kapton, thickness: 50 um}
    medium.material: silicone_oil_50cst

The values are those of handbooks and data sheets at 20 to 25 °C; the column "from" names the source. Where it ends in "checked", we compared the value with
that publication in November 2026. The other values are from memory, so look them up before you rely on them. The spread is an estimate of one standard deviation between deliveries.

A material does not set its resistivity, because a resistivity adds [leakage](theory.md#25-leakage-and-interface-charge-insulatorresistivity-mediumresistivity), which not every model has. Copy it from the table if you need it.

## Spreads as tolerances

With `sampling.tolerances: materials` every key that a material sets is drawn from a lognormal distribution. Its median is the value of the table; the standard deviation of its natural logarithm is the spread.
Keys that you give keep their value, or their own [distribution](campaigns.md#tolerances). [examples/materials.yaml](../examples/materials.yaml):

```console
$ zipact run examples/materials.yaml -o out/materials
...
```

![Distribution of the largest load that results from the spreads of the materials](images/materials.svg)
"""


def words():
    """Word and help line of each enumerator."""
    text = (REPO / "include/zipact/choices.def").read_text(encoding="utf-8")
    return {name: (word, told) for name, word, told in re.findall(r"^ZP_CHOICE\((\w+), %s, %s\)" % (STRING, STRING), text, re.M)}


def units():
    """The unit of each key."""
    text = (REPO / "src/def/keys.def").read_text(encoding="utf-8")
    keys = [given for _, kind, given in rows(text) if kind.startswith("REAL")]
    return {given[0] + given[1]: "" if given[2] == '"1"' else " " + given[2].strip('"') for given in keys}


def values(macro):
    """(enumerator, key without group, value, spread, source) of each row."""
    text = (REPO / "src/def/materials.def").read_text(encoding="utf-8")
    return re.findall(r"^%s\((\w+), %s, ([^,]+), ([^,]+), %s\)$" % (macro, STRING, STRING), text, re.M)


def page():
    """The whole page."""
    word, unit = words(), units()
    lines = [HEAD]
    for macro, group, title in GROUPS:
        lines += ["## " + title, "", "| material | key | value | spread | from |", "|---|---|---|---|---|"]
        before = None
        for name, key, value, spread, source in values(macro):
            shown = "`%s`: %s" % word[name] if name != before else ""
            before = name
            lines.append("| %s | `%s` | %g%s | %g %% | %s |" % (shown, key, float(value), unit[group + "." + key], 100 * float(spread), source))
        lines.append("")
    return "\n".join(lines)


def main():
    place = REPO / "docs/materials.md"
    if sys.argv[1:] != ["--check"]:
        place.write_text(page(), encoding="utf-8")
    elif place.read_text(encoding="utf-8") == page():
        print("1 passed, 0 failed")
    else:
        sys.exit("docs/materials.md is out of date: make docs")


if __name__ == "__main__":
    main()
