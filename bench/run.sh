#!/bin/sh
# The measured tables and pictures of this folder, on this machine.   run.sh BUILD [reference]
#   reference: make cli/swing.def, the converged swing, instead
set -eu
build=$(cd "$1" && pwd)
cd "$(dirname "$0")"
if [ "${2-}" = reference ]; then
  "$build/precision" reference >swing.def.new
  mv swing.def.new ../cli/swing.def
  exit
fi
"$build/zipact" bench --json | python3 -c '
import csv, json, sys
rows = json.load(sys.stdin)["rows"]
table = csv.DictWriter(sys.stdout, rows[0].keys(), lineterminator="\n")
table.writeheader()
table.writerows(rows)' >bench.csv
./campaign.py "$build" >campaign.csv
./meter.py "$build" >meter.csv
gnuplot meter.gp
"$build/precision" cost >cost.csv
gnuplot cost.gp
./counts.py "$build/zipact" >counts.csv
for motion in swing zip; do
  "$build/precision" $motion >$motion.csv
  gnuplot -e "motion='$motion'" precision.gp
done
