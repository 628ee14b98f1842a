# SPDX-License-Identifier: GPL-3.0-or-later
"""The models in Examples/Data are what their scripts write.

Usage: test_data.py FOLDER
"""

import filecmp
import pathlib
import subprocess
import sys
import tempfile


def main(folder):
    with tempfile.TemporaryDirectory() as scratch:
        for script in ("make_building.py", "make_house.py", "make_sketchup_house.py", "make_sphere.py"):
            subprocess.run([sys.executable, folder / script, scratch], check=True)
        written = sorted(pathlib.Path(scratch).iterdir())
        assert len(written) == 8, written
        for file in written:
            if not filecmp.cmp(file, folder / file.name, shallow=False):
                sys.exit(f"{folder / file.name} differs from what its script writes; run the script")


main(pathlib.Path(sys.argv[1]))
