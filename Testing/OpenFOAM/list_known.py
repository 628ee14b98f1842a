#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lists which versions of OpenFOAM know the entries of cases: keywords, types, schemes, solvers and libraries.

Nothing is run or compiled: the entries are looked up in the sources of each version, by the rules at the top of
case_entries.py. They are heuristics, so "known" does not say that a case runs, and "no" is worth a look.

The result is a table in Markdown, one row per entry and one column per version, with the entries first that any
version does not know. A cell is "known", "no", or "-" if a version did not get to the entry, as it does not know the
type that the entry belongs to, or looks for it under another name. The exit status is 0 if all versions know all
entries, 1 if not, and 2 if the arguments, the sources or the cases cannot be read.
"""

import argparse
import pathlib
import sys

from case_entries import CaseEntries
from foam_dictionary import DictionaryError
from foam_sources import Sources, SourcesError, check_place

USAGE = "list_known.py [--where] NAME=SOURCES [NAME=SOURCES ...] -- CASE [CASE ...]"

# Separates the versions from the cases.
SEPARATOR = "--"

# What a cell says of an entry that the version does not know, and of one it did not get to.
NOT_KNOWN = "no"
NOT_REACHED = "-"

EXIT_ALL_KNOWN, EXIT_NOT_ALL_KNOWN, EXIT_ERROR = range(3)


class ArgumentsError(Exception):
    """Arguments that do not make sense."""


def read_arguments(arguments):
    """{name: place of the sources}, the folders of the cases, and whether to print where entries are."""
    before, after = arguments, []
    if SEPARATOR in arguments:
        at = arguments.index(SEPARATOR)
        before, after = arguments[:at], arguments[at + 1:]
    parser = argparse.ArgumentParser(usage=USAGE, description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--where", action="store_true", help="print the file where each entry was found")
    parser.add_argument("versions", nargs="+", metavar="NAME=SOURCES",
                        help="a version: a folder of sources, or BARE_GIT_REPOSITORY@REVISION, and a name for it")
    parsed = parser.parse_args(before)
    if not after:
        raise ArgumentsError(f"There are no cases: give them after {SEPARATOR}.")
    return read_versions(parsed.versions), [pathlib.Path(case) for case in after], parsed.where


def read_versions(arguments):
    versions = {}
    for argument in arguments:
        name, equals, place = argument.partition("=")
        if not (name and equals and place):
            raise ArgumentsError(f"{argument} is not NAME=SOURCES.")
        if name in versions:
            raise ArgumentsError(f"The name {name} is given to two versions.")
        versions[name] = place
    return versions


def check_cases(cases):
    for case in cases:
        if not case.is_dir():
            raise ArgumentsError(f"There is no folder {case}.")
        if not (case / "system" / "controlDict").is_file():
            raise ArgumentsError(f"{case} is not a case: it has no system/controlDict.")


def rows_of_version(place, cases):
    """{entry: where it was found, or None}. The sources are read and let go, as they take much memory."""
    entries = CaseEntries(Sources(place))
    for case in cases:
        entries.add_case(case)
    return entries.rows


def cell(rows, entry, with_where):
    if entry not in rows:
        return NOT_REACHED
    where = rows[entry]
    if not where:
        return NOT_KNOWN
    return where if with_where else "known"


def table_line(cells):
    """A line of a table in Markdown, where a | within a cell has to be escaped."""
    return "| " + " | ".join(text.replace("|", r"\|") for text in cells) + " |"


def print_table(found, with_where):
    """One row per entry, with those first that any version does not know."""
    entries = {entry for rows in found.values() for entry in rows}
    not_known = {entry for rows in found.values() for entry, where in rows.items() if not where}
    print(table_line(["entry", *found]))
    print(table_line(["---"] * (1 + len(found))))
    for entry in sorted(not_known) + sorted(entries - not_known):
        print(table_line([f"`{entry}`", *(cell(rows, entry, with_where) for rows in found.values())]))
    print()
    for name, rows in found.items():
        print(f"{name}: {len(rows)} entries, {list(rows.values()).count(None)} not known")
    return bool(not_known)


def main(arguments):
    try:
        versions, cases, with_where = read_arguments(arguments)
        check_cases(cases)
        for place in versions.values():
            check_place(place)
        found = {name: rows_of_version(place, cases) for name, place in versions.items()}
    except (ArgumentsError, SourcesError, DictionaryError) as error:
        print(error, file=sys.stderr)
        return EXIT_ERROR
    return EXIT_NOT_ALL_KNOWN if print_table(found, with_where) else EXIT_ALL_KNOWN


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
