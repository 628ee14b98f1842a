# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors as exceptions.

VTK reports an error as an event, or prints it where nobody observes that, and goes on. Here the event is observed while
a method runs, and becomes an exception when it returns.
"""

import contextlib
import functools
import re

from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

# "ERROR: In <file>, line <n>\n<class> (<address>): <text>\n\n"
_MESSAGE = re.compile(r"\s*ERROR: In [^\n]*, line \d+\n(?:(\w+) ?\((?:0x)?[0-9a-fA-F]+\): )?(.*)", re.DOTALL)
# What the pipeline adds to an error that an algorithm has explained.
_ECHO = re.compile(r"Algorithm \w+ ?\(.*\) returned failure for request")

_RUN = (
    "Update", "UpdateInformation", "UpdateDataObject", "UpdateWholeExtent", "UpdateExtent", "UpdatePiece",
    "UpdateTimeStep", "PropagateUpdateExtent", "Write", "WriteForMesh",
    "Estimate", "EstimateLayerElements", "CompleteSizes", "SuggestSizes",
)
_ACCESS = ("Set", "Get", "Add", "Remove")


def plain(message):
    """An error of VTK without source lines and addresses: what reported it, and the text."""
    parts = _MESSAGE.fullmatch(message)
    name, text = parts.groups() if parts else (None, message)
    return (f"{name}: " if name else "") + text.strip()


def is_echo(message):
    """Whether the pipeline repeats an error that an algorithm has explained."""
    parts = _MESSAGE.fullmatch(message)
    return bool(_ECHO.match(parts[2] if parts else message))


class Error(RuntimeError):
    """What algorithms of VTK, Atria's or others, reported as errors while they ran."""

    __module__ = __package__


def _before(algorithms):
    """The algorithms, those that feed them, and what runs them all."""
    found = {}
    left = list(algorithms)
    while left:
        algorithm = left.pop()
        if algorithm is None or id(algorithm) in found:
            continue
        found[id(algorithm)] = algorithm
        for port in range(algorithm.GetNumberOfInputPorts()):
            for i in range(algorithm.GetNumberOfInputConnections(port)):
                left.append(algorithm.GetInputAlgorithm(port, i))
    algorithms = list(found.values())
    return algorithms + [algorithm.GetExecutive() for algorithm in algorithms]


@contextlib.contextmanager
def _errors_of(objects):
    errors = []
    failed = []

    def note(caller, _event, message):
        failed.append(caller)
        if message is None:
            message = f"{caller.GetClassName()}: an error whose text is not UTF-8, as of a file with such a name"
        if not (errors and is_echo(message)):
            errors.append(plain(message))

    note.CallDataType = VTK_STRING
    observed = [(one, one.AddObserver("ErrorEvent", note)) for one in objects]
    try:
        yield
    finally:
        for one, tag in observed:
            one.RemoveObserver(tag)
    for one in failed:
        if isinstance(one, vtkAlgorithm):
            one.Modified()  # else the next update finds nothing to do, and gives nothing
    if errors:
        raise Error("\n".join(errors))


def raising(*algorithms):
    """Makes an exception of errors of these algorithms, and of all that feed them, within a `with` statement.

    Atria's own classes need none. It is for others that run them, such as VTK's writers:

        with atria.raising(writer):
            writer.Write()
    """
    return _errors_of(_before(algorithms))


class _Raising:
    """A method of a class of VTK that raises Error."""

    def __init__(self, name, observed):
        self.name = name
        self.observed = observed

    def __set_name__(self, owner, _name):
        self.owner = owner

    def __get__(self, instance, owner=None):
        if instance is None:
            return getattr(super(self.owner, self.owner), self.name)
        method = getattr(super(self.owner, instance), self.name)

        @functools.wraps(method)
        def call(*arguments):
            with _errors_of(self.observed([instance])):
                return method(*arguments)

        return call


def raising_class(base):
    """A class derived from one of VTK whose methods raise Error. VTK's own cannot be changed."""
    body = {"__doc__": base.__doc__, "__module__": __package__}
    for ours in (cls for cls in base.__mro__ if cls.__name__.startswith("vtkAtria")):
        for name in vars(ours):
            if name.startswith(_ACCESS):
                body[name] = _Raising(name, list)
    for name in _RUN:
        if hasattr(base, name):
            body[name] = _Raising(name, _before)
    return type(base.__name__, (base,), body)
