#!/usr/bin/env python3
"""Rules of the source tree that no compiler checks:  python3 tests/rules.py REPO

Each rule is a function that yields (ok, where, what) for everything that it looks at. Violations are
printed as FILE:LINE: what; the last line is "N passed, N failed"; exit status 1 on a violation.
Standard library only. C is read by a small scanner, not by a compiler: comments, strings and
preprocessor lines are blanked first, with lines kept.
"""

import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "scripts"))
import keys_table  # noqa: E402

# Folders of src/ from low to high. A file may include its own folder and every folder listed for it.
MAY_INCLUDE = {
    "base": [],
    "def": ["base"],
    "math": ["base"],
    "ribbon": ["math", "def", "base"],
    "electro": ["math", "def", "base"],
    "contact": ["math", "def", "base"],
    "liquid": ["math", "def", "base"],
    "paper": ["electro", "math", "def", "base"],
    "drive": ["math", "def", "base"],
    "solve": ["math", "base"],  # knows no physics
    "actuator": ["ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "device": ["actuator", "math", "def", "base"],
    "term": ["actuator", "ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "system": ["term", "actuator", "ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "rest": ["system", "term", "actuator", "solve", "ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "run": ["rest", "system", "term", "actuator", "solve", "ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "study": ["run", "rest", "actuator", "solve", "ribbon", "electro", "contact", "liquid", "paper", "drive", "math", "def", "base"],
    "sample": ["math", "base"],
    "fmu": ["run", "actuator", "drive", "def", "base"],
    "fmu/export": ["fmu", "run", "actuator", "drive", "def", "base"],
    "io": ["sample", "study", "def", "base"],
    "fmupack": ["io", "fmu", "fmu/export", "base"],
    "fit": ["io", "sample", "study", "run", "rest", "actuator", "solve", "math", "def", "base"],
    "campaign": ["fit", "io", "sample", "study", "def", "base"],
    "optimize": ["campaign", "fit", "io", "sample", "study", "def", "base"],
    "reproduce": ["fit", "io", "study", "actuator", "def", "base"],
    "cli": [],
}

# What points up, and why: a room, a higher one.
POINT_UP = {
    # def/rules.def names the owners of rules, so that one checker asks all of them; a law brings its rules in its file.
    # devices.def names the devices, so that a Def knows what its kind has; a device brings its layout in its file.
    ("def", "drive"),
    ("def", "device"),
    ("def", "term"),
    ("def", "run"),
}

# Which of these the public headers stand for: including one is including its folder's interface.
# model.h and sim.h describe what actuator/ and run/ share with their users.
PUBLIC = {
    "error.h": "base",
    "table.h": "base",
    "api.h": "base",
    "version.h": "base",
    "def.h": "def",
    "choices.def": "def",
    "studies.def": "def",
    "devices.def": "def",
    "drive.h": "drive",
    "model.h": "actuator",
    "rest.h": "rest",
    "sim.h": "run",
    "checkpoint.h": "run",
    "trace.h": "run",
    "study.h": "study",
    "zipact.h": "study",
    "io.h": "io",
    "calibrate.h": "fit",
    "batch.h": "fit",
    "campaign.h": "campaign",
    "optimize.h": "optimize",
    "fmu.h": "fmupack",
}

ABOVE_CORE = ("sample", "io", "fmupack", "fit", "campaign", "optimize", "reproduce", "cli")  # may use libraries, files and streams

LONGEST_FUNCTION = 60  # lines, from the name to the closing brace

# What the core must not call: it prints nothing, opens nothing, ends nothing, looks at nothing outside.
CORE_CALLS = re.compile(
    r"(?<![\w.>])(v?f?printf|puts|fputs|putc|fputc|putchar|perror|fopen|fdopen|freopen|tmpfile|open|exit|_exit|_Exit|abort"
    r"|assert|getenv|setenv|system|signal|setlocale|time|clock|rand|srand)\s*\("
)
# What C libraries round differently: math/elementary.h has what is needed of it, the same everywhere.
ROUNDED_BY_LIBM = re.compile(
    r"(?<![\w.>])(hypot|pow|cbrt|exp2?|expm1|log|log2|log10|log1p|sin|cos|tan|asin|acos|atan2?|sinh|cosh|tanh|asinh|acosh|atanh"
    r"|erfc?|[lt]gamma|fma)\s*\("
)
PROGRESS_ONLY = {("src/run/settle.c", "log10")}  # in no result
ALLOCATOR = re.compile(r"(?<![\w.>])(malloc|calloc|realloc|aligned_alloc|posix_memalign|strdup|strndup|free)\s*\(")


def ignored_but_tracked(repo):
    """Files under version control that .gitignore says should not be: products of a build."""
    if not shutil.which("git"):
        return set()
    names = subprocess.run(["git", "-C", repo, "ls-files", "-ci", "--exclude-standard"], capture_output=True, text=True)
    return set(names.stdout.splitlines())


def tree_files(repo):
    """All files of the tree: those git knows or would take, else all but builds and results."""
    if shutil.which("git") and os.path.exists(os.path.join(repo, ".git")):
        names = subprocess.run(
            ["git", "-C", repo, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True
        )
        if names.returncode == 0:
            found = sorted(set(names.stdout.splitlines()) - ignored_but_tracked(repo))
            return [name for name in found if os.path.isfile(os.path.join(repo, name))]
    found = []
    for folder, folders, files in os.walk(repo):
        folders[:] = [f for f in folders if f not in (".git", "build", "out") and not f.startswith("build-")]
        found += [os.path.relpath(os.path.join(folder, f), repo) for f in files]
    return sorted(found)


def read(repo, name):
    with open(os.path.join(repo, name), encoding="utf-8", errors="replace") as file:
        return file.read()


def blank(match):
    """Spaces instead of what matched, lines kept."""
    return re.sub(r"[^\n]", " ", match.group(0))


def code_of(text):
    """C without comments, without the inside of strings, without preprocessor lines; same line numbers."""
    token = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.S)

    def replace(match):
        piece = match.group(0)
        if piece[0] in "\"'":
            return piece[0] + " " * (len(piece) - 2) + piece[0]
        return blank(match)

    return re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", blank, token.sub(replace, text), flags=re.M)


def line_at(text, position):
    return text.count("\n", 0, position) + 1


# -- rules ----------------------------------------------------------------------------------------


def folder_of(name):
    parts = name.split("/")
    if parts[0] == "src" and len(parts) > 2:
        return "/".join(parts[1:-1])
    if parts[0] == "reproduce":  # beside src: part of the command
        return "reproduce"
    return "cli" if name.startswith(("cli/", "python/src/", "octave/src/")) else None  # the bindings, too, see public headers only


def include_is_right(folder, mark, target):
    """mark is < or a quote, target what stands behind it."""
    if target.startswith("zipact/"):
        header = target[len("zipact/") :]
        if folder in ABOVE_CORE:
            return header in PUBLIC
        wanted = PUBLIC.get(header)
        return wanted is not None and (wanted == folder or wanted in MAY_INCLUDE[folder])
    if mark == "<":
        return True  # of the system; what may be used is another rule
    if folder == "cli":
        return "/" not in target or target == "reproduce/reproduce.h"  # which is part of the command
    wanted = target.rpartition("/")[0]
    return "/" in target and (wanted == folder or wanted in MAY_INCLUDE[folder])


def rule_includes(repo, files):
    """Includes point down only."""
    for name in files:
        folder = folder_of(name)
        if folder is None or not name.endswith((".c", ".h")):
            continue
        if folder not in MAY_INCLUDE:
            yield False, name + ":1", "folder src/%s has no place in the order of includes" % folder
            continue
        for number, line in enumerate(read(repo, name).splitlines(), 1):
            found = re.match(r'\s*#\s*include\s*([<"])([^">]+)[">]', line)
            if found:
                ok = include_is_right(folder, *found.groups())
                yield ok, "%s:%d" % (name, number), "%s may not include %s" % (folder, found.group(2))


def room_of(name):
    return folder_of(name).split("/")[0] if name.startswith("src/") and folder_of(name) else None


def names_defined(code):
    """Functions and constants that a C file makes for others."""
    return re.findall(r"^(?!static\b|extern\b|typedef\b)[A-Za-z][\w \t*]*?\b(zp_\w+)\s*(?:\(|\[[^;]*=|=)", code, re.M)


def names_used(text, code):
    owners = ["zp_rules_of_" + name for name in re.findall(r"^ZP_OWNER\((\w+)\)", text, re.M)]
    laws = ["zp_term_" + name for name in re.findall(r"^ZP_TERM\((\w+)\)", text, re.M)]
    devices = ["zp_device_" + name for name in re.findall(r"^ZP_KIND\(\w+, (\w+),", text, re.M)]
    return set(re.findall(r"\bzp_\w+", code)) | set(owners) | set(laws) | set(devices)


def rule_rooms(repo, files):
    """Rooms of src/ stand above each other: neither an include nor a name points up, so there is no circle."""
    texts = {name: read(repo, name) for name in files if room_of(name) and name.endswith((".c", ".h", ".def"))}
    codes = {name: code_of(text) for name, text in texts.items()}
    home = {symbol: room_of(name) for name in texts if name.endswith(".c") for symbol in names_defined(codes[name])}
    order, seen = [room.split("/")[0] for room in MAY_INCLUDE], set()
    for name, text in texts.items():
        own = room_of(name)
        included = re.findall(r'^\s*#\s*include\s*"(\w+)/', text, re.M)
        for symbol in sorted(names_used(text, codes[name])) if not name.endswith(".h") else []:
            included += [home[symbol]] if symbol in home else []
        for other in set(included) - {own}:
            up = order.index(other) > order.index(own)
            seen |= {(own, other)} if up else set()
            yield not up or (own, other) in POINT_UP, name + ":1", "src/%s/ needs src/%s/, which is above it" % (own, other)
    for arrow in sorted(POINT_UP - seen):
        yield False, "tests/rules.py:1", "%s no longer points up to %s" % arrow


def rule_core_needs_no_library(repo, files):
    """The core is plain C: only headers of ISO C."""
    iso = {"assert", "ctype", "errno", "float", "inttypes", "limits", "math", "stdalign", "stdarg", "stdbool", "stddef"}
    iso |= {"stdint", "stdio", "stdlib", "string"}
    for name in files:
        if folder_of(name) in (None, *ABOVE_CORE) or not name.endswith((".c", ".h")):
            continue
        for number, line in enumerate(read(repo, name).splitlines(), 1):
            found = re.match(r"\s*#\s*include\s*<([^>]+)\.h>", line)
            if found and not found.group(1).startswith("zipact/"):
                ok = found.group(1) in iso
                yield ok, "%s:%d" % (name, number), "the core may not need <%s.h>" % found.group(1)


def keys_of(repo):
    """(name, line) of each key of keys.def."""
    for number, kind, given in keys_table.rows(read(repo, "src/def/keys.def")):
        if kind == "OF_SCENARIO":
            yield given[0], number
        elif kind in ("REAL", "REAL_AS", "REAL_AUTO", "REAL_OR_AUTO", "REAL_NONE", "INT", "BOOL", "ENUM", "TEXT"):
            yield given[0] + given[2 if kind == "REAL_AS" else 1], number


def rule_keys_documented(repo, files):
    """Every key stands in docs/keys.md."""
    page = read(repo, "docs/keys.md") if "docs/keys.md" in files else ""
    keys = list(keys_of(repo))
    yield len(keys) > 40, "src/def/keys.def:1", "only %d keys found: is its form still known here?" % len(keys)
    for key, line in keys:
        found = re.search(r"(?<![\w.])%s(?![\w.]*\w)" % re.escape(key), page)
        yield bool(found), "src/def/keys.def:%d" % line, "key %s is not in docs/keys.md" % key


def rows_of(repo, files):
    """The rows of laws in src/: name => (unit, suffix, file)."""
    rows = {}
    for name in files:
        if not (name.startswith("src/") and name.endswith(".c")):
            continue
        text = read(repo, name)
        for row in re.findall(r"= ?ZP_(?:STORED|LOST|GAVE|LOST_BY_SOURCE)\(\s*(\w+),", re.sub(r"\s+", " ", text)):
            rows[row] = ("J", "_J", name)
        for row in re.findall(r'= ?ZP_SHOWN\(\s*(\w+), "([^"]*)", "([^"]*)"', re.sub(r"\s+", " ", text)):
            rows[row[0]] = (row[1], row[2], name)
    return rows


def rows_of_terms(repo):
    """(term, its rows) of each line of terms.def."""
    for line in re.findall(r"^ZP_TERM\(.*", read(repo, "src/term/terms.def"), re.M):
        yield re.match(r"ZP_TERM\((\w+)\)", line).group(1), re.findall(r"ZP_ROW\((\w+)\)", line)


def rule_signals_documented(repo, files):
    """Every signal stands somewhere in docs/, as in a table: with the unit in its name."""
    pages = "\n".join(read(repo, name) for name in files if name.startswith("docs/") and name.endswith(".md"))
    text = read(repo, "src/base/signals.def")
    rows = rows_of(repo, files)
    signals = list(re.finditer(r'^ZP_SIGNAL\((\w+),\s*"[^"]*",\s*"([^"]*)"', text, re.M))
    listed = re.findall(r"^ZP_ROW\((\w+)\)", text, re.M)
    for term, own in rows_of_terms(repo):
        for row in own:
            ok = rows.get(row, ("", "", ""))[2] == "src/term/%s.c" % term
            yield ok, "src/term/terms.def:1", "row %s is not defined in src/term/%s.c" % (row, term)
        listed += own
    for row in listed:
        column = row + rows.get(row, ("", "", ""))[1]
        ok = re.search(r"(?<!\w)%s(?!\w)" % re.escape(column), pages)
        yield bool(ok), "src/base/signals.def:1", "%s is not in docs/" % column
        yield listed.count(row) == 1, "src/term/terms.def:1", "row %s has two places" % row
    for row, (_, _, name) in rows.items():
        yield row in listed, name + ":1", "row %s has no place in signals.def or terms.def: no column would show it" % row
        if name.startswith("src/term/"):
            ok = re.search(r"&zp_row_%s\b" % row, read(repo, name))
            yield bool(ok), name + ":1", "the term does not list its row %s" % row
    signals += list(re.finditer(r"^ZP_CONTROLLED\((\w+)()", text, re.M))
    yield len(signals) > 10, "src/base/signals.def:1", "only %d signals found" % len(signals)
    for found in signals:
        column = found.group(1) + found.group(2)
        ok = re.search(r"(?<!\w)%s(?!\w)" % re.escape(column), pages)
        yield bool(ok), "src/base/signals.def:%d" % line_at(text, found.start()), "%s is not in docs/" % column


def rule_public_functions_commented(repo, files):
    """A comment stands directly above every public function, or above the block of lines it is in."""
    for name in files:
        if not (name.startswith("include/zipact/") and name.endswith(".h")):
            continue
        text = read(repo, name)
        lines = text.splitlines()
        code = code_of(text)
        # outside of braces, what ends in a parenthesis and a semicolon
        for found in re.finditer(r"^(?!typedef)\w[\w\s*]*\b(zp_\w+)\([^;{}]*\)\s*;", code, re.M):
            line = line_at(code, found.start())
            above = line - 1
            while above > 0 and lines[above - 1].strip() and not lines[above - 1].rstrip().endswith("*/"):
                above -= 1
            ok = above > 0 and lines[above - 1].rstrip().endswith("*/")
            yield ok, "%s:%d" % (name, line), "no comment above %s" % found.group(1)


def is_core(name):
    return folder_of(name) not in (None, *ABOVE_CORE) and name.endswith((".c", ".h"))


def rule_core_calls(repo, files):
    """The core prints nothing, opens nothing, ends nothing."""
    for name in filter(is_core, files):
        code = code_of(read(repo, name))
        bad = list(CORE_CALLS.finditer(code))
        if not name.startswith("src/base/memory."):
            bad += ALLOCATOR.finditer(code)
        yield True, name, ""
        for found in bad:
            yield False, "%s:%d" % (name, line_at(code, found.start())), "the core may not call " + found.group(1)


def rule_no_libm(repo, files):
    """The core's bits depend on no C library."""
    for name in filter(is_core, files):
        code = code_of(read(repo, name))
        yield True, name, ""
        for found in ROUNDED_BY_LIBM.finditer(code):
            if (name, found.group(1)) not in PROGRESS_ONLY:
                what = found.group(1) + " has other bits on other machines: math/elementary.h"
                yield False, "%s:%d" % (name, line_at(code, found.start())), what


def is_mutable(declaration):
    """(declaration without its initial value) => is what it declares neither const nor a type or function?"""
    head = re.split(r"\[", declaration)[0]
    return not re.search(r"\bconst\b", head[head.rfind("*") + 1 :] if "*" in head else head)


def variables_of_static_life(code):
    """(position, declaration) of what lives as long as the program: at file level, or static in a function."""
    depth, start, position = 0, 0, 0
    while position < len(code):
        c = code[position]
        if c == "{":
            statement = code[start:position]
            is_type = re.match(r"\s*(typedef|struct|union|enum)\b[^()]*$", statement)
            if depth == 0 and ("=" in statement or is_type):  # initial value, or members, in braces
                position = closing(code, position)
            else:
                depth += 1
                start = position + 1
        elif c == "}":
            depth -= 1
            start = position + 1
        elif c == ";":
            statement = code[start:position]
            plain = statement.split("=")[0].strip()
            kind = plain.split()[0] if plain else ""
            life = kind == "static" if depth else kind not in ("typedef", "struct", "union", "enum", "extern", "")
            if life and "(" not in re.sub(r"__attribute__\s*\(\(.*?\)\)", "", plain, flags=re.S):
                yield start + len(statement) - len(statement.lstrip()), plain
            start = position + 1
        position += 1


def closing(code, position):
    """Place of the brace that closes the one at `position`."""
    depth = 0
    for i in range(position, len(code)):
        depth += (code[i] == "{") - (code[i] == "}")
        if depth == 0:
            return i
    return len(code) - 1


def rule_no_mutable_globals(repo, files):
    """The core has no state of its own, so that threads may use it."""
    for name in filter(is_core, files):
        code = code_of(read(repo, name))
        for position, declaration in variables_of_static_life(code):
            where = "%s:%d" % (name, line_at(code, position))
            yield not is_mutable(declaration), where, "mutable variable of static life: " + " ".join(declaration.split())


def rule_no_paths_of_this_machine(repo, files):
    """Nothing in the tree knows where it was made. ${TMPDIR:-...} is how a script asks the machine."""
    pattern = re.compile(r"(?<![\w.:-])/(?:%s)(?:/|\b(?=[\s\"'`);,]|$))" % "|".join(["wo" + "rk", "tm" + "p"]))
    for name in files:
        yield True, name, ""
        for number, line in enumerate(read(repo, name).splitlines(), 1):
            found = pattern.search(line)
            if found:
                yield False, "%s:%d" % (name, number), "path of a machine: %s" % line[found.start() :][:40].strip()


def rule_root_has_no_results(repo, files):
    """What a program leaves where it runs is not of the tree: tables, journals and checkpoints stand in rooms of data."""
    rooms = ("bench/", "benchmarks/", "examples/", "tests/")
    for name in files:
        data = name.endswith((".csv", ".h5", ".zps", ".sqlite"))
        yield not data or name.startswith(rooms), name + ":1", "left by a program that ran here"


def rule_map(repo, files):
    """Every folder of src/ is in MAP.md."""
    text = read(repo, "MAP.md") if "MAP.md" in files else ""
    folders = sorted({name.split("/")[1] for name in files if name.startswith("src/") and name.count("/") > 1})
    for folder in folders:
        yield bool(re.search(r"(?<![\w])%s/" % folder, text)), "MAP.md:1", "src/%s/ is not mentioned" % folder


def rule_equations_are_checked(repo, files):
    """Each numbered equation of the theory is in its table of checks, and the tests named there exist."""
    theory = read(repo, "docs/theory.md")
    rows = re.findall(r"^\| (\d+)\.(\d+)(?: – \1\.(\d+))? \|(.*)$", theory, re.M)
    listed = {(int(part), n) for part, first, last, _ in rows for n in range(int(first), int(last or first) + 1)}
    for part, number in re.findall(r"\\tag\{(\d+)\.(\d+)\}", theory):
        yield (int(part), int(number)) in listed, "docs/theory.md:1", "(%s.%s) is in no row of section 1.1" % (part, number)
    tests = {os.path.basename(name)[:-2]: read(repo, name) for name in files if re.match(r"tests/test_\w+\.c$", name)}
    for _, _, _, row in rows:
        source = ""
        for name in re.findall(r"`(\w+)`", row.split("|")[1]):
            source = tests.get(name, source)
            known = name in tests or bool(re.search(r"^\w*TESTS?\(%s\b" % name, source, re.M))
            yield known, "docs/theory.md:1", "there is no test %s" % name


def functions_of(code):
    """(first line, last line, name) of each function body at file level."""
    position = 0
    while True:
        brace = code.find("{", position)
        if brace < 0:
            return
        end = closing(code, brace)
        head = code[position:brace]
        start = max(head.rfind(";"), head.rfind("}")) + 1
        found = re.search(r"(\w+)\s*\((?:[^(){};]|\([^(){};]*\))*\)\s*$", head[start:])
        if found:
            lead = len(head[start:]) - len(head[start:].lstrip())
            yield line_at(code, position + start + lead), line_at(code, end), found.group(1)
        elif re.search(r'\bextern\s+"\s*"\s*$', head):
            end = brace  # look inside
        position = end + 1


def rule_short_functions(repo, files):
    """No function longer than LONGEST_FUNCTION lines."""
    for name in files:
        if not name.startswith(("src/", "cli/", "reproduce/", "include/", "tests/", "bench/", "python/")) or not name.endswith((".c", ".h", ".cpp")):
            continue
        for first, last, function in functions_of(code_of(read(repo, name))):
            length = last - first + 1
            yield length <= LONGEST_FUNCTION, "%s:%d" % (name, first), "%s has %d lines" % (function, length)


def rule_head_comment(repo, files):
    """Every header of src/ and every public header begins with what it is for."""
    for name in files:
        if name.startswith(("src/", "cli/", "reproduce/", "include/")) and name.endswith((".h", ".def")):
            yield read(repo, name).startswith("/*"), name + ":1", "no comment at its head"


def rule_guards(repo, files):
    """The guard of a header of src/ is named after its path."""
    for name in files:
        if name.startswith("src/") and name.endswith(".h"):
            guard = "ZP_" + re.sub("[/.]", "_", name[len("src/") :]).upper()
            yield "\n#ifndef %s\n#define %s\n" % (guard, guard) in read(repo, name), name + ":1", "its guard is not " + guard


def rule_limits_in_cpu_time(repo, files):
    """No test is limited in wall time, which a busy machine uses up: tests/suite.c limits its CPU time."""
    for name in files:
        if name.startswith("tests/") and name.endswith(".c"):
            yield "tcase_set_timeout" not in read(repo, name), name, "tcase_set_timeout is of wall time: tests/suite.c"


def rule_no_products(repo, files):
    """No product of a build or run is under version control."""
    bad = ignored_but_tracked(repo)
    folders = sorted({name.split("/")[0] for name in bad})
    yield not bad, ".gitignore:1", "%d ignored files are tracked, in %s" % (len(bad), " ".join(folders))


def rule_readme_is_short(repo, files):
    """The README fits on a screen and a half, and its first picture is the live page."""
    text = read(repo, "README.md")
    lines = text.count("\n")
    yield lines <= 75, "README.md:%d" % lines, "%d lines, more than 75: docs/ is the home of the rest" % lines
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]*)\)", text)
    yield pictures[:1] == ["docs/images/live.png"], "README.md:1", "its first picture is not the live page"


