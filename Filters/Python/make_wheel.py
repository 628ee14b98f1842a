# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the Python package and Atria's libraries from a build as a wheel.

VTK is not in it: it runs with the Python and the VTK that the build was made for, and says so in tag and metadata.

Usage: make_wheel.py BUILD FOLDER    (needs Debian's python3-wheel)
"""

import pathlib
import subprocess
import sys
import sysconfig
import tempfile


def main(build, folder):
    with tempfile.TemporaryDirectory() as scratch:
        for component in ("runtime", "python"):
            subprocess.run(["cmake", "--install", build, "--component", component, "--prefix", scratch, "--strip"], check=True,
                           stdout=subprocess.DEVNULL)
        packages = pathlib.Path(scratch, "lib/python3/dist-packages")
        for library in pathlib.Path(scratch, "lib").glob("**/libAtria*.so.*"):
            if library.is_symlink():  # by the name that the others link to; they look beside themselves
                library.resolve().rename(packages / "atria" / library.name)
        interpreter = f"cp{sys.version_info.major}{sys.version_info.minor}"
        tag = f"{interpreter}-{interpreter}-{sysconfig.get_platform().replace('-', '_')}"
        information = next(packages.glob("atria-*.dist-info"))
        (information / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: atria\nRoot-Is-Purelib: false\nTag: {tag}\n")
        pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
        subprocess.run([sys.executable, "-m", "wheel", "pack", packages, "--dest-dir", folder], check=True)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
