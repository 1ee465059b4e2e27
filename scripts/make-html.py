#!/usr/bin/env python3
"""The manual as HTML, from its Markdown and the public headers, for reading without a network.

    scripts/make-html.py OUT      needs pandoc, doxygen and fonts-dejavu-extra (scripts/deps.sh --docs)

It begins with docs/README.md and follows links: a Markdown page becomes an HTML page at the same place, a source or a
folder a page that shows it, anything else is copied. The C API comes from Doxygen, in OUT/api.
"""

import html.parser
import os
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

REPO = pathlib.Path(__file__).resolve().parent.parent
SITE = REPO / "docs" / "site"
START = "docs/README.html"
FONT = "DejaVuMathTeXGyre.ttf"


class Links(html.parser.HTMLParser):
    """The addresses on a page."""

    def __init__(self, page):
        super().__init__()
        self.found = []
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes if name in ("href", "src") and value]


def pandoc(text, title, place):
    command = ["pandoc", "-f", "gfm+tex_math_dollars", "-t", "html", "--mathml", "--standalone",
               "--template", SITE / "page.template", "--lua-filter", SITE / "pages.lua",
               "--metadata", "pagetitle=" + title, "--variable", "root=" + "../" * place.count("/")]
    result = subprocess.run(command, input=text, capture_output=True, text=True, check=True)
    if result.stderr:  # a formula that it cannot read is but a warning
        sys.exit("%s: %s" % (place, result.stderr))
    return result.stdout


def title_of(markdown, place):
    return next((line[2:] for line in markdown.splitlines() if line.startswith("# ")), place)


def source_page(place, source):
    """A page that shows the text of a file of the repository."""
    fence = "````" + {".yaml": "yaml", ".c": "c", ".h": "c", ".py": "python"}.get(source.suffix, "")
    return pandoc("# %s\n\n%s\n%s\n````\n" % (place, fence, source.read_text(encoding="utf-8")), place, place)


def folder_page(place, folder):
    """A page that lists the files of a folder of the repository."""
    names = sorted(path.name for path in folder.iterdir() if path.is_file())
    links = ["- [%s](%s/%s)\n" % (name, folder.name, name) for name in names]
    return pandoc("# %s\n\n%s" % (place, "".join(links)), place, place)


def make(place, out):
    """Write the file `place` below `out`; the places that it links to."""
    target = out / place
    target.parent.mkdir(parents=True, exist_ok=True)
    markdown, source = (REPO / place).with_suffix(".md"), REPO / place.removesuffix(".html")
    if place.endswith(".html") and markdown.is_file():
        text = markdown.read_text(encoding="utf-8")
        page = pandoc(text, title_of(text, place), place)
    elif place.endswith(".html") and source.is_file():
        page = source_page(place.removesuffix(".html"), source)
    elif place.endswith(".html") and source.is_dir():
        page = folder_page(place.removesuffix(".html"), source)
    else:
        if (REPO / place).is_file():  # else it is a dead link, which check-docs.sh reports
            shutil.copyfile(REPO / place, target)
        return []
    target.write_text(page, encoding="utf-8")
    here = os.path.dirname(place)
    paths = [urllib.parse.urlsplit(link) for link in Links(page).found]
    return [os.path.normpath(os.path.join(here, path.path)) for path in paths if path.path and not path.scheme]


def api(out):
    """The C API by Doxygen."""
    settings = (SITE / "Doxyfile").read_text(encoding="utf-8") + "\nOUTPUT_DIRECTORY = %s\n" % out
    result = subprocess.run(["doxygen", "-"], input=settings, cwd=REPO, capture_output=True, text=True, check=True)
    if result.stderr:
        sys.exit(result.stderr)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = pathlib.Path(sys.argv[1]).resolve()
    if out.exists() and not (out / "formulas.ttf").is_file():
        sys.exit("%s: there is something else; not replaced" % out)
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    api(out)
    shutil.copyfile(SITE / "style.css", out / "style.css")
    font = next(pathlib.Path("/usr/share/fonts").rglob(FONT), None)
    if not font:
        sys.exit("there is no font %s: scripts/deps.sh --docs" % FONT)
    shutil.copyfile(font, out / "formulas.ttf")
    (out / "index.html").write_text('<!DOCTYPE html><title>zipact</title><meta http-equiv="refresh" content="0; url=%s">'
                                    '<a href="%s">The manual</a>\n' % (START, START), encoding="utf-8")
    waiting, seen = [START], set()
    while waiting:
        place = waiting.pop()
        if place in seen or place.startswith("..") or (out / place).exists():
            continue
        seen.add(place)
        waiting += make(place, out)
    print("manual: %s (%d files and the C API)" % (out / "index.html", len(seen)))


if __name__ == "__main__":
    main()
