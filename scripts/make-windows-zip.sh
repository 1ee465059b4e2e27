#!/bin/sh
# zipact for Windows, x86-64, as a zip: the command, which needs no other file; the kit for FMUs; examples; the library with its
# headers, an example and that example's program. Tried under wine: a run, a sweep, an FMU and the program must give what they
# give here, to the last byte.   make-windows-zip.sh BUILD
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
here=$(cd "$1" && pwd)
build=$here/win64
wine=$(command -v wine64 || command -v wine || echo /usr/lib/wine/wine64)
compiler=x86_64-w64-mingw32-gcc
quietly() { "$@" >"$build.log" 2>&1 || { cat "$build.log"; exit 1; }; }

"$root/scripts/deps.sh" --windows
quietly "$root/scripts/build-windows-libraries.sh" "$here/win64-libraries"
PKG_CONFIG_LIBDIR=$here/win64-libraries/lib/pkgconfig quietly cmake -S "$root" -B "$build" -DCMAKE_SYSTEM_NAME=Windows \
  -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=$compiler -DCMAKE_BUILD_TYPE=Release -DZIPACT_TESTS=OFF -DZIPACT_IO=ON
quietly cmake --build "$build" -j "$(nproc)" --target zipact zipact_static zipact_command

version=$(sed -n 's/.*ZP_VERSION "\(.*\)".*/\1/p' "$root/include/zipact/version.h")
name=zipact-$version-windows-x86_64
folder=$build/$name
rm -rf "$folder" "$folder.zip"
mkdir -p "$folder/bin" "$folder/lib" "$folder/include/zipact"
cp "$build"/*zipact*.dll "$build/zipact.exe" "$folder/bin/"
x86_64-w64-mingw32-strip "$folder/bin/zipact.exe"
cp -r "$build/fmu" "$folder/bin/fmu"
cp "$build"/libzipact.dll.a "$folder/lib/"
cp "$root"/include/zipact/*.h "$root"/include/zipact/*.def "$folder/include/zipact/"
cp -r "$root/examples" "$folder/examples"
cp -r "$here/win64-libraries/licences" "$folder/licences"
cp "$root/LICENSE" "$folder/"
cp "$root/docs/scenario.schema.json" "$folder/"
$compiler -O2 -o "$folder/bin/embedded.exe" "$folder/examples/embedded.c" -I"$folder/include" -L"$folder/lib" -lzipact

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
quietly cmake --build "$here" --target zipact_static zipact_command

# try NAME RUN...: the program of the zip
try() {
  (cd "$scratch/wine" && WINEPREFIX=$build/wine WINEDEBUG=-all DISPLAY="" "$wine" "$folder/bin/$1.exe" "$2" "$3" -o "$4" --quiet)
}

if [ -x "$wine" ]; then
  mkdir "$scratch/wine" "$scratch/here"
  cc -fno-lto -o "$scratch/embedded" "$root/examples/embedded.c" -I"$root/include" "$here/libzipact.a" -lm
  "$scratch/embedded" >"$scratch/embedded.txt"
  WINEPREFIX=$build/wine WINEDEBUG=-all DISPLAY="" "$wine" "$folder/bin/embedded.exe" | tr -d '\r' | diff "$scratch/embedded.txt" -
  cp -r "$root/examples" "$scratch/wine/"
  cp -r "$root/examples" "$scratch/here/"
  for run in demo limits; do
    try zipact run "examples\\$run.yaml" "out\\$run" 2>"$scratch/said.txt" || { cat "$scratch/said.txt"; exit 1; }
    (cd "$scratch/here" && "$here/zipact" run "examples/$run.yaml" -o "out/$run" --quiet --no-plots)
    cmp "$scratch/here/out/$run/table.csv" "$scratch/wine/out/$run/table.csv"
  done
  echo "under wine: examples/demo.yaml and limits.yaml give the same bytes; $(cat "$scratch/embedded.txt")"
else
  echo "no wine here: not tried"
fi
(cd "$build" && python3 -m zipfile -c "$name.zip" "$name")
echo "$folder.zip"
