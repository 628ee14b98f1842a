# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the stub of the package `atria` from the signatures in its classes' docstrings.

Usage: make_stubs.py OUT.pyi    (PYTHONPATH must hold the package)
"""

import inspect
import re
import sys

import atria

HEAD = """# Made by make_stubs.py from the wrapped classes.
from typing import Any, Sequence, overload

from vtkmodules.vtkCommonCore import *
from vtkmodules.vtkCommonDataModel import *
from vtkmodules.vtkCommonExecutionModel import *

from .errors import Error as Error, raising as raising
from .meshing import ModelWarning as ModelWarning, Result as Result, mesh as mesh

__version__: str
"""


def signatures(docstring):
    """The lines ahead of each `C++:`, which may be broken."""
    found = []
    for match in re.finditer(r"(?:^|\n)(\w+\([^\n]*(?:\n    [^\n]*)*?)\nC\+\+:", docstring or ""):
        text = re.sub(r"\s*\n\s*", " ", match.group(1))
        parts = re.fullmatch(r"(\w+)\(((?:[^()]|\([^()]*\))*)\)(?: -> (.*))?", text)
        if parts:
            found.append((parts.group(1), parts.group(2), parts.group(3) or "None"))
    return found


def argument(text, i):
    """Annotations that Python can read: tuples of types for arrays, `*args` where VTK has something else."""
    name, _, kind = text.partition(":")
    name = name.strip() if name.strip().isidentifier() else f"argument{i}"
    kind = kind.split("=")[0].strip()
    if kind.startswith(("(", "[")):
        kind = "Sequence[float]" if "float" in kind else "Sequence[int]"
    return name + (f": {kind}" if re.fullmatch(r"[\w.\[\], ]+", kind) else ": Any" if kind else "")


def method(name, arguments, result):
    parts = [part.strip() for part in re.split(r",(?![^(\[]*[)\]])", arguments) if part.strip()]
    static = not parts or parts[0] != "self"
    result = "tuple[Any, ...]" if result.startswith("(") else result if re.fullmatch(r"[\w.\[\], ]+", result) else "Any"
    names = ", ".join(argument(part, i) for i, part in enumerate(parts))
    return ["@staticmethod"] if static else [], f"def {name}({names}) -> {result}: ..."


def members(cls):
    for name, value in sorted(vars(cls).items()):
        if name.startswith("_"):
            continue
        if isinstance(value, int):
            yield f"    {name}: int"
            continue
        if inspect.isclass(value):
            yield f"    class {name}(int): ..."
            continue
        lines = [method(*signature) for signature in signatures(getattr(value, "__doc__", None)) if signature[0] == name]
        for decorators, text in lines:
            for decorator in (["@overload"] if len(lines) > 1 else []) + decorators:
                yield f"    {decorator}"
            yield f"    {text}"


def wrapped(cls):
    """The class as VTK wraps it, for one that raises errors."""
    return next(base for base in cls.__mro__ if base.__module__ != "atria")


def classes():
    """With their bases ahead of them."""
    found = {}
    for name in atria.__all__:
        if name.startswith("vtkAtria"):
            for base in reversed(wrapped(getattr(atria, name)).__mro__):
                if base.__name__.startswith("vtkAtria"):
                    found[base.__name__] = base
    return found.values()


def main(file):
    lines = [HEAD]
    for cls in classes():
        body = list(members(cls)) or ["    ..."]
        lines += ["", f"class {cls.__name__}({cls.__mro__[1].__name__}):", *body]
    with open(file, "w", encoding="utf-8") as out:
        out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(sys.argv[1])
