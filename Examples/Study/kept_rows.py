# SPDX-License-Identifier: GPL-3.0-or-later
"""What studies have in common: rows that are made one by one and kept as JSON, so that a study goes on where it stopped.

A row is a frozen dataclass with a `name`. Its result has its settings and what was measured, in OUT/results/NAME.json.
"""

import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import sys
import time

OPENFOAM = {"WM_PROJECT_DIR": "/usr/share/openfoam"}  # where Debian has it, which sets no environment of its own


class Failed(Exception):
    pass


def run(command, folder, name):
    """Runs a command, its output in a log; returns its seconds."""
    log = folder / f"log.{name}"
    begin = time.monotonic()
    with open(log, "w", encoding="utf-8") as output:
        status = subprocess.run([str(word) for word in command], stdout=output, stderr=subprocess.STDOUT, check=False,
                                env=OPENFOAM | os.environ).returncode
    if status not in (0, 5):  # 5: written, but it fails checks of checkMesh, which the row tells
        raise Failed(f"{name} ended with {status}: see {log}")
    return time.monotonic() - begin


def settings_of(row):
    """As JSON gives them back."""
    return json.loads(json.dumps(dataclasses.asdict(row)))


def known(row, out):
    """The row's result; None where there is none, or one of other settings."""
    try:
        result = json.loads((out / "results" / f"{row.name}.json").read_text())
    except (OSError, ValueError):
        return None
    return result if all(result.get(key) == value for key, value in settings_of(row).items()) else None


def keep(row, out, measured):
    """Whole or not at all."""
    (out / "results").mkdir(exist_ok=True)
    target = out / "results" / f"{row.name}.json"
    target.with_suffix(".part").write_text(json.dumps({**settings_of(row), **measured}, indent=1) + "\n")
    target.with_suffix(".part").rename(target)


def new_folder(row, out):
    """Of a row that is to be made, without what an earlier try left."""
    folder = out / "rows" / row.name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def go_on(make, rows, tables, atria, out, *names):
    """Makes the rows that are not there, or those named, by make(atria, row, folder), which returns what it measured, and writes
    tables() to OUT/tables.md. A row that fails is told and left out. Returns an exit status."""
    atria, out = pathlib.Path(atria).resolve(), pathlib.Path(out)
    wanted = [row for row in rows if not names or row.name in names]
    if unknown := set(names) - {row.name for row in wanted}:
        sys.exit(f"study.py: there is no row {', '.join(sorted(unknown))}; --list names them")
    failures = 0
    for row in wanted:
        if not known(row, out):
            print(f"{row.name} …", flush=True)
            try:
                folder = new_folder(row, out)
                keep(row, out, make(atria, row, folder))
                shutil.rmtree(folder)
            except Failed as failure:
                failures += 1
                print(f"{row.name}: {failure}", file=sys.stderr)
        out.mkdir(parents=True, exist_ok=True)
        (out / "tables.md").write_text(tables(out))
    print(f"In {out}: tables.md")
    return 1 if failures else 0


def command_line(make, rows, tables, usage):
    """What all studies do with their arguments: see go_on()."""
    if sys.argv[1:] == ["--list"]:
        print("\n".join(row.name for row in rows))
    elif len(sys.argv) < 3:
        sys.exit(usage)
    else:
        sys.exit(go_on(make, rows, tables, *sys.argv[1:]))


def lines_of(head, rows):
    """A table in Markdown."""
    return "\n".join("| " + " | ".join(map(str, cells)) + " |" for cells in (head, ["---"] * len(head), *rows))
