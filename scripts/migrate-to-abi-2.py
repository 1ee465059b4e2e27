#!/usr/bin/env python3
"""Rewrite C programs for zipact 0.1, which read and wrote the fields of structs, so that they call functions:

    python3 scripts/migrate-to-abi-2.py [--check] FILE.c...

Fields of ZpActuatorDef, ZpRunInfo, ZpModelInfo, ZpResult, ZpTable and ZpShapes become calls; variables that were structs
become pointers, which the program creates and has to destroy. Each line that a person has to look at is printed: what
was created and is not destroyed, and what the script did not understand. --check changes nothing and exits with 1 if
there is anything to change.
"""

import re
import sys

KEY = r"((?:[a-z_][a-z_0-9]*\.){0,2}[a-z_][a-z_0-9]*)"
RENAMED = {"bead.returned": "bead.return"}  # `return` is a word of C
INFO_CALLS = {"outcome": "zp_run_info_outcome({0})", "message": "zp_run_info_message({0})"}
INFO_NUMBERS = "steps|rejected|failures|iterations|simulated_time|wall_time|settle_steps|settle_residual"
BOUNDS = ("drag_bound", "axial_bound", "shear_bound")
MODEL_NUMBERS = (
    "ribbons|nodes|flexible_length|element_length|bending_stiffness|axial_stiffness|line_mass|axial_spring|"
    "shear_coefficient|insulator_offset|internal_damping|closed_line_force|stable_time_step"
)
RESULT_CALLS = "study|outcome|message|notes|resolution|scalars|sensitivities|series|shapes|map|checkpoint"


def names_of(text, kind, pointer):
    """Variables of this type: structs, or pointers to them."""
    mark = r"\*\s*(?:const\s+)?" if pointer else r"\s+"
    found = re.findall(r"\b(?:struct\s+)?%s\s*%s(\w+)\s*(?=[=;,)\[])" % (kind, mark), text)
    return sorted(set(found), key=len, reverse=True)


def replace(text, pattern, by):
    return re.sub(pattern, by, text, flags=re.M)


def key_name(field):
    return RENAMED.get(field, field)


def migrate_def(text, notes):
    structs, pointers = names_of(text, "ZpActuatorDef", False), names_of(text, "ZpActuatorDef", True)
    for name in structs:
        text = replace(text, r"\bZpActuatorDef %s = zp_actuator_def_default\(\);" % name, "ZpActuatorDef *%s = zp_def_create();" % name)
        text = replace(text, r"\bZpActuatorDef %s = \*(\w+);" % name, r"ZpActuatorDef *%s = zp_def_copy(\1);" % name)
        text = replace(text, r"\bZpActuatorDef %s;" % name, "ZpActuatorDef *%s = zp_def_create();" % name)
        text = replace(text, r"&%s\b(?!\s*[.\[])" % name, name)
        if not re.search(r"\bzp_def_destroy\(%s\)" % name, text):
            notes.append("%s is created and not destroyed: zp_def_destroy(%s)" % (name, name))
    for name, dot in [(n, r"(?:\.|->)") for n in structs] + [(n, "->") for n in pointers]:

        def write(found):
            key, operator, value = key_name(found[2]), found[3], found[4]
            if operator:
                value = 'zp_def_number(%s, "%s") %s (%s)' % (name, key, operator, value)
            return '%szp_def_set_number(%s, "%s", %s, NULL);' % (found[1], name, key, value)

        text = replace(text, r"(^[ \t]*|(?<=[;{)])[ \t]*)%s%s%s ([-+*/]?)= ((?!=)(?:(?!, %s%s)[^;])+);" % (name, dot, KEY, name, dot), write)
        text = replace(text, r"(?<![\w.>/\"])%s%s%s(?![\w(.\[])" % (name, dot, KEY),
                       lambda found: 'zp_def_number(%s, "%s")' % (name, key_name(found[1])))
    return text


def migrate_info(text, notes):
    for name in names_of(text, "ZpRunInfo", False):
        text = replace(text, r"\bZpRunInfo %s(?: = \{0\})?;" % name, "ZpRunInfo *%s = zp_run_info_create();" % name)
        text = replace(text, r"&%s\b(?!\s*[.\[])" % name, name)
        if not re.search(r"\bzp_run_info_destroy\(%s\)" % name, text):
            notes.append("%s is created and not destroyed: zp_run_info_destroy(%s)" % (name, name))
    for name in names_of(text, "ZpRunInfo", False) + names_of(text, "ZpRunInfo", True):
        for field, call in INFO_CALLS.items():
            text = replace(text, r"\b%s(?:\.|->)%s\b" % (name, field), call.format(name))
        text = replace(text, r"\b%s(?:\.|->)(%s)\b" % (name, INFO_NUMBERS), r'zp_run_info_get(%s, "\1")' % name)
        text = replace(text, r"\b%s(?:\.|->)limited\[([^]]+)\]" % name, r"zp_run_info_limited(%s, \1)" % name)
        for k, bound in enumerate(BOUNDS):
            text = replace(text, r"\b%s(?:\.|->)smallest_bound\[%d\]" % (name, k), 'zp_run_info_get(%s, "%s")' % (name, bound))
    return text


