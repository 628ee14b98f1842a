# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case --dialect: dictionaries of the releases differ where their sources do, and nowhere else.

Usage: test_dialects.py ATRIA

The keywords were looked up in the sources of Debian's 1912, OpenCFD's v2206 and current state, and the Foundation's 11
and 13; only the first can be run here.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from box_mesh import BoxCase

ATRIA = pathlib.Path(sys.argv[1])
TOKEN = re.compile(r'//[^\n]*|/\*.*?\*/|"[^"]*"|[{};()\[\]]|[^\s{};()\[\]"]+', re.DOTALL)
ABSENT = None


def entries(text):
    """{("boundaryField", "xMin", "type"): "fixedValue", ...} of a dictionary."""
    found, path, words, depth = {}, [], [], 0
    for token in TOKEN.findall(text):
        if token.startswith(("//", "/*")):
            continue
        if token in ("(", "["):
            depth += 1
        elif token in (")", "]"):
            depth -= 1
        if depth == 0 and token == "{":
            path.append(" ".join(words))
            words = []
        elif depth == 0 and token == "}":
            path.pop()
        elif depth == 0 and token == ";":
            found[(*path, words[0])] = " ".join(words[1:])
            words = []
        else:
            words.append(token)
    assert not path and not words and depth == 0, (path, words)
    return found


def dictionaries(folder):
    """By file within the case; the header says the format only."""
    files = {}
    for part in ("0", "constant", "system"):
        for file in sorted((folder / part).glob("*")):
            if file.is_file():
                rows = entries(file.read_text())
                files[f"{part}/{file.name}"] = {key: value for key, value in rows.items() if key[0] != "FoamFile"}
    return files


def differences(one, other):
    """{(file, *path): (value of one, value of the other)}; a file that is absent has no entries."""
    found = {}
    for file in one.keys() | other.keys():
        a, b = one.get(file, {}), other.get(file, {})
        for key in a.keys() | b.keys():
            if a.get(key) != b.get(key):
                found[(file, *key)] = (a.get(key), b.get(key))
    return found


