#!/bin/sh
# scripts/deps.sh with an apt-get that pretends: it waits for a lock that others hold, says what it downloads and that it is
# alive, and shows the reason where a package cannot be had.   deps.sh SCRATCH
set -eu
here=$(cd "$(dirname "$0")/.." && pwd) scratch=$1
rm -rf "$scratch"
mkdir -p "$scratch/bin"
fake() {
  cat >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
fake id <<'FAKE'
#!/bin/sh
echo 0
FAKE
fake dpkg-query <<'FAKE'
#!/bin/sh
exit 1
FAKE
fake sleep <<'FAKE'
#!/bin/sh
exec /bin/sleep 0.05
FAKE
fake apt-get <<'FAKE'
#!/bin/sh
case "$*" in
*--print-uris*) echo "Need to get 42.0 MB of archives." && exit ;;
update) exit ;;
esac
echo "Get:1 gcc"
# until that is said, for a minute at most
for _ in $(seq 600); do
  ! grep -q "^  Get:1 gcc" "$SCRATCH/out" || break
  /bin/sleep 0.1
done
if [ "$1" = install ] && [ -e "$SCRATCH/gone" ]; then
  echo "E: Unable to locate package gcc" && exit 100
fi
[ -e "$SCRATCH/second" ] && exit
: >"$SCRATCH/second"
echo "E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 7 (apt-get)" >&2
exit 100
FAKE
failed=0
expect() { # expect STATUS TEXT...: what deps.sh ends with and prints
  wanted=$1 status=0
  shift
  SCRATCH="$scratch" PATH="$scratch/bin:$PATH" "$here/scripts/deps.sh" >"$scratch/out" 2>&1 || status=$?
  for text in "$@"; do
    grep -q "$text" "$scratch/out" || status="$status, without '$text'"
  done
  [ "$status" = "$wanted" ] && return
  failed=$((failed + 1))
  echo "exit status $status instead of $wanted:"
  cat "$scratch/out"
}
expect 0 "installing: gcc" "Need to get 42.0 MB" "  Get:1 gcc" "waiting .* held by process 7"
: >"$scratch/gone"
expect 1 "E: Unable to locate package gcc"
echo "$((2 - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
