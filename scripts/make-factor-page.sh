#!/bin/sh
# docs/factor.md from examples/factor.yaml, the paper's 27 cases; with --check, says whether the page is up to date.
#   make-factor-page.sh [--check] ZIPACT
set -eu
check=false
[ "$1" = --check ] && check=true && shift
here=$(cd "$(dirname "$0")/.." && pwd)
page=$here/docs/factor.md
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$1" run "$here/examples/factor.yaml" -o "$scratch/out" --quiet
python3 - "$scratch/out/table.csv" >"$scratch/page" <<'PYTHON'
import csv, sys

rows = list(csv.DictReader(open(sys.argv[1])))
columns = ["scale_factor", "paper_factor_voltage", "paper_factor_half", "paper_factor_tape", "paper_factor_gap",
           "paper_factor"]
cases = {}
for row in rows:
    cases.setdefault(float(row["isometric.separation_m"]), []).append([float(row[c]) for c in columns])
print("""# The paper's 27 cases

Made by `make docs` from [examples/factor.yaml](../examples/factor.yaml), for openings of 1, 2 and 4 mm at nine voltages from 1 to 12 kV.
The second column is the electric force by the computed field over that by the plates law. The last column is the factor that the paper's method
gives for the same field, the product of its four causes ([theory, section 15](theory.md#15-force-profile-and-the-factor-of-603)).

| opening | right law: field / plates | half the voltage | lost 1/2 | field read in the tape | gap too wide | paper's factor |
|---|---|---|---|---|---|---|""")
for opening, values in sorted(cases.items()):
    print("| %g mm | %.4f | × %g | × %g | × %.4f | × %.4f | = %.3f |" % ((1e3 * opening,) + tuple(values[0])))
spread = max(max(v[i] for v in values) / min(v[i] for v in values) - 1 for values in cases.values() for i in range(6))
all_paper = [v[5] for values in cases.values() for v in values]
mean = sum(all_paper) / len(all_paper)
deviation = (sum((f - mean) ** 2 for f in all_paper) / len(all_paper)) ** 0.5
print("\nOver the %d cases the mean of this factor is %.3f ± %.3f; the paper has 6.03 ± 0.013. Between voltages no number changes by" %
      (len(rows), mean, deviation))
print("more than %s, because all forces are proportional to the square of the voltage." % ("rounding" if spread < 1e-12 else "%.1g" % spread))
PYTHON
if $check; then
  cmp -s "$scratch/page" "$page" || { echo "docs/factor.md is out of date: make docs"; exit 1; }
  echo "1 passed, 0 failed"
else
  cp "$scratch/page" "$page"
fi
