# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of docs/ventilation.md from the case that Examples/NaturalVentilation/run.sh has run.

Usage: ventilation.py CASE OUTPUT    (PYTHONPATH must hold the package `atria`)
"""

import pathlib
import sys

from atria.report import Case, pictures
from atria.report.fields import Fields


def main(folder, output):
    case = Case(folder)
    run = case.runs[0]
    fields = Fields(run.folder)
    fastest = pictures.fastest_near(run, fields, case)
    (output / "ventilation-space.png").write_bytes(pictures.in_space(run, fields, fastest))
    section = next(pictures.level_sections(run, fields))
    plot = pictures.speed_plot(section, fields, pictures.walls_of(run, fields), fastest)
    (output / "ventilation-section.svg").write_text(plot)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
