# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of Sphinx; build.py puts the sources together."""

import pathlib
import re

project = "Atria"
author = "The Atria developers"
extensions = ["myst_parser"]
myst_enable_extensions = ["deflist"]
myst_heading_anchors = 4
include_patterns = ["*.md", "docs/*.md", "docs/records/*.md", "reference/*.md"]
exclude_patterns = ["README.md"]  # index.md begins with it
root_doc = "index"
html_theme = "furo"
html_title = "Atria"
html_copy_source = False


def folders_as_text(app, page, source):
    """Links to folders of the repository have no page to lead to."""
    folder = pathlib.Path(app.srcdir, page).parent

    def text_if_folder(match):
        text, target = match.groups()
        return text if (folder / target).is_dir() else match.group(0)

    source[0] = re.sub(r"(?<!!)\[([^\]]+)\]\(([^)#:]+)\)", text_if_folder, source[0])


def setup(app):
    app.connect("source-read", folders_as_text)
