#!/bin/sh
# Every example runs to its end and leaves a summary and pictures.   examples.sh ZIPACT SCRATCH
set -u
zipact=$1 scratch=$2
here=$(cd "$(dirname "$0")/.." && pwd)
passed=0 failed=0
for scenario in "$here"/examples/*.yaml; do
  name=$(basename "$scenario" .yaml)
  command=run
  grep -q '^optimize:' "$scenario" && command=optimize
  if "$zipact" $command "$scenario" -o "$scratch/$name" --quiet && [ -s "$scratch/$name/summary.json" ] &&
    [ -n "$(find "$scratch/$name/plots" -name '*.svg' -size +1k)" ]; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "failed: $name"
  fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
