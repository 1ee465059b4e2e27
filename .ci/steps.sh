# Sourced by the other scripts of this folder: steps with their times, builds, steps beside others, steps that are resumed.
# shellcheck shell=bash
jobs=$(nproc)

cpu_seconds() { # [PID]: of this script, or that process, and all that it has waited for
  awk -v tick="$(getconf CLK_TCK)" '{ printf "%d", ($14 + $15 + $16 + $17) / tick }' "/proc/${1:-$$}/stat"
}

step() { printf '\n== %s (%d s, %d s of CPU)\n' "$*" "$SECONDS" "$(cpu_seconds)"; }

quietly() { # quietly COMMAND...: its output only if it fails
  local log
  log=$(mktemp)
  "$@" >"$log" 2>&1 || { cat "$log"; rm -f "$log"; return 1; }
  rm -f "$log"
}

configure() { # configure DIR OPTIONS...
  quietly cmake -S . -B "$@"
}

build() { # build DIR [OPTIONS...]
  quietly cmake --build "$@" -j "$jobs"
}

sanitized() { # sanitized DIR SANITIZERS: paths, not speed
  configure "$1" -DCMAKE_C_COMPILER=gcc -DZIPACT_SANITIZE="$2" -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_C_FLAGS_RELWITHDEBINFO="-O1 -g1"
}

by_clang() { # DIR: warnings are errors; nothing of it runs
  configure "$1" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DZIPACT_WERROR=ON -DCMAKE_BUILD_TYPE=Debug -DCMAKE_C_FLAGS_DEBUG=-O0
}

touched() { [ -n "$(.ci/changed "$@")" ]; } # PATH...: has something there changed?

tests() { (cd "$1" && ctest --output-on-failure -j "$jobs" "${@:2}"); } # tests DIR [OPTIONS...]

# begin NAME COMMAND... runs it beside the next steps; finish NAME waits for it and shows what it printed. Each is a group
# of processes, of which none outlives the script, however that ends.
beside=$(mktemp -d)
declare -A group=()
# shellcheck disable=SC2154
trap 'for name in "${!group[@]}"; do kill -- "-${group[$name]}" 2>/dev/null || true; done; rm -rf "$beside"' EXIT

begin() {
  set -m # a group of its own
  "${@:2}" >"$beside/$1" 2>&1 &
  set +m
  group[$1]=$!
}

finish() {
  wait "${group[$1]}" || { cat "$beside/$1"; exit 1; }
  unset "group[$1]"
  tail -n 9 "$beside/$1"
}

# Without the random layout of memory, which ThreadSanitizer takes for a fault on some kernels.
unless_forbidden="setarch $(uname -m) -R"
$unless_forbidden true 2>/dev/null || unless_forbidden=""

# Names the sources; random designs without an answer, which a step adds, and results are none.
sources() { (git rev-parse HEAD && git diff HEAD -- . ':!tests/designs.txt' ':!.ci/weekly.txt') | sha1sum | cut -c 1-12; }

# each FOLDER [--again] STEP...: runs the steps, each a function, that have not passed with the same sources; --again runs all.
# What a step prints is in FOLDER/STEP.log; the summary is printed and kept in FOLDER/summary. Status 1 if a step has failed;
# the others run all the same.
each() {
  local folder=$1 of name began cpu result shell
  shift
  mkdir -p "$folder"
  of=$(sources)
  [ "$1" != --again ] || { rm -f "$folder"/*.passed && shift; }
  {
    shell=$BASHPID
    echo "commit $(git rev-parse --short HEAD)$(git diff --quiet HEAD || echo ' with changes'), $(date +%F)"
    for name in "$@"; do
      if [ "$(head -n 1 "$folder/$name.passed" 2>/dev/null)" != "$of" ]; then
        rm -f "$folder/$name.passed"
        began=$SECONDS cpu=$(cpu_seconds "$shell") result=passed
        ("$name") >"$folder/$name.log" 2>&1 || result=FAILED
        printf '%s\n%-12s %s %6d s %6d s of CPU\n' "$of" "$name" $result $((SECONDS - began)) $(($(cpu_seconds "$shell") - cpu)) >"$folder/$name.ended"
        [ $result = FAILED ] || cp "$folder/$name.ended" "$folder/$name.passed"
      fi
      tail -n 1 "$folder/$name.ended"
    done
  } | tee "$folder/summary"
  [ "$(grep -c FAILED "$folder/summary")" -eq 0 ]
}
