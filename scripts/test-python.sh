#!/bin/sh
# Builds the wheel of python/, installs it in a fresh virtual environment and runs its tests.
#   scripts/test-python.sh BUILD [--all] [--build | --built] [PYTEST OPTIONS...]
# BUILD is the build folder that has the command; its libraries are in the wheel. Wheel and environment go to BUILD/python. If
# it was built with sanitizers, the tests run under the same.
#   --all    also the tests marked nightly, which compute at length
#   --build  builds and installs only
#   --built  tests what is installed there
# A test file among the options, with its whole path, runs alone.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
shift
marked="not nightly" steps="build test"
while :; do
  case "${1:-}" in
  --all) marked="" ;;
  --build) steps=build ;;
  --built) steps="test" ;;
  *) break ;;
  esac
  shift
done
sanitize=$(sed -n 's/^ZIPACT_SANITIZE:STRING=//p' "$build/CMakeCache.txt")
folder=$build/python
python=/usr/bin/python3 # Debian's, which has numpy

if [ "$steps" != test ]; then
  "$root/scripts/deps.sh" --python
  mkdir -p "$folder"
  rm -rf "$folder/wheel" "$folder/venv"
  export ZIPACT_BUILD="$build" ZIPACT_SANITIZE="$sanitize"
  log=$folder/wheel.log
  $python -m pip wheel --no-build-isolation --no-deps --no-index -w "$folder/wheel" "$root/python" >"$log" 2>&1 || {
    cat "$log"
    exit 1
  }
  $python -m venv --system-site-packages "$folder/venv"
  CC=/bin/false "$folder/venv/bin/pip" install -q --no-index "$folder"/wheel/zipact-*.whl
  fortified=$([ -n "$sanitize" ] || echo --fortified)
  # shellcheck disable=SC2086
  $python "$root/tests/test_binaries.py" $fortified "$folder"/venv/lib/python3*/site-packages/zipact/_zipact*.so
fi
[ "$steps" != build ] || exit 0

export ZIPACT_COMMAND="$build/zipact" MPLBACKEND=agg PYTHONDONTWRITEBYTECODE=1
# The interpreter is not built with the sanitizer and leaks on purpose.
case "$sanitize" in
*address*) LD_PRELOAD="$(cc -print-file-name=libasan.so) $(cc -print-file-name=libubsan.so)" ;;
*thread*) LD_PRELOAD=$(cc -print-file-name=libtsan.so) ;;
esac
export ASAN_OPTIONS=detect_leaks=0 TSAN_OPTIONS=ignore_noninstrumented_modules=1
[ -z "$sanitize" ] || export LD_PRELOAD PYTHONMALLOC=malloc
case "$*" in *.py*) ;; *) set -- "$root/python/tests" "$@" ;; esac
cd "$folder"
exec venv/bin/python -m pytest -q -p no:cacheprovider -m "$marked" "$@"
