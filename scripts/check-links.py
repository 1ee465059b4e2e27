#!/usr/bin/env python3
"""Are all links alive that lead from a page to a place of our own, file and anchor?

    scripts/check-links.py FOLDER...      every .md and .html below it, builds and results left out

Standard library only. An anchor of a Markdown page is the slug that forges and pandoc make of its heading.
"""

import html.parser
import os
import pathlib
import re
import sys
import urllib.parse

OURS = ("/build", "/out", "/.git", "/node_modules", "/venv")


class Page(html.parser.HTMLParser):
    """Addresses and anchors of an HTML page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("href", "src") and value:
                self.links.append(value)
            if name == "id" or name == "name" and tag == "a":
                self.anchors.add(value)


def slug(heading):
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).strip().lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors_of_markdown(text):
    found = set()
    for heading in re.findall(r"^#+ +(.*)$", text, re.M):
        name, number = slug(heading), 0
        while name + ("-%d" % number if number else "") in found:
            number += 1
        found.add(name + ("-%d" % number if number else ""))
    return found


def read(path):
    """(links, anchors) of a page."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".html":
        page = Page(text)
        return page.links, page.anchors
    prose = re.sub(r"^(```|~~~).*?^\1|`[^`\n]*`|\$[^$\n]*\$", "", text, flags=re.M | re.S)
    prose = re.sub(r"^( {4}|\t).*$", "", prose, flags=re.M)
    return re.findall(r"\]\(([^)\s]+)\)", prose), anchors_of_markdown(text)


def trouble(page, link, anchors):
    """What is wrong with a link, or None."""
    url = urllib.parse.urlsplit(link)
    if url.scheme or url.netloc:
        return None
    target = (page.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page
    if not target.exists():
        return "no such file"
    if url.fragment and target.suffix in (".md", ".html"):
        if target not in anchors:
            anchors[target] = read(target)[1]
        if urllib.parse.unquote(url.fragment) not in anchors[target]:
            return "no such place"
    return None


def pages(folder):
    for path, folders, files in os.walk(folder):
        folders[:] = [f for f in folders if not ("/" + f).startswith(OURS)]
        for name in files:
            if name.endswith((".md", ".html")):
                yield pathlib.Path(path, name).resolve()


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    anchors, passed, failed = {}, 0, 0
    for page in (page for folder in sys.argv[1:] for page in pages(folder)):
        for link in read(page)[0]:
            wrong = trouble(page, link, anchors)
            passed, failed = passed + (not wrong), failed + bool(wrong)
            if wrong:
                print("%s: %s: %s" % (page, link, wrong))
    print("links: %d passed, %d failed" % (passed, failed))
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())