# A program that asks for a study by its name is a user of it; whatever decides by the name knows what studies there are.
ASKS_FOR_STUDY = re.compile(r"\bzp_(?:data_)?(?:study_run|study_check|check)\s*\(\s*$|\bzp_result_create\s*\(\s*$")


def rule_a_study_is_known_to_its_own_file(repo, files):
    """The name of a study is in its row of studies.def and in the files called like it. Others may run it by name."""
    rows = re.findall(r"^ZP_STUDY\((ZP_STUDY_(\w+)), (\w+),", read(repo, "include/zipact/studies.def"), re.M)
    yield len(rows) >= 7, "include/zipact/studies.def:1", "only %d studies found: is its form still known here?" % len(rows)
    for enumerator, _, word in rows:
        names = re.compile(r"\b(?:%s|zp_study_%s|zp_check_%s)\b" % (enumerator, word, word))
        for name in files:
            own = os.path.basename(name) == word + ".c" or name == "include/zipact/studies.def"
            if own or not name.startswith(("src/", "cli/", "reproduce/", "include/", "python/src/", "octave/src/")) or not name.endswith((".c", ".h", ".def")):
                continue
            code = code_of(read(repo, name))
            for found in names.finditer(code):
                asks = ASKS_FOR_STUDY.search(code[: found.start()])
                yield bool(asks), "%s:%d" % (name, line_at(code, found.start())), "knows of study %s" % word
        yield any(name == "src/study/%s.c" % word for name in files), "include/zipact/studies.def:1", "study %s has no file" % word


