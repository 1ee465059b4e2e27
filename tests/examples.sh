#!/bin/sh
# Every example runs to its end and leaves a summary and pictures.   examples.sh ZIPACT SCRATCH
# Those that the manual runs as they are, `$ zipact run examples/NAME.yaml -o out/DIR`, run in scripts/run-manual.py, which
# asks the same of them.
set -u
zipact=$1 scratch=$2
here=$(cd "$(dirname "$0")/.." && pwd)
pages=$("$here/scripts/run-manual.py" --pages)
passed=0 failed=0
for scenario in "$here"/examples/*.yaml; do
  name=$(basename "$scenario" .yaml)
  # shellcheck disable=SC2086
  (cd "$here/docs" && grep -q "^\$ zipact run examples/$name.yaml -o out/[a-z-]*\$" $pages) && continue
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
