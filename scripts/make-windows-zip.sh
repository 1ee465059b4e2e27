#!/bin/sh
# The library for Windows, x86-64, as a zip: zipact.dll, its import library, headers, an example and the example's program. The
# command is not in it: HDF5, libfyaml and the others are not here for Windows. Tried under wine: the program must print what it
# prints here.   make-windows-zip.sh BUILD
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
build=$(cd "$1" && pwd)/win64
wine=$(command -v wine64 || command -v wine || echo /usr/lib/wine/wine64)
compiler=x86_64-w64-mingw32-gcc
command -v $compiler >/dev/null || { echo "$compiler is missing: scripts/deps.sh --ci installs it" >&2; exit 1; }
quietly() { "$@" >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }; }

quietly cmake -S "$root" -B "$build" -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=$compiler \
  -DCMAKE_BUILD_TYPE=Release -DZIPACT_IO=OFF -DZIPACT_TESTS=OFF
quietly cmake --build "$build" -j "$(nproc)" --target zipact zipact_static

version=$(sed -n 's/.*ZP_VERSION "\(.*\)".*/\1/p' "$root/include/zipact/version.h")
name=zipact-$version-windows-x86_64
folder=$build/$name
rm -rf "$folder" "$folder.zip"
mkdir -p "$folder/bin" "$folder/lib" "$folder/include/zipact"
cp "$build"/*zipact*.dll "$folder/bin/"
cp "$build"/libzipact.dll.a "$folder/lib/"
cp "$root"/include/zipact/*.h "$root"/include/zipact/*.def "$folder/include/zipact/"
cp "$root/LICENSE" "$root/examples/embedded.c" "$folder/"
$compiler -O2 -o "$folder/bin/embedded.exe" "$folder/embedded.c" -I"$folder/include" -L"$folder/lib" -lzipact

here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
quietly cmake --build "$1" --target zipact_static
cc -fno-lto -o "$here/embedded" "$root/examples/embedded.c" -I"$root/include" "$1/libzipact.a" -lm
"$here/embedded" >"$here/here.txt"
if [ -x "$wine" ]; then
  WINEPREFIX=$build/wine WINEDEBUG=-all DISPLAY="" "$wine" "$folder/bin/embedded.exe" | tr -d '\r' >"$here/wine.txt"
  diff "$here/here.txt" "$here/wine.txt"
  echo "under wine: $(cat "$here/wine.txt")"
else
  echo "no wine here: not tried"
fi
(cd "$build" && python3 -m zipfile -c "$name.zip" "$name")
echo "$folder.zip"