# What gives a force of a law, or adds to one: only terms may, and system/system.c, which asks them.
FORCE_OF_A_LAW = re.compile(
    r"\b(zp_rod_step|zp_rod_stiffness|zp_massspring_stiffness|zp_plates_step|zp_plates_rest|zp_surface_bezier)\s*\("
    r"|\b(F|Fx|Fy|force|a|ax|ay)\s*\[[^\]]*\]\s*[-+]=|->\s*(force|stiffness)\(model"
)
ABOVE_TERMS = ("actuator", "system", "rest", "run", "study")


def rule_one_sum(repo, files):
    """Forces of laws are added up in system/system.c, nowhere else."""
    terms = [term for term, _ in rows_of_terms(repo)]
    for term in terms:
        yield "src/term/%s.c" % term in files, "src/term/terms.def:1", "term %s has no file" % term
    for name in files:
        if name.startswith("src/term/") and name.endswith(".c"):
            for term in re.findall(r"^const ZpTerm zp_term_(\w+)", read(repo, name), re.M):
                yield term in terms, name + ":1", "term %s has no line in terms.def" % term
    for name in files:
        if folder_of(name) not in ABOVE_TERMS or not name.endswith((".c", ".h")) or name == "src/system/system.c":
            continue
        code = code_of(read(repo, name))
        found = FORCE_OF_A_LAW.search(code)
        yield not found, "%s:%d" % (name, line_at(code, found.start()) if found else 1), "adds to a force: that is a term's"


