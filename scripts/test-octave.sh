#!/bin/sh
# Builds the MEX function of octave/ into BUILD/octave, with all that goes with it, and tests it in Octave.
#   scripts/test-octave.sh BUILD [--all] [--build | --built] [FILES...]
# BUILD is the build folder that has the libraries. FILES are tests, by default octave/tests/test_*.m.
#   --all    also octave/tests/nightly_*.m, which compute at length
#   --build  builds only
#   --built  tests what is built there
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)
shift
all="" steps="build test"
while :; do
  case "${1:-}" in
  --all) all=yes ;;
  --build) steps=build ;;
  --built) steps="test" ;;
  *) break ;;
  esac
  shift
done
folder=$build/octave

if [ "$steps" != test ]; then
  "$root/scripts/deps.sh" --octave
  mkdir -p "$folder"
  cp "$root"/octave/*.m "$folder"
  libraries=$(pkg-config --libs libfyaml udunits jansson hdf5-serial nlopt sqlite3)
  cd "$folder"
  # shellcheck disable=SC2086
  CFLAGS="-std=c17 -D_GNU_SOURCE -O2 -fPIC -Wall -Wextra -Werror -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3" \
    mkoctfile --mex -o zipact_mex -I"$root/include" -fno-lto -Wl,--exclude-libs,ALL -Wl,-z,relro,-z,now "$root"/octave/src/*.c \
    "$build/libzipact-io.a" "$build/libzipact.a" $libraries -lm -lpthread
  rm -f ./*.o
  python3 "$root/tests/test_binaries.py" --fortified zipact_mex.mex
fi
[ "$steps" != build ] || exit 0

export ZIPACT_COMMAND="$build/zipact"
[ $# -gt 0 ] || set -- "$root"/octave/tests/test_*.m ${all:+"$root"/octave/tests/nightly_*.m}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
for test in "$@"; do
  octave-cli --no-init-file --no-history --path "$folder" --path "$root/octave/tests" --path "$root/octave/examples" "$test"
done
