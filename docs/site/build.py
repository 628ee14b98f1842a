# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the site from the documents and the generated reference, and checks its internal links.

Usage: build.py SOURCE ATRIA FOLDER

FOLDER/html is the site. Warnings of Sphinx are errors: a link to no page or heading, a page that is in no list.
"""

import html.parser
import pathlib
import shutil
import subprocess
import sys
import urllib.parse

import reference

CONTENTS = {
    "Use": ["docs/tutorial", "docs/gallery", "docs/building", "docs/paraview", "docs/choosing", "docs/formats", "docs/cases",
            "docs/ventilation", "docs/troubleshooting"],
    "Reference": ["reference/commands", "reference/filters", "docs/arrays", "docs/formats", "docs/glossary", "CHANGELOG"],
    "Develop": ["CONTRIBUTING", "docs/architecture", "docs/algorithm", "docs/ranks", "docs/constants", "docs/testing"],
    "Records": ["docs/records/results", "docs/records/comparison", "docs/records/benchmarks", "docs/records/benchmarks-smooth",
                "docs/records/validation", "docs/records/decisions"],
}


def put_together(source, atria, pages):
    """A tree like the repository's, with the generated pages and an index that is the README and the contents."""
    shutil.rmtree(pages, ignore_errors=True)
    pages.mkdir(parents=True)
    for entry in ("docs", "Examples", "Filters", "IO", "ParaViewPlugin", "Testing", "CHANGELOG.md", "CONTRIBUTING.md", "CITATION.cff",
                  "LICENSE"):
        (pages / entry).symlink_to(source / entry)
    reference.write(source, atria, pages / "reference")
    index = (source / "README.md").read_text()
    for caption, names in CONTENTS.items():
        listed = [name for name in names if (pages / f"{name}.md").exists()]
        index += "\n".join(["", "```{toctree}", f":caption: {caption}", ":hidden:", ":maxdepth: 1", "", *listed, "```", ""])
    (pages / "index.md").write_text(index)


class Page(html.parser.HTMLParser):
    """What a page links to, and the places in it that can be linked to."""

    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id":
                self.places.add(value)
            elif name in ("href", "src") and value:
                self.links.append(value)


def broken_links(site):
    pages = {path: Page(path) for path in site.rglob("*.html")}
    for path, page in pages.items():
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path
            if not target.exists() or parts.fragment and target in pages and parts.fragment not in pages[target].places:
                yield f"{path.relative_to(site)}: {link} leads nowhere"


def main():
    source, atria, folder = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    put_together(source, atria, folder / "pages")
    shutil.rmtree(folder / "html", ignore_errors=True)
    subprocess.run([sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-n", "-b", "html", "-c", source / "docs/site",
                    "-d", folder / "cache", folder / "pages", folder / "html"], check=True)
    broken = list(broken_links(folder / "html"))
    print(*broken, sep="\n", file=sys.stderr)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()