# Where x and y of a node stand in an array is known to actuator/, and where both nodes of a pair do to base/pair.h. All
# others read and write views (zp_nodes, zp_forces) and name coordinates (zp_x_of, zp_y_of).
LAYOUT = re.compile(r"\bstride\b|\[2 \* [ijk]( \+ \w+)?\]|\+ (\w+ \* )?zp_lanes\(|\b2 \* (zp_(upper|lower|load_node)\(|(node|j)( \+|[,\]]))")
OWN_LAYOUT = ("actuator", "base", "io", "math")


def rule_views(repo, files):
    """Only actuator/ and base/pair.h know the layout of coordinates; base/table.h and math/ have strides of their own."""
    for name in files:
        if name.startswith("src/") and folder_of(name) not in OWN_LAYOUT and name.endswith((".c", ".h")):
            found = [line for line, text in enumerate(code_of(read(repo, name)).splitlines(), 1) if LAYOUT.search(text)]
            where = "%s:%d" % (name, found[-1] if found else 1)
            yield not found, where, "knows where x and y of a node stand: use zp_nodes, zp_forces, zp_x_of, zp_y_of, or base/pair.h"


# Clients of the public interface, which does not say what a kind has.
ASKS_FOR_KIND = {"src/fit/sets.c", "src/io/plot_data.c"}


