#!/bin/sh
# Builds the page web/dist/index.html: the core as WebAssembly, then all of web/page/ with it in one file.
#   scripts/web.sh         build
#   scripts/web.sh --test  build, and test it against the command and once in Chromium
#   scripts/web.sh --all   the same, with web/test/nightly/: what people do with it in two browsers, hostile links, editors
# The command of the tests is in ZIPACT, by default build/zipact.
set -eu
cd "$(dirname "$0")/.."
scripts/deps.sh --web
make --no-print-directory -f web/core.mk -j "$(nproc)"

cd web
if ! cmp -s package-lock.json node_modules/.installed; then
  npm ci --ignore-scripts --loglevel=error
  cp package-lock.json node_modules/.installed
fi
npm run --silent build
case "${1:-}" in
--test) npm test --silent ;;
--all) npm test --silent -- test/nightly/*.test.mjs ;;
esac
