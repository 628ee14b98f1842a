# SPDX-License-Identifier: GPL-3.0-or-later
"""python3 -m atria.report CASE [-o PAGE.html] [--climate FILE [--station HEIGHT ROUGHNESS]]"""

from __future__ import annotations

import argparse
import contextlib
import pathlib
import sys

from vtkmodules.vtkCommonCore import VTK_STRING, vtkOutputWindow, vtkStringOutputWindow

from . import Case, page_of, read_climate
from ..errors import Error, is_echo, plain
from .comfort import at_reference

# As the command line's others.
FAILED = 1
BAD_INPUT = 3
NOT_BELIEVABLE = 6


def _arguments(given):
    parser = argparse.ArgumentParser(prog="atria report", description="Makes a page of what the runs of a case say.")
    parser.add_argument("case", metavar="CASE", help="folder that `atria case` wrote and whose Allrun has run")
    parser.add_argument("-o", "--output", metavar="PAGE.html", help="where the page goes (default: CASE/report.html)")
    parser.add_argument("--climate", metavar="FILE", help="wind statistics: .csv or .json with from, frequency, scale, shape")
    parser.add_argument("--station", metavar=("HEIGHT", "ROUGHNESS"), nargs=2, type=float,
                        help="where the climate was measured, meters (default: as the case's wind)")
    return parser.parse_args(given)


@contextlib.contextmanager
def noted():
    """A list of what VTK reports as errors meanwhile, which would otherwise be printed and forgotten. Warnings are printed."""
    errors = []

    def note(_caller, event, text):
        if event != "ErrorEvent":
            print(text.strip(), file=sys.stderr)
        elif not (errors and is_echo(text)):
            errors.append(plain(text))

    note.CallDataType = VTK_STRING
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    window.AddObserver("ErrorEvent", note)
    window.AddObserver("WarningEvent", note)
    vtkOutputWindow.SetInstance(window)
    try:
        yield errors
    finally:
        vtkOutputWindow.SetInstance(before)


def main(given=None) -> int:
    options = _arguments(given)
    target = pathlib.Path(options.output or pathlib.Path(options.case) / "report.html")
    try:
        climate = read_climate(options.climate) if options.climate else None
        case = Case(options.case)
        if climate and options.station and case.has_wind:
            climate = at_reference(climate, *options.station, case.described)
        with noted() as errors:
            target.write_text(page_of(case, climate), encoding="utf-8")
    except Error as error:
        print(f"atria: error: {error}", file=sys.stderr)
        return BAD_INPUT
    except OSError as error:
        print(f"atria: error: {target}: {error.strerror}", file=sys.stderr)
        return FAILED
    print(f"Written: {target}")
    failures = [(run.title, failure) for run in case.runs for failure in run.failures()]
    for title, failure in failures:
        print(f"atria: warning: {title}: {failure}", file=sys.stderr)
    for run in case.runs:
        for doubt in run.profile.doubts() if run.profile else []:
            print(f"atria: warning: {run.title}: {doubt}", file=sys.stderr)
        for doubt in run.warnings():
            print(f"atria: warning: {run.title}: {doubt}", file=sys.stderr)
    for error in errors:
        print(f"atria: error: {target} lacks a part: {error}", file=sys.stderr)
    return FAILED if errors else NOT_BELIEVABLE if failures else 0


if __name__ == "__main__":
    sys.exit(main())