def rule_kinds(repo, files):
    """Which kind an actuator is, nobody asks: what its device has is in its file of src/device/. That file names its own
    kind, where it refuses keys of its own for all others."""
    for name in files:
        if name.startswith("src/") and name.endswith((".c", ".h")) and name not in ASKS_FOR_KIND:
            own = "ZP_KIND_" + os.path.basename(name)[:-2].upper() if room_of(name) == "device" else ""
            found = set(re.findall(r"\bZP_KIND_[A-Z]\w*", code_of(read(repo, name)))) - {own}
            yield not found, name + ":1", "asks for a kind of actuator: ask for what its device has (ZP_HAS, zp_def_has)"


# Phrases over which native speakers stumble, and what to say instead.
STUMBLING = {
    r"(solved|found) anew": "re-solve, recompute",
    r"(is|are) warned of": "prints a warning",
    r"what it is off by": "its error",
    r"\blet(s|ting)? go\b": "release, open again; unilateral contact",
    r"that the insulator stands": "dielectric strength",
    r"faces press and": "unilateral contact",
    r"\bend(s|ed)? badly": "the solver failed",
    r"takes? the very": "exactly the same",
    r"\bno predictions?\b": "not a prediction",
    r"\b(go|goes|going|gone) on (from|where|straight|to|in)\b": "resume, continue",
}
READ_BY_USERS = ("README.md", "MAP.md", "docs/", "include/", "src/", "cli/", "reproduce/", "web/", "python/", "octave/", "examples/", "bench/")


