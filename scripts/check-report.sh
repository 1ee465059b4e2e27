#!/bin/sh
# Looks at a page in Chromium as a reader would, wide and narrow: nothing is cut off, formulas and pictures have a size,
# links inside the page arrive, nothing comes from the network. Needs chromium (scripts/deps.sh --browser) and python3.
#   check-report.sh REPORT.html [SHOTS]      with SHOTS, screenshots go to that folder
set -eu
page=$1 shots=${2:-}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
browser() {
  timeout 120 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run --disable-background-networking \
    --disable-component-update --disable-sync --hide-scrollbars --user-data-dir="$scratch/profile" "$@" 2>/dev/null
}

# The page in a frame of a phone's width, as no window is that narrow; what it finds out about itself it tells its parent.
cat >"$scratch/look.js" <<'SCRIPT'
addEventListener("load", () => {
  const bad = [], all = [...document.querySelectorAll("body *")];
  const wide = document.documentElement.clientWidth;
  const scrolls = e => e && (getComputedStyle(e).overflowX === "auto" || scrolls(e.parentElement));
  for (const e of all) {
    const box = e.getBoundingClientRect();
    if (!e.closest("svg") && box.right > wide + 1 && !scrolls(e)) bad.push("cut off: " + e.tagName + " " + e.textContent.slice(0, 40));
    if ((e.tagName === "svg" || e.className === "formula") && (box.width < 20 || box.height < 10)) bad.push("no size: " + e.tagName);
    if (e.className === "over" && e.firstElementChild.getBoundingClientRect().bottom > e.lastElementChild.getBoundingClientRect().top + 1)
      bad.push("formula not rendered");
  }
  const ids = all.filter(e => e.id).map(e => e.id);
  if (new Set(ids).size < ids.length) bad.push("ids are not unique");
  for (const a of document.querySelectorAll("a[href]"))
    if (!a.hash || !document.getElementById(a.hash.slice(1))) bad.push("dead link: " + a.href);
  for (const e of performance.getEntriesByType("resource")) bad.push("loaded from elsewhere: " + e.name);
  parent.postMessage({height: document.documentElement.scrollHeight, elements: all.length, bad}, "*");
});
SCRIPT
python3 - "$page" "$scratch" <<'PYTHON'
import sys
page, scratch = sys.argv[1:]
text = open(page, encoding="utf-8").read()
script = open(scratch + "/look.js", encoding="utf-8").read()
open(scratch + "/page.html", "w", encoding="utf-8").write(text.replace("</body>", "<script>%s</script></body>" % script))
PYTHON

failed=0
for width in 1280 390; do
  cat >"$scratch/frame.html" <<FRAME
<body style="margin:0"><pre id="found">nothing</pre><script>
onmessage = m => document.getElementById("found").textContent = JSON.stringify(m.data);
</script><iframe src="page.html" style="border:0" width="$width" height="900"></iframe></body>
FRAME
  browser --window-size=1400,1000 --virtual-time-budget=10000 --dump-dom "file://$scratch/frame.html" >"$scratch/dom"
  height=$(python3 - "$scratch/dom" "$width" <<'PYTHON'
import html, json, re, sys
found = re.search(r'<pre id="found">(.*?)</pre>', open(sys.argv[1], encoding="utf-8").read(), re.S)
found = json.loads(html.unescape(found.group(1))) if found and found.group(1) != "nothing" else {"bad": ["the page did not load"]}
for what in found["bad"]:
    print("%s px wide: %s" % (sys.argv[2], what), file=sys.stderr)
print(found.get("height", 0))
sys.exit(1 if found["bad"] else 0)
PYTHON
  ) || failed=1
  [ -n "$shots" ] || continue
  mkdir -p "$shots"
  top=0
  while [ "$top" -lt "$height" ]; do # in slices: a picture has a greatest height
    printf '<body style="margin:0;overflow:hidden"><iframe src="page.html" style="border:0;margin-top:-%dpx" width="%d" height="%d"></iframe></body>' \
      "$top" "$width" "$height" >"$scratch/frame.html"
    browser --window-size="$width,2400" --screenshot="$shots/$(printf '%d-%05d' "$width" "$top").png" "file://$scratch/frame.html" >&2
    top=$((top + 2400))
  done
done
[ "$failed" -eq 0 ] && echo "1 passed, 0 failed"
exit "$failed"