class Dialects(BoxCase):
    def case(self, dialect, *arguments):
        folder = self.folder / f"{dialect}{len(list(self.folder.iterdir()))}"
        run = subprocess.run([ATRIA, "case", self.box, "-o", folder, "--dialect", dialect, *arguments], capture_output=True,
                             text=True, check=False)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return folder

    def compared(self, dialect, *arguments):
        return differences(dictionaries(self.case("opencfd-1912", *arguments)), dictionaries(self.case(dialect, *arguments)))

    def test_the_parser_knows_dictionaries(self):
        text = 'a 1; // no\nb { "c|d" (1 (2 3)); e { f [0 1 -1] x; } } /* g 2; */ h;'
        self.assertEqual(entries(text), {("a",): "1", ("b", '"c|d"'): "( 1 ( 2 3 ) )", ("b", "e", "f"): "[ 0 1 -1 ] x", ("h",): ""})

    def test_opencfd_differs_by_the_ground_alone(self):
        """Since v2006 heights are above the patch, displaced by d, and the ground has another wall function."""
        wanted = {("0/nut", "boundaryField", "zMin", "type"): ("nutkAtmRoughWallFunction", "atmNutkWallFunction")}
        for field in ("U", "k", "epsilon"):
            inlet = (f"0/{field}", "boundaryField", "xMin")
            wanted[(*inlet, "zGround")] = ("uniform 0", ABSENT)
            wanted[(*inlet, "d")] = (ABSENT, "uniform 0")
        self.assertEqual(self.compared("opencfd", "--age-of-air"), wanted)

    def test_opencfd_has_a_condition_for_omega(self):
        found = self.compared("opencfd", "--turbulence", "k-omega-sst")
        inlet = ("0/omega", "boundaryField", "xMin")
        self.assertEqual(found.pop((*inlet, "type")), ("fixedProfile", "atmBoundaryLayerInletOmega"))
        self.assertTrue(found.pop((*inlet, "profile"))[0].startswith("table ( ( 0 "))
        self.assertEqual(found.pop((*inlet, "direction")), ("( 0 0 1 )", ABSENT))
        self.assertEqual(found.pop((*inlet, "origin")), ("0", ABSENT))
        for key, value in (("flowDir", "( 1 0 0 )"), ("zDir", "( 0 0 1 )"), ("Uref", "5"), ("Zref", "10"), ("z0", "uniform 0.1"),
                           ("d", "uniform 0")):
            self.assertEqual(found.pop((*inlet, key)), (ABSENT, value))
        self.assertRegex(found.pop((*inlet, "value"))[1], "^uniform ")
        self.assertEqual({key[0] for key in found}, {"0/U", "0/k", "0/nut"})

    def test_the_foundation_differs_by_modules_and_functions(self):
        """Since 11 foamRun takes a module; what is measured is spelled in other ways, fields are not."""
        wanted = {
            ("system/controlDict", "application"): ("simpleFoam", ABSENT),
            ("system/controlDict", "solver"): (ABSENT, "incompressibleFluid"),
            ("constant/transportProperties", "transportModel"): ("Newtonian", ABSENT),
            ("constant/transportProperties", "nu"): ("[ 0 2 -1 0 0 0 0 ] 1.5e-05", ABSENT),
            ("constant/physicalProperties", "viscosityModel"): (ABSENT, "constant"),
            ("constant/physicalProperties", "nu"): (ABSENT, "[ 0 2 -1 0 0 0 0 ] 1.5e-05"),
            ("constant/turbulenceProperties", "simulationType"): ("RAS", ABSENT),
            ("constant/momentumTransport", "simulationType"): (ABSENT, "RAS"),
            ("constant/turbulenceProperties", "RAS", "RASModel"): ("realizableKE", ABSENT),
            ("constant/momentumTransport", "RAS", "model"): (ABSENT, "realizableKE"),
        }
        for key in ("turbulence", "printCoeffs"):
            wanted[("constant/turbulenceProperties", "RAS", key)] = ("on", ABSENT)
            wanted[("constant/momentumTransport", "RAS", key)] = (ABSENT, "on")
        average = ("system/controlDict", "functions", "average")
        wanted |= {(*average, "timeStart"): ("800", ABSENT), (*average, "startTime"): (ABSENT, "800"),
                   (*average, "mean"): (ABSENT, "yes"), (*average, "prime2Mean"): (ABSENT, "no"), (*average, "base"): (ABSENT, "time")}
        for function, region, name in (("flow_xMin", "patch", "xMin"), ("flow_xMax", "patch", "xMax"),
                                       ("flow_Wall_opening_1", "faceZone", "Wall_opening_1"),
                                       ("flowBothWays_Wall_opening_1", "faceZone", "Wall_opening_1")):
            here = ("system/controlDict", "functions", function)
            wanted |= {(*here, "regionType"): (region, ABSENT), (*here, "select"): (ABSENT, region), (*here, region): (ABSENT, name)}
            if not function.startswith("flowBoth"):
                wanted[(*here, "operation")] = ("sum", "orientedSum")
        found = self.compared("foundation")
        fields = found.pop((*average, "fields"))
        self.assertEqual(fields[1], "( U p )")
        self.assertEqual(found, wanted)
        self.assertIn("run foamRun foamRun\n", (self.case("foundation") / "Allrun").read_text())

    def test_the_foundation_has_a_function_for_the_age_of_air(self):
        """Of 11's library of fields, of 13's of solvers. It has conditions of its own, and takes schemes of the field's name."""
        folder = self.case("foundation", "--age-of-air")
        files = dictionaries(folder)
        wanted = {"type": "age", "libs": '( "libfieldFunctionObjects.so" "libsolverFunctionObjects.so" )', "diffusion": "yes",
                  "nCorr": "200", "tolerance": "1e-06", "executeControl": "writeTime", "writeControl": "writeTime"}
        age = {key[2]: value for key, value in files["system/controlDict"].items() if key[:2] == ("functions", "age")}
        self.assertEqual(age, wanted)
        self.assertNotIn("0/age", files)
        self.assertRegex((folder / "system/fvSchemes").read_text(), r"div\(phi,age\) +bounded Gauss upwind;")

    @unittest.skipUnless(shutil.which("foamDictionary"), "OpenFOAM is not installed")
    def test_openfoam_reads_all_dictionaries(self):
        environment = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
        for dialect in ("opencfd-1912", "opencfd", "foundation"):
            folder = self.case(dialect, "--processors", "2", "--age-of-air")
            for file in dictionaries(folder):
                run = subprocess.run(["foamDictionary", folder / file], capture_output=True, text=True, check=False, env=environment)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
