#!/bin/sh
# Same bits from every compiler, at every optimisation, on every processor:  sh tests/bits.sh [CC...]
#
# Builds the core and tests/bits.c with each compiler at -O0 and -O3 in a temporary folder, runs all, and compares what
# they print. The last line is "N passed, N failed"; exit status 1 if any differs. Unless compilers are named they are gcc
# and, where it is there, clang, this at -O3 only: it evaluates in the same order at -O0. gcc also compiles for each width of
# vectors that this processor has; without that, it picks the widest when the program starts.
#   sh tests/bits.sh --built gcc LIBRARY     takes that library, which gcc has made at -O3, instead of making it again
# What a compiler for another processor makes runs in qemu-user:
#   sh tests/bits.sh gcc aarch64-linux-gnu-gcc

repo=$(cd "$(dirname "$0")/.." && pwd) || exit 2
built="" library=""
if [ "${1:-}" = --built ]; then
  built=$2 library=$3
  shift 3
fi
levels_of_clang="-O0 -O3"
if [ $# -eq 0 ]; then
  for cc in gcc clang; do
    command -v $cc >/dev/null && set -- "$@" $cc
  done
  levels_of_clang=-O3
fi
[ $# -gt 0 ] || { echo "bits.sh: no compiler"; exit 2; }
folder=$(mktemp -d) || exit 2
trap 'rm -rf "$folder"' EXIT

flags="-std=c17 -D_GNU_SOURCE -fopenmp-simd -fno-math-errno -ffp-contract=off"
sources=$(find "$repo/src" -name '*.c' ! -path '*/src/io/*' ! -path '*/src/fit/*' ! -path '*/src/campaign/*' ! -path '*/src/sample/*' ! -path '*/src/optimize/*' ! -path '*/src/fmu/*' ! -path '*/src/fmupack/*' | sort)

widths="v2"
! grep -q -w avx2 /proc/cpuinfo || widths="$widths v3"
! grep -q -w avx512vl /proc/cpuinfo || widths="$widths v4"

passed=0
failed=0
here=$(uname -m)
for cc in "$@"; do
  target=$($cc -dumpmachine | cut -d - -f 1)
  run="" static=""
  [ "$target" = "$here" ] || { run=qemu-$target static=-static; }
  levels="-O0 -O3"
  [ "$cc" != clang ] || levels=$levels_of_clang
  [ "$cc$target" != gccx86_64 ] || levels="$levels $widths"
  for level in $levels; do
    name=$(basename "$cc")$level
    case $level in
    v*)
      name="$cc for x86-64-$level"
      level="-O3 -march=x86-64-$level -DZP_KERNEL="
      ;;
    esac
    core=$sources
    [ "$cc$level" != "$built-O3" ] || core="-fno-lto $library"
    # shellcheck disable=SC2086
    if ! $cc $flags $level -I"$repo/include" -I"$repo/src" "$repo/tests/bits.c" $core $static -lm -o "$folder/$name"; then
      echo "$name: does not build"
      failed=$((failed + 1))
    elif ! $run "$folder/$name" >"$folder/$name.txt"; then
      echo "$name: failed: $(tail -n 1 "$folder/$name.txt" | cut -c 1-200)"
      failed=$((failed + 1))
    elif [ -z "$first" ]; then
      first=$name # what the others are compared with; must say enough to be worth it
      lines=$(wc -l <"$folder/$name.txt")
      echo "$name: $lines lines"
      if [ "$lines" -gt 500 ]; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
    elif cmp -s "$folder/$first.txt" "$folder/$name.txt"; then
      passed=$((passed + 1))
    else
      echo "$name differs from $first first in:"
      cmp "$folder/$first.txt" "$folder/$name.txt"
      diff "$folder/$first.txt" "$folder/$name.txt" | head -4 | cut -c 1-200
      failed=$((failed + 1))
    fi
  done
done
echo "$passed passed, $failed failed"
[ $failed -eq 0 ]
