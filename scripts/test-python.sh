#!/bin/sh
# Builds the wheel of python/, installs it in a fresh virtual environment and runs its tests.
#   scripts/test-python.sh BUILD [PYTEST OPTIONS...]
# BUILD is the build folder that has the command; wheel and environment go to BUILD/python. With
# ZIPACT_SANITIZE=address,undefined in the environment, under these sanitizers.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
shift
sanitize=${ZIPACT_SANITIZE:-}
folder=$build/python${sanitize:+-sanitized}
python=/usr/bin/python3 # Debian's, which has numpy
"$root/scripts/deps.sh" --python

mkdir -p "$folder"
rm -rf "$folder/wheel" "$folder/venv"
log=$folder/wheel.log
$python -m pip wheel --no-build-isolation --no-deps --no-index -w "$folder/wheel" "$root/python" >"$log" 2>&1 || {
  cat "$log"
  exit 1
}
$python -m venv --system-site-packages "$folder/venv"
"$folder/venv/bin/pip" install -q --no-index "$folder"/wheel/zipact-*.whl

export ZIPACT_COMMAND="$build/zipact" MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
if [ -n "$sanitize" ]; then
  # The interpreter is not built with the sanitizer and leaks on purpose.
  LD_PRELOAD="$(cc -print-file-name=libasan.so) $(cc -print-file-name=libubsan.so)"
  export LD_PRELOAD ASAN_OPTIONS=detect_leaks=0 PYTHONMALLOC=malloc
fi
cd "$folder"
exec venv/bin/python -m pytest -q -p no:cacheprovider "$root/python/tests" "$@"
