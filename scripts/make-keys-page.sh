#!/bin/sh
# docs/keys.md from the program's own tables; with --check, says whether the page is up to date.
#   make-keys-page.sh [--check] ZIPACT
set -eu
check=false
[ "$1" = --check ] && check=true && shift
page=$(cd "$(dirname "$0")/.." && pwd)/docs/keys.md
made=$(mktemp)
trap 'rm -f "$made"' EXIT
"$1" keys --json | python3 -c '
import json, re, sys

def cell(text):
    return str(text).replace("|", "\\|")

print("# Keys\n\nMade by `make docs` from the program (`zipact keys`). Values take units (\"130 um\"); a bare number is SI.\n")
print("| key | default | range | meaning |\n|---|---|---|---|")
for key in json.load(sys.stdin):
    unit = "" if key["unit"] == "1" else " " + key["unit"]
    value = key["default"]
    words = [choice["word"] for choice in key.get("choices") or []]
    if isinstance(value, bool):
        value = str(value).lower()
    number = isinstance(value, (int, float))
    shown = f"{value:g}{unit}" if number else value or "\"\""
    allowed = "text" if key["type"] == "text" else ", ".join(words) or ("true, false" if key["type"] == "bool" else "%g to %g%s" % (key["min"], key["max"], unit))
    print("| `%s` | %s | %s | %s |" % (key["key"], cell(shown), cell(allowed), cell(key["help"])))
' >"$made"
python3 - "$(dirname "$0")/.." >>"$made" <<'PYTHON'
import glob, re, sys
signals = "\n".join(open(sys.argv[1] + name).read() for name in ("/src/base/signals.def", "/src/term/terms.def"))
laws = " ".join(" ".join(open(name).read().split()) for name in sorted(glob.glob(sys.argv[1] + "/src/**/*.c", recursive=True)))
rows = {name: ("J", "_J", text) for name, text in re.findall(r'ZP_(?:STORED|LOST|LOST_BY_SOURCE)\( ?(\w+), "([^"]*)"\)', laws)}
rows.update((name, (unit, suffix, text)) for name, unit, suffix, text in
            re.findall(r'ZP_SHOWN\( ?(\w+), "([^"]*)", "([^"]*)", "([^"]*)"\)', laws))
print("\n# Columns of table.csv\n\n| column | unit | meaning |\n|---|---|---|")
for line in signals.splitlines():
    found = re.match(r'ZP_SIGNAL\((\w+), "([^"]*)", "([^"]*)", "([^"]*)"\)', line)
    listed = [found.groups()] if found else [(row, *rows[row]) for row in re.findall(r"(?<!define )ZP_ROW\((\w+)\)", line) if row in rows]
    for name, unit, suffix, text in listed:
        print(f"| `{name}{suffix}` | {unit} | {text} |")
for name, text in re.findall(r'^ZP_CONTROLLED\((\w+), "([^"]*)"\)', signals, re.M):
    print(f"| `{name}`, with a controller `{name}_m`, `{name}` or `{name}_F` | that of control.signal | {text} |")
PYTHON
if $check; then
  cmp -s "$made" "$page" || { echo "docs/keys.md is out of date: make docs"; exit 1; }
  echo "1 passed, 0 failed"
else
  cp "$made" "$page"
fi
