#!/bin/sh
# Builds the page web/dist/index.html: the core as WebAssembly, then all of web/page/ with it in one file.
#   scripts/web.sh         build
#   scripts/web.sh --test  build, and test it against the command and in a browser
set -eu
cd "$(dirname "$0")/.."
scripts/deps.sh --web
mkdir -p web/build

# The core without what reads or writes files (web/units.c stands in for it) and without one law, the two-dimensional
# field: its line of terms.def and its study are left out, with all that only they need. Without -fno-slp-vectorize,
# clang 14 gives wrong factors of band matrices of a fixed width (src/math/band.c); the tests against the command find that.
sources=$(find src/base src/def src/math src/ribbon src/electro src/contact src/liquid src/paper src/drive src/solve src/actuator src/term src/system src/rest \
  src/sim src/study -name '*.c' | sort | grep -v -E \
  -e 'term/field\.c|electro/(edges_fit|field|grid|surplus)\.c|math/skyline\.c|study/(profile|faces|bookkeeping)\.c')
# shellcheck disable=SC2086
clang --target=wasm32-wasi -O3 -fno-slp-vectorize -msimd128 -std=c17 -D_GNU_SOURCE -fopenmp-simd -fno-math-errno -ffp-contract=off -DZP_WITHOUT_FIELD \
  -Wall -Wextra -Werror -fvisibility=hidden -Iinclude -Isrc -mexec-model=reactor \
  $sources src/io/value.c src/io/number.c src/io/source.c src/io/unit_nouns.c web/*.c \
  -Wl,--export-dynamic -Wl,--strip-all -Wl,-z,stack-size=1048576 -o web/build/zipact.wasm

cd web
if ! cmp -s package-lock.json node_modules/.installed; then
  npm ci --ignore-scripts --loglevel=error
  cp package-lock.json node_modules/.installed
fi
npm run --silent build
if [ "${1:-}" = --test ]; then npm test --silent; fi
