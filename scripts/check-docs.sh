#!/bin/sh
# Looks at the manual as a reader would: all links of the Markdown and of the HTML arrive; in Chromium, wide and narrow,
# nothing is cut off, formulas and pictures have a size, nothing comes from elsewhere; light and dark, words stand out.
# Needs `make html`, chromium (scripts/deps.sh --browser) and python3.
#   check-docs.sh HTML [SHOTS]      with SHOTS, screenshots of the pages go to that folder
set -eu
[ -d "$1" ] || { echo "$1: there is no manual; make html writes it" >&2; exit 1; }
site=$(cd "$1" && pwd) shots=${2:-}
here=$(dirname "$0")
scratch=$(mktemp -d)
trap 'kill "$server" 2>/dev/null || true; rm -rf "$scratch"' EXIT
browser() {
  timeout 300 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --hide-scrollbars --user-data-dir="$scratch/profile" "$@" 2>/dev/null
}
failed=0
python3 "$here/check-links.py" "$here/.." "$site" || failed=1

# One page of ours shows the manual's pages one by one in a frame, as no window is as narrow as a phone.
mkdir "$scratch/root"
ln -s "$site" "$scratch/root/manual"
(cd "$site" && find . -name '*.html' ! -path './api/search/*' ! -name index.html | sort) >"$scratch/pages"
python3 - "$scratch/pages" >"$scratch/root/look.html" <<'PYTHON'
import json, sys
print("<body style='margin:0'><pre id=found>nothing</pre><iframe id=frame height=900></iframe><script>const pages = %s;" %
      json.dumps(open(sys.argv[1]).read().split()))
print(r"""
// Contrast of text by WCAG: 3 is its least for large text; Doxygen's own pages are left out.
const light = color => color.match(/[\d.]+/g).slice(0, 3).map(v => v / 255)
  .map(v => v <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
function contrast(view, e) {
  const ink = light(view.getComputedStyle(e).color), paper = e => view.getComputedStyle(e).backgroundColor;
  let behind = e;
  while (behind.parentElement && /, 0\)$/.test(paper(behind))) behind = behind.parentElement;
  const below = light(/, 0\)$/.test(paper(behind)) ? "rgb(255, 255, 255)" : paper(behind));
  return (Math.max(ink, below) + 0.05) / (Math.min(ink, below) + 0.05);
}
function look(view) {
  const ours = !/\/api\//.test(view.location.pathname);
  const bad = [], wide = view.document.documentElement.clientWidth;
  const scrolls = e => e && (/auto|scroll/.test(view.getComputedStyle(e).overflowX) || scrolls(e.parentElement));
  for (const e of view.document.querySelectorAll("body *")) {
    const box = e.getBoundingClientRect(), what = e.tagName + " " + e.textContent.trim().slice(0, 40);
    if (box.width && box.right > wide + 1 && !scrolls(e)) bad.push("cut off: " + what);
    if (ours && box.width && [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim()) && contrast(view, e) < 3)
      bad.push("hard to read: " + what);
    if (e.tagName === "IMG" && e.complete && !e.naturalWidth) bad.push("no picture: " + e.src);
    if (e.tagName === "math" && (box.width < 3 || box.height < 8)) bad.push("no size: " + what);
    if (e.tagName === "merror" || e.classList.contains("math")) bad.push("formula not rendered: " + what);
  }
  for (const e of view.performance.getEntriesByType("resource"))
    if (!e.name.startsWith(location.origin)) bad.push("loaded from elsewhere: " + e.name);
  return bad;
}
async function all() {
  const bad = [];
  for (const page of pages) for (const width of [1280, 390]) {
    frame.width = width;
    await new Promise(done => { frame.onload = done; frame.src = "manual/" + page; });
    await frame.contentDocument.fonts.ready;
    bad.push(...look(frame.contentWindow).map(what => page + ", " + width + " px wide: " + what));
  }
  found.textContent = JSON.stringify({looked: 2 * pages.length, bad});
}
all();
</script></body>""")
PYTHON
: >"$scratch/log"
python3 -u -m http.server --bind 127.0.0.1 --directory "$scratch/root" 0 >"$scratch/log" 2>/dev/null &
server=$!
until port=$(sed -n 's/.* port \([0-9]*\) .*/\1/p' "$scratch/log") && [ -n "$port" ]; do sleep 0.1; done

see() { # see OPTION...: all pages
  browser "$@" --window-size=1400,1000 --virtual-time-budget=120000 --dump-dom "http://127.0.0.1:$port/look.html" >"$scratch/dom"
  python3 "$scratch/judge.py" "$scratch/dom" || failed=1
}
cat >"$scratch/judge.py" <<'PYTHON'
import html, json, re, sys
found = re.search(r'<pre id="found">(.*?)</pre>', open(sys.argv[1], encoding="utf-8").read(), re.S)
if not found or found.group(1) == "nothing":
    sys.exit("the pages did not load")
found = json.loads(html.unescape(found.group(1)))
print(*found["bad"], "pages: %d looked at, %d faults" % (found["looked"], len(found["bad"])), sep="\n")
sys.exit(1 if found["bad"] or not found["looked"] else 0)
PYTHON
see
see --blink-settings=preferredColorScheme=0 # dark

[ -z "$shots" ] || mkdir -p "$shots"
for width in ${shots:+1280 390}; do
  for page in README getting-started studies formats theory extending keys; do
    printf '<body style="margin:0"><iframe src="manual/docs/%s.html" style="border:0" width="%d" height="6000"></iframe></body>' \
      "$page" "$width" >"$scratch/root/shot.html"
    browser --window-size="$width,6000" --screenshot="$shots/$page-$width.png" "http://127.0.0.1:$port/shot.html" >&2
  done
done
[ "$failed" -eq 0 ] && echo "1 passed, 0 failed"
exit "$failed"
