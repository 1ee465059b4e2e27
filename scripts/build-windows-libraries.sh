#!/bin/sh
# The libraries of the command for Windows, static, from Debian's sources, in FOLDER:   build-windows-libraries.sh FOLDER
# The sources come by apt-get with lists of their own, so the lists of this machine stay as they are. Once made, they stay.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$1"
prefix=$(cd "$1" && pwd)
[ -e "$prefix/complete" ] && exit 0
host=x86_64-w64-mingw32
work=$prefix/work
rm -rf "${prefix:?}"/*
mkdir -p "$work/lists/partial" "$prefix/lib/pkgconfig" "$prefix/include"
cd "$work"

# This machine's lists of binary packages, as lists of sources.
sources() {
  mkdir parts
  cat /etc/apt/sources.list.d/*.sources 2>/dev/null | sed 's/^Types:.*/Types: deb-src/' >parts/here.sources
  cat /etc/apt/sources.list 2>/dev/null | sed -n 's/^deb /deb-src /p' >parts/here.list
  own="-o Dir::State::lists=$work/lists -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts=$work/parts"
  # shellcheck disable=SC2086
  apt-get $own update
  # shellcheck disable=SC2086
  apt-get $own source --download-only libfyaml jansson nlopt sqlite3 libzip zlib
  for archive in *.orig.tar.*; do tar -x -f "$archive"; done
}

# describe NAME VERSION LIBRARIES: for pkg-config
describe() {
  printf 'Name: %s\nDescription: %s\nVersion: %s\nLibs: -L%s/lib %s\nCflags: -I%s/include\n' "$1" "$1" "$2" "$prefix" "$3" "$prefix" \
    >"$prefix/lib/pkgconfig/$1.pc"
}

# with_cmake FOLDER OPTIONS...   NLopt asks for a C++ compiler, and its algorithms in C++ are left out.
with_cmake() {
  cmake -S "$1" -B "build-$1" -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 -DCMAKE_C_COMPILER=$host-gcc \
    -DCMAKE_CXX_COMPILER=$host-gcc -DCMAKE_CXX_COMPILER_WORKS=1 -DCMAKE_RC_COMPILER=$host-windres -DCMAKE_BUILD_TYPE=Release \
    -DBUILD_SHARED_LIBS=OFF -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_FIND_ROOT_PATH="$prefix" \
    -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY "$@"
  cmake --build "build-$1" -j "$(nproc)"
  cmake --install "build-$1"
}

# compile NAME OPTIONS... -- FILES...
compile() {
  name=$1 options=""
  shift
  while [ "$1" != -- ]; do options="$options $1"; shift; done
  shift
  mkdir -p "objects-$name"
  for file in "$@"; do
    # shellcheck disable=SC2086
    $host-gcc -O2 -w $options -c "$file" -o "objects-$name/$(basename "$file" .c).o"
  done
  $host-ar rcs "$prefix/lib/lib$name.a" "objects-$name"/*.o
}

version_of() { ls -d "$1"-[0-9]* | sed "s/^$1-//"; }

sources
with_cmake "jansson-$(version_of jansson)" -DJANSSON_BUILD_DOCS=OFF -DJANSSON_WITHOUT_TESTS=ON -DJANSSON_EXAMPLES=OFF
with_cmake "nlopt-$(version_of nlopt)" -DNLOPT_CXX=OFF -DNLOPT_PYTHON=OFF -DNLOPT_OCTAVE=OFF -DNLOPT_MATLAB=OFF -DNLOPT_GUILE=OFF \
  -DNLOPT_SWIG=OFF -DNLOPT_TESTS=OFF
mv "$prefix/lib/nlopt.lib" "$prefix/lib/libnlopt.a"

zlib=zlib-$(version_of zlib)
compile z -- "$zlib"/*.c
cp "$zlib/zlib.h" "$zlib/zconf.h" "$prefix/include/"
zip=libzip-$(version_of libzip)
with_cmake "$zip" -DENABLE_COMMONCRYPTO=OFF -DENABLE_GNUTLS=OFF -DENABLE_MBEDTLS=OFF -DENABLE_OPENSSL=OFF \
  -DENABLE_WINDOWS_CRYPTO=OFF -DENABLE_BZIP2=OFF -DENABLE_LZMA=OFF -DBUILD_TOOLS=OFF -DBUILD_REGRESS=OFF -DBUILD_EXAMPLES=OFF \
  -DBUILD_DOC=OFF -DZLIB_LIBRARY="$prefix/lib/libz.a" -DZLIB_INCLUDE_DIR="$prefix/include"
describe libzip "${zip#libzip-}" "-lzip -lz"

sqlite=sqlite3-$(version_of sqlite3)
(cd "$sqlite" && ./configure --disable-tcl --disable-readline && make sqlite3.c)
compile sqlite3 -DSQLITE_THREADSAFE=1 -DSQLITE_OMIT_LOAD_EXTENSION -- "$sqlite/sqlite3.c"
cp "$sqlite/sqlite3.h" "$prefix/include/"
describe sqlite3 "${sqlite#sqlite3-}" -lsqlite3

yaml=libfyaml-$(version_of libfyaml)
compile fyaml -D_GNU_SOURCE -D__USE_MINGW_ANSI_STDIO=1 "-DVERSION=\"${yaml#libfyaml-}\"" -I"$root/windows/include" \
  -include "$root/windows/posix.h" -I"$yaml/include" -I"$yaml/src/lib" -I"$yaml/src/xxhash" -- "$yaml"/src/lib/*.c "$yaml"/src/xxhash/*.c
cp -r "$yaml/include/." "$prefix/include/"
describe libfyaml "${yaml#libfyaml-}" -lfyaml
mkdir "$prefix/licences"
for name in jansson nlopt libzip libfyaml; do
  for file in LICENSE COPYING COPYRIGHT; do
    text=$name-$(version_of $name)/$file
    [ ! -e "$text" ] || cp "$text" "$prefix/licences/$name-$file"
  done
done
cp "$zlib/README" "$prefix/licences/zlib-README"
rm -rf "$work"
touch "$prefix/complete"
