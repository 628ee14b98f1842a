# SPDX-License-Identifier: GPL-3.0-or-later
"""The wheel is whole, and works where nothing else of Atria is.

Usage: test_wheel.py MAKE_WHEEL BUILD MODEL
"""

import base64
import csv
import hashlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

USE = """
import sys, atria
assert atria.__file__.startswith(sys.argv[1]), atria.__file__
assert atria.mesh(sys.argv[2], size=4.0).mesh.GetNumberOfCells() > 1000
maps = open("/proc/self/maps").read()
assert sys.argv[1] + "/atria/libAtriaMeshingCore" in maps and maps.count("libAtriaMeshingCore") == maps.count(sys.argv[1] + "/atria/libAtriaMeshingCore")
"""


def check_record(wheel):
    with zipfile.ZipFile(wheel) as files:
        record = next(name for name in files.namelist() if name.endswith(".dist-info/RECORD"))
        listed = {row[0]: row[1] for row in csv.reader(io.StringIO(files.read(record).decode()))}
        assert set(listed) == set(files.namelist()), set(listed) ^ set(files.namelist())
        for name, digest in listed.items():
            if name != record:
                expected = base64.urlsafe_b64encode(hashlib.sha256(files.read(name)).digest()).rstrip(b"=").decode()
                assert digest == "sha256=" + expected, name


def main(make_wheel, build, model):
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([sys.executable, make_wheel, build, scratch], check=True)
        wheels = list(pathlib.Path(scratch).glob("*.whl"))
        assert len(wheels) == 1 and not wheels[0].name.endswith("-any.whl"), wheels
        check_record(wheels[0])
        folder = os.path.join(scratch, "installed")
        zipfile.ZipFile(wheels[0]).extractall(folder)  # what pip does with a wheel without scripts
        environment = {name: value for name, value in os.environ.items() if name != "LD_LIBRARY_PATH"}
        subprocess.run([sys.executable, "-c", USE, folder, model], check=True, env={**environment, "PYTHONPATH": folder})


main(*sys.argv[1:])
