# Sourced by the other scripts of this folder: steps with their times, builds, and steps beside others.
# shellcheck shell=bash
jobs=$(nproc)

cpu_seconds() { # of this script and all that it has waited for
  awk -v tick="$(getconf CLK_TCK)" '{ printf "%d", ($14 + $15 + $16 + $17) / tick }' /proc/$$/stat
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
