# SPDX-License-Identifier: GPL-3.0-or-later
"""How the page writes numbers, verdicts and tables."""

from __future__ import annotations

import html
import math

_WORD_STYLES = {"settled": "good", "nearly settled": "fair", "unsettled": "bad",
                "low": "good", "levelled off": "fair", "high": "bad"}


def table(head, rows, kind=""):
    """Cells are HTML. In a table of the kind `words` the last column is text; a table may have no head."""
    def cells(tag, row):
        return "".join(f"<{tag}>{cell}</{tag}>" for cell in row)

    lines = "".join(f"<tr>{cells('td', row)}</tr>" for row in rows)
    above = f"<tr>{cells('th', head)}</tr>" if head else ""
    return f'<div class="wide"><table class="{kind}">{above}{lines}</table></div>'


def judgement(word):
    return f'<span class="{_WORD_STYLES[word]}">{word}</span>'


def folded(title, content, several):
    """Of several directions each is folded up."""
    if not several:
        return content
    return f"<details><summary>{html.escape(title)}</summary>{content}</details>"


def number(value, digits=3):
    return "–" if value is None else f"{value:.0f}" if 1e3 <= abs(value) < 1e9 else f"{value:.{digits}g}"


def amount(value, whole):
    """Such as heat; what is a rounding error of the whole is nothing."""
    return number(value if value is None or abs(value) > 1e-5 * abs(whole) else 0.0, 4)


def percent(share):
    """Of two digits, or whole from 100 % on; without an exponent."""
    if math.isinf(share):
        return "∞ %"
    if abs(share) < 1e-4:
        return "less than 0.01 %"
    text = f"{100 * share:.2g}"
    return f"{100 * share:.0f} %" if "e" in text else f"{text} %"


def duration(minutes):
    return f"{minutes:.3g} min" if minutes >= 1.0 else f"{60.0 * minutes:.3g} s"
