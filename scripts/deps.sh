#!/bin/sh
# Installs what zipact needs to build, test and draw. On Debian and Ubuntu by apt, with sudo if not root;
# elsewhere it lists what is needed. Says what it downloads and how far it is, and waits while another program holds apt's
# lock; does nothing where all is there.
#   scripts/deps.sh          build, run and check
#   scripts/deps.sh --python what the Python package, its tests and pictures need
#   scripts/deps.sh --octave what the MEX function, its tests and pictures need
#   scripts/deps.sh --ci     also clang, the sanitizers' runtimes and the checkers that .ci/run uses, and what builds and tries FMUs for Windows
#   scripts/deps.sh --weekly also what compiles for another processor and runs that
#   scripts/deps.sh --windows also what builds the command for Windows and tries it
#   scripts/deps.sh --docs   also what makes the manual's HTML
#   scripts/deps.sh --browser    also the browser that scripts/check-report.sh looks at pages with
#   scripts/deps.sh --web    also what scripts/web.sh needs: clang for WebAssembly, node, two browsers for its tests
set -eu
packages="gcc g++ make cmake pkg-config libhdf5-dev libfyaml-dev libudunits2-dev libjansson-dev libnlopt-dev libsqlite3-dev libopenmpi-dev openmpi-bin libzip-dev libxml2-dev libxml2-utils check liblapack-dev gnuplot-nox
 fonts-dejavu-core python3 python3-h5py python3-yaml python3-jsonschema ca-certificates"
[ "${1:-}" = --python ] && packages="$packages python3-dev python3-pip python3-setuptools python3-wheel python3-venv python3-numpy
 python3-h5py python3-matplotlib python3-pandas python3-pytest python3-distributed python3-nbclient python3-nbformat python3-ipykernel python3-mpi4py openmpi-bin"
[ "${1:-}" = --octave ] && packages="$packages octave octave-dev fonts-freefont-otf"
[ "${1:-}" = --ci ] && packages="$packages clang clang-format clang-tidy cppcheck libclang-rt-14-dev valgrind ngspice zsh fish groff debhelper lintian gcc-mingw-w64-x86-64-posix wine64"
[ "${1:-}" = --weekly ] && packages="$packages gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user"
[ "${1:-}" = --windows ] && packages="$packages gcc-mingw-w64-x86-64-posix wine64 tcl"
[ "${1:-}" = --docs ] && packages="$packages pandoc doxygen fonts-dejavu-extra"
[ "${1:-}" = --browser ] && packages="$packages chromium"
if [ "${1:-}" = --web ]; then
  packages="$packages clang lld wasi-libc libclang-rt-14-dev-wasm32 chromium firefox-esr"
  command -v npm >/dev/null 2>&1 || packages="$packages nodejs npm"
fi

if ! command -v apt-get >/dev/null 2>&1 || ! command -v dpkg-query >/dev/null 2>&1; then
  missing=""
  for tool in cc cmake make pkg-config gnuplot python3; do
    command -v $tool >/dev/null 2>&1 || missing="$missing $tool"
  done
  for library in hdf5 libfyaml udunits jansson nlopt sqlite3 libzip libxml-2.0 check; do
    pkg-config --exists $library 2>/dev/null || missing="$missing $library"
  done
  [ -z "$missing" ] && exit 0
  echo "zipact needs, and this system has no apt-get to install:$missing" >&2
  echo "(a C17 compiler, cmake 3.22, make, pkg-config, HDF5, libfyaml, UDUNITS-2, jansson, NLopt, SQLite, libzip, libxml2, Check, gnuplot, python3 with h5py)" >&2
  exit 1
fi

missing=""
for package in $packages; do
  state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$state" = installed ] || missing="$missing $package"
done
[ -z "$missing" ] && exit 0

as_root=""
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null 2>&1; then
    echo "zipact needs these packages; install them as root: apt-get install$missing" >&2
    exit 1
  fi
  as_root=sudo
fi
log=$(mktemp)
watcher=""
trap 'rm -f "$log"; [ -z "$watcher" ] || kill "$watcher" 2>/dev/null || true' EXIT
trap 'exit 130' INT TERM

# What apt-get is at, every 10 s, as long as this script lives: it may be killed.
report() {
  while sleep 10 >/dev/null && kill -0 $$ 2>/dev/null; do
    echo "  $(tail -n 1 "$log" | cut -c 1-110)"
  done
}

# apt-get ARGUMENTS, output in the log; waits up to half an hour for whoever holds apt's lock.
apt() {
  waited=0
  while true; do
    report &
    watcher=$!
    status=0
    $as_root env DEBIAN_FRONTEND=noninteractive LC_ALL=C apt-get "$@" >"$log" 2>&1 || status=$?
    kill "$watcher" 2>/dev/null || true
    watcher=""
    if [ "$status" -eq 0 ]; then return 0; fi
    if ! grep -q -E 'Could not get lock|Unable to (acquire|lock)|locked by another process' "$log" || [ "$waited" -ge 1800 ]; then return 1; fi
    echo "  waiting for another program to finish: $(grep -m 1 -E 'lock' "$log" | cut -c 1-110)"
    sleep 5
    waited=$((waited + 5))
  done
}

update() {
  echo "reading the lists of packages"
  apt update || { cat "$log" >&2; exit 1; }
}

install() {
  # shellcheck disable=SC2086
  apt install -y --no-install-recommends "$@" $missing
}

install --print-uris || update # a new machine has no lists
install --print-uris || { cat "$log" >&2; exit 1; }
echo "installing:$missing"
grep '^Need to get' "$log" || true
if ! install; then # an old list is the usual reason
  update
  install || { cat "$log" >&2; exit 1; }
fi
