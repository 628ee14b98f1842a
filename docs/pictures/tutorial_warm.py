# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the pictures of warm air and weather in docs/tutorial.md from what the tutorial has made, and prints the temperatures at
the ends of the scale.

Usage: tutorial_warm.py FOLDER OUTPUT    FOLDER is where the tutorial was run (PYTHONPATH must hold the package `atria`)
"""

import pathlib
import shutil
import sys

from atria.report import Case, pictures


def main(folder, output):
    case = Case(folder / "warm")
    run = case.runs[0]
    picture, low, high = pictures.temperature_section(run, run.fields, case)[:3]
    (output / "tutorial-warm.svg").write_text(picture)
    shutil.copy(folder / "rose.svg", output / "tutorial-rose.svg")
    print(f"{low:.1f} to {high:.1f} °C")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]))