def rule_plain_words(repo, files):
    """Texts that users and maintainers read are plain English."""
    for name in files:
        if name.startswith(READ_BY_USERS) and name.endswith((".md", ".def", ".c", ".h", ".py", ".js", ".mjs", ".m", ".yaml", ".1")):
            text = read(repo, name)
            found = [(line_at(text, m.start()), " ".join(m.group(0).split()), instead)
                     for phrase, instead in STUMBLING.items() for m in re.finditer(phrase.replace(" ", r"\s+"), text, re.I)]
            yield not found, "%s:%d" % (name, found[0][0] if found else 1), "say it plainly: %s" % "; ".join(
                "%d: %s (%s)" % each for each in found)


LEANS = re.compile(r"/\*[\s*]*(What|The same|And|It)\b")


def comments_of(text):
    """(line, comment) of each comment of C, none of which stands inside a string."""
    for match in re.finditer(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|/\*.*?\*/', text, re.S):
        if match.group(0).startswith("/*"):
            yield line_at(text, match.start()), match.group(0)


def rule_comments_stand_alone(repo, files):
    """A comment can be read without its neighbour: it does not begin with What, The same, And or It."""
    for name in files:
        if name.startswith(("src/", "include/", "cli/")) and name.endswith((".c", ".h", ".def")):
            found = [line for line, comment in comments_of(read(repo, name)) if LEANS.match(comment)]
            yield not found, "%s:%d" % (name, found[0] if found else 1), "say what the comment is about: %s" % found


RULES = [
    rule_limits_in_cpu_time,
    rule_no_products,
    rule_includes,
    rule_rooms,
    rule_core_needs_no_library,
    rule_keys_documented,
    rule_signals_documented,
    rule_public_functions_commented,
    rule_core_calls,
    rule_no_libm,
    rule_no_mutable_globals,
    rule_no_paths_of_this_machine,
    rule_root_has_no_results,
    rule_map,
    rule_equations_are_checked,
    rule_short_functions,
    rule_head_comment,
    rule_guards,
    rule_a_study_is_known_to_its_own_file,
    rule_one_sum,
    rule_views,
    rule_kinds,
    rule_readme_is_short,
    rule_plain_words,
    rule_comments_stand_alone,
]


# -- the rules are tested on small samples before they judge the tree ------------------------------


def self_test():
    code = code_of('static int a; /* static int b; */\nstatic const int c = 1;\nint f(void) {\n  static double d[2];\n'
                   '  static const char *const e[] = {"x"};\n  static const char *g;\n  int h = 0;\n  return h;\n}\n'
                   'typedef struct T {\n  int a;\n} T;\nstruct U { int b; };\nint k = 1;\n')
    mutable = [" ".join(d.split()) for _, d in variables_of_static_life(code) if is_mutable(d)]
    assert mutable == ["static int a", "static double d[2]", "static const char *g", "int k"], mutable
    assert list(functions_of(code)) == [(3, 9, "f")], list(functions_of(code))
    assert not CORE_CALLS.search("snprintf(text); vsnprintf(t); reopen(x)")
    assert not CORE_CALLS.search("hooks->clock(user)") and CORE_CALLS.search("fprintf(stderr)") and CORE_CALLS.search("  exit (1)")
    assert ROUNDED_BY_LIBM.search("x = cbrt(y)") and not ROUNDED_BY_LIBM.search("sqrt(x) + zp_cos(y) + a.exp(z)")
    assert names_defined("static int zp_a(void);\nconst ZpRules zp_b = {0};\nZpStatus *zp_c(int x) {\nextern int zp_d;\n") == ["zp_b", "zp_c"]
    assert names_used("ZP_OWNER(terms)\n", "  zp_e(1);\n") == {"zp_rules_of_terms", "zp_e"}
    assert not include_is_right("solve", '"', "paper/massspring.h")
    assert not include_is_right("contact", '"', "electro/plates.h")
    assert not include_is_right("math", "<", "zipact/sim.h")
    assert include_is_right("run", '"', "solve/explicit.h") and include_is_right("io", "<", "zipact/io.h")
    assert ASKS_FOR_STUDY.search("status = zp_study_run(") and not ASKS_FOR_STUDY.search("if (study == ")
    told = [comment for _, comment in comments_of('a("/* It */"); /* It is. */ b(/* Items */);\n/*\n * And so on. */')]
    assert [bool(LEANS.match(comment)) for comment in told] == [True, False, True], told
    assert not include_is_right("cli", '"', "io/report.h") and not include_is_right("io", '"', "run/run.h")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: python3 tests/rules.py REPO")
    repo = sys.argv[1]
    self_test()
    files = tree_files(repo)
    passed = failed = 0
    for rule in RULES:
        looked_at = 0
        for ok, where, what in rule(repo, files):
            looked_at += 1
            passed += ok
            failed += not ok
            if not ok:
                print("%s: %s  [%s]" % (where, what, rule.__name__))
        if looked_at == 0:
            failed += 1
            print("tests/rules.py:1: %s found nothing to look at" % rule.__name__)
    print("%d passed, %d failed" % (passed, failed))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
