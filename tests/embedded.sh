#!/bin/sh
# An installed zipact is found by pkg-config and by CMake, and the programs of examples/ that use the library
# build against it.   embedded.sh BUILD_DIR SCRATCH
set -eu
build=$1 scratch=$2
here=$(cd "$(dirname "$0")/.." && pwd)
rm -rf "$scratch"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
pc=$(find "$scratch/prefix" -name zipact.pc)
export PKG_CONFIG_PATH="${pc%/*}" LD_LIBRARY_PATH="${pc%/*/*}"
# a library built with sanitizers asks its user for the same
flags=$(sed -n 's/^ZIPACT_SANITIZE:STRING=\(..*\)$/-fsanitize=\1/p' "$build/CMakeCache.txt")
flags="$flags -fno-lto" # quick to link
# shellcheck disable=SC2046,SC2086
cc $flags -o "$scratch/by_pkg_config" "$here/examples/embedded.c" $(pkg-config --cflags --libs zipact)
"$scratch/by_pkg_config"
# shellcheck disable=SC2046,SC2086
cc $flags -Wall -Wextra -Werror -o "$scratch/network" "$here/examples/network.c" $(pkg-config --cflags --libs zipact) -lm
"$scratch/network"
mkdir "$scratch/project"
cp "$here/examples/embedded.c" "$scratch/project/"
cat >"$scratch/project/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(user C)
find_package(zipact REQUIRED)
add_executable(by_cmake embedded.c)
target_link_libraries(by_cmake zipact::static)
CMAKE
cmake -S "$scratch/project" -B "$scratch/project/build" -DCMAKE_PREFIX_PATH="$scratch/prefix" \
  -DCMAKE_C_FLAGS="$flags" >/dev/null
cmake --build "$scratch/project/build" >/dev/null
"$scratch/project/build/by_cmake"
echo "3 passed, 0 failed"