def migrate_model(text, notes):
    text = replace(text, r"\bzp_model_info\(([^()]+)\)\.(%s)\b" % MODEL_NUMBERS, r'zp_model_get(\1, "\2")')
    for name, model in re.findall(r"\bZpModelInfo (\w+) = zp_model_info\(([^()]+)\);", text):
        text = replace(text, r"^[ \t]*ZpModelInfo %s = zp_model_info\([^()]+\);\n" % name, "")
        text = replace(text, r"\b%s\.(%s)\b" % (name, MODEL_NUMBERS), r'zp_model_get(%s, "\1")' % model)
    return text


def migrate_results(text, notes):
    for name in names_of(text, "ZpResult", True):
        text = replace(text, r"\b%s->note\[([^]]+)\]" % name, r"zp_result_note_text(%s, \1)" % name)
        for array in ("scalar", "sensitivity"):
            text = replace(text, r"&%s->%s\[([^]]+)\](?!\.)" % (name, array), r"zp_result_%s(%s, \1)" % (array, name))
            text = replace(text, r"\b%s->%s\[([^]]+)\]\." % (name, array), r"zp_result_%s(%s, \1)->" % (array, name))
        text = replace(text, r"\b%s->(%s)\b" % (name, RESULT_CALLS), r"zp_result_\1(%s)" % name)
    tables = [(n, n) for n in names_of(text, "ZpTable", True)] + [(r"zp_result_series\((\w+)\)", r"zp_result_series(\g<1>)")]
    for name, same in tables:
        group = 2 if "(" in name else 1
        text = replace(text, r"(?<!\w)%s->(rows|columns)\b" % name, r"zp_table_\g<%d>(%s)" % (group, same))
        text = replace(text, r"&%s->column\[([^]]+)\](?!\.)" % name, r"zp_table_column(%s, \g<%d>)" % (same, group))
        text = replace(text, r"(?<!\w)%s->column\[([^]]+)\]\." % name, r"zp_table_column(%s, \g<%d>)->" % (same, group))
    for name in names_of(text, "ZpShapes", True) + [r"zp_result_shapes\(\w+\)"]:
        text = replace(text, r"(?<!\w)(%s)->(frames|ribbons|nodes|members)\b" % name, r"zp_shapes_\2(\1)")
        text = replace(text, r"(?<!\w)(%s)->frame_size\b" % name, r"zp_shapes_stride(\1)")
    return text


# Lines that do not compile, or mean something else, after all replacements.
SUSPECT = {
    r"zp_actuator_def_default|ZpModelInfo|zp_model_info|zp_limits_destroy|->offset\b|layout\.h": "is not in interface 2",
    r"\bZp(?:ActuatorDef|RunInfo|Result|Table|Shapes) \w+ *[=;,\[]": "is a pointer now, created and destroyed by calls",
    r"&zp_def_number\(|zp_def_number\([^()]*\) *[-+*/]?=(?!=)|zp_def_number\([^()]*\)(?:\+\+|--)": "sets a key: zp_def_set_number",
    r"\b(?:str\w*|snprintf|sprintf|memcpy)\(zp_def_number": "sets a text: zp_def_set_word",
    r"zp_result_(?:series|shapes)\(\w+\)->": "reads a member of what is opaque",
    r"%[-0-9]*(?:z|l*)[ud].*zp_(?:model|run_info)_get\(": "prints a number that is a double now",
}


def left_over(text, notes):
    """Fields that remain, and what else a person has to look at."""
    unseen = len(re.findall(r"zp_def_set_number\([^;]*, NULL\);", text))
    if unseen:
        notes.append("%d keys are set and no error is read: a value out of range leaves the old one, no later call refuses it" % unseen)
    for number, line in enumerate(text.splitlines(), 1):
        notes += ["line %d %s: %s" % (number, why, line.strip()) for pattern, why in SUSPECT.items() if re.search(pattern, line)]
    for kind, pattern in {"ZpActuatorDef": r"[a-z]\w*", "ZpResult": r"\w+", "ZpTable": r"\w+", "ZpShapes": r"\w+", "ZpRunInfo": r"\w+"}.items():
        for name in names_of(text, kind, False) + names_of(text, kind, True):
            for number, line in enumerate(text.splitlines(), 1):
                if re.search(r"(?<![\w.>\"])%s(?:\.|->)%s" % (name, pattern), line):
                    notes.append("line %d reads %s, a %s: %s" % (number, name, kind, line.strip()))


def main():
    check, changed = "--check" in sys.argv, False
    for path in [name for name in sys.argv[1:] if name != "--check"]:
        with open(path, encoding="utf-8") as file:
            before = file.read()
        notes, text = [], before
        for step in (migrate_def, migrate_info, migrate_model, migrate_results):
            text = step(text, notes)
        left_over(text, notes)
        changed = changed or text != before
        if text != before and not check:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        print("%s: %s" % (path, "changed" if text != before else "unchanged"))
        for note in notes:
            print("  " + note)
    return 1 if check and changed else 0


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main())
