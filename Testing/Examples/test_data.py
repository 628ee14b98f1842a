# SPDX-License-Identifier: GPL-3.0-or-later
"""The models in Examples/Data and Testing/Data/Models are what their scripts write.

Usage: test_data.py FOLDER SCRIPT [SCRIPT…]
"""

import filecmp
import pathlib
import subprocess
import sys
import tempfile


def main(folder, scripts):
    with tempfile.TemporaryDirectory() as scratch:
        for script in scripts:
            subprocess.run([sys.executable, folder / script, scratch], check=True)
        written = sorted(pathlib.Path(scratch).iterdir())
        assert len(written) >= len(scripts), written
        for file in written:
            if not filecmp.cmp(file, folder / file.name, shallow=False):
                sys.exit(f"{folder / file.name} differs from what its script writes; run the script")


main(pathlib.Path(sys.argv[1]), sys.argv[2:])
