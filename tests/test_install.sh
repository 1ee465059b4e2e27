#!/bin/sh
# make install and make uninstall:  test_install.sh BUILD SCRATCH
set -eu
build=$1 scratch=$2
here=$(cd "$(dirname "$0")/.." && pwd)
rm -rf "$scratch"
mkdir -p "$scratch/root"
failed=0
for_all() { # DESCRIPTION COMMAND...
  what=$1
  shift
  "$@" && return
  failed=$((failed + 1))
  echo "FAILED: $what"
}
DESTDIR="$scratch/root" cmake --install "$build" >/dev/null
cp "$build/install_manifest.txt" "$scratch/installed.txt"
prefix=$(sed -n 's|/bin/zipact$||p' "$scratch/installed.txt")
place=$scratch/root$prefix
for file in bin/zipact share/zipact/scenario.schema.json share/zipact/plots/style.gp share/man/man1/zipact.1 share/man/man1/zipact-limits.1 \
  share/bash-completion/completions/zipact share/zsh/site-functions/_zipact share/fish/vendor_completions.d/zipact.fish; do
  for_all "$file is installed" test -s "$place/$file"
done
echo mine >"$place/share/zipact/mine.yaml"
make -s -C "$here" uninstall BUILD="$build" INSTALLED="$scratch/installed.txt" DESTDIR="$scratch/root"
for_all "nothing is left but what is not ours: $(find "$scratch/root" -type f -o -type l)" \
  test "$(find "$scratch/root" -type f -o -type l)" = "$place/share/zipact/mine.yaml"
for_all "no folder of ours is left but that" test -z "$(find "$scratch/root" -type d -name zipact -not -path '*/share/zipact')"
if make -s -C "$here" uninstall BUILD="$build" INSTALLED="$scratch/installed.txt" DESTDIR="$scratch/root" 2>"$scratch/second"; then
  for_all "a second uninstall is refused" false
fi
for_all "and says why" grep -q 'nothing to uninstall' "$scratch/second"
echo "$((11 - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
