# SPDX-License-Identifier: GPL-3.0-or-later
"""Parses the dictionary files of an OpenFOAM case.

A dictionary becomes {key: value}. A value is either an inner dictionary, or the list of what stands between the key
and its semicolon: words, lists (of round or square brackets) and dictionaries. A file that is a list, such as
constant/polyMesh/boundary, has it under the key "". Quotes are kept, comments and the FoamFile header are left out,
and #include is followed, relative to the file that has it. Nothing else is expanded: neither $name nor #calc.
"""

import re

# A number: 1, -0.5, 1e-06.
NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")

# The smallest parts of a dictionary, one alternative each.
TOKEN = re.compile(
    r"""
    //[^\n]*                                    # // a comment
    | /\*.*?\*/                                 # /* a comment */
    | "(?:\\.|[^"\\])*"                         # "(U|k).*"
    | \#\w+                                     # #include
    | [{}()\[\];]                               # one bracket, or a semicolon
    | [^\s{}()\[\];"]+(?:\([^\s{}\[\];"]*\))?   # relTol, 1e-06, or a word with brackets, as div(phi,U)
    """,
    re.DOTALL | re.VERBOSE,
)

CLOSING = {"(": ")", "[": "]", "{": "}"}


class DictionaryError(Exception):
    """A file that cannot be read as a dictionary."""


class Parser:
    """Goes over the tokens of one file."""

    def __init__(self, path):
        try:
            text = path.read_text("utf-8", "replace")
        except OSError as error:
            raise DictionaryError(f"{path} cannot be read: {error.strerror}.") from error
        self.path = path
        self.tokens = [token for token in TOKEN.findall(text) if not token.startswith(("//", "/*"))]
        self.position = 0

    def next_token(self):
        if self.position == len(self.tokens):
            raise DictionaryError(f"{self.path} ends within an entry: a bracket or a semicolon is missing.")
        self.position += 1
        return self.tokens[self.position - 1]

    def comes_next(self, token):
        return self.position < len(self.tokens) and self.tokens[self.position] == token

    def items(self, end):
        """The items up to the token that ends a list or an entry."""
        items = []
        while (token := self.next_token()) != end:
            if token in CLOSING:
                items.append(self.bracket(token))
            else:
                items.append(token)
        return items

    def bracket(self, opening):
        """The list or dictionary whose opening bracket was just read."""
        if opening == "{":
            found = self.entries("}")
            self.next_token()
            return found
        return self.items(CLOSING[opening])

    def entries(self, end=None):
        """The entries of a dictionary, up to its closing bracket, or to the end of the file."""
        found = {}
        while self.position < len(self.tokens) and not self.comes_next(end):
            key = self.next_token()
            if key in ("(", "["):
                found[""] = self.bracket(key)
            elif key.startswith("#include"):
                found.update(parse(self.path.parent / self.next_token().strip('"')))
            elif self.comes_next("{"):
                found[key] = self.bracket(self.next_token())
            elif not (self.comes_next("(") and NUMBER.match(key)):  # a number before a list is its size
                found[key] = self.items(";")
        return found


def parse(path):
    """The entries of a dictionary file."""
    found = Parser(path).entries()
    found.pop("FoamFile", None)
    return found
