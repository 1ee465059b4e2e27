#!/bin/sh
# Builds Debian packages of this tree in BUILD-deb, looks at them with lintian, and runs their test with the files
# of the package:   scripts/make-deb.sh [BUILD]
# Needs debhelper, lintian and what scripts/deps.sh installs.
set -eu
cd "$(dirname "$0")/.."
build=$(mkdir -p "${1:-build}-deb" && cd "${1:-build}-deb" && pwd)
version=$(sed -n '1s/.*(\(.*\)).*/\1/p' packaging/debian/changelog)
rm -rf "${build:?}"/*
# as in .gitignore; the tree may have no history
tar -c --exclude-vcs --exclude='./build*' --exclude=./out --exclude='*.egg-info' --exclude=__pycache__ \
  --exclude=node_modules --exclude=./web/dist --transform="s|^\.|zipact-$version|" . | tar -x -C "$build"
cp -r packaging/debian "$build/zipact-$version/debian"
cd "$build/zipact-$version"
DEB_BUILD_OPTIONS="parallel=$(nproc) ${DEB_BUILD_OPTIONS:-}" dpkg-buildpackage -us -uc -b >"$build/build.log" 2>&1 || {
  tail -n 30 "$build/build.log" >&2
  exit 1
}
cd "$build"
# The maintainer's address is a placeholder: whoever publishes the packages puts in their own.
lintian --allow-root --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog ./*.changes
mkdir tree
dpkg-deb -x "$(ls zipact_*.deb)" tree
PATH=$build/tree/usr/bin:$PATH "zipact-$version/debian/tests/zip"
ls -1 "$build"/*.deb
