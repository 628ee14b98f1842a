# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case --dialect: dictionaries of the releases differ where their sources do, and nowhere else.

Usage: test_dialects.py ATRIA

The keywords were looked up in the sources of OpenCFD's 1912 and v2006 to v2512 and of the Foundation's 11 to 14; only
Debian's 1912 can be run here.
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
MEASURED = (("flow_xMin", "patch", "xMin"), ("flow_xMax", "patch", "xMax"), ("flow_Wall_opening_1", "faceZone", "Wall_opening_1"),
            ("flowBothWays_Wall_opening_1", "faceZone", "Wall_opening_1"))


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
        self.assertEqual(self.compared("opencfd-2006", "--age-of-air"), wanted)

    def test_opencfd_has_a_condition_for_omega(self):
        found = self.compared("opencfd-2006", "--turbulence", "k-omega-sst")
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
        for function, region, name in MEASURED:
            here = ("system/controlDict", "functions", function)
            wanted |= {(*here, "regionType"): (region, ABSENT), (*here, "select"): (ABSENT, region), (*here, region): (ABSENT, name)}
            if not function.startswith("flowBoth"):
                wanted[(*here, "operation")] = ("sum", "orientedSum")
        found = self.compared("foundation-11")
        fields = found.pop((*average, "fields"))
        self.assertEqual(fields[1], "( U p )")
        self.assertEqual(found, wanted)
        self.assertIn("run foamRun foamRun\n", (self.case("foundation-11") / "Allrun").read_text())

    def test_the_foundation_has_a_function_for_the_age_of_air(self):
        """Of 11's library of fields, of 13's of solvers. It has conditions of its own, and takes schemes of the field's name."""
        folder = self.case("foundation-11", "--age-of-air")
        files = dictionaries(folder)
        wanted = {"type": "age", "libs": '( "libfieldFunctionObjects.so" "libsolverFunctionObjects.so" )', "diffusion": "yes",
                  "nCorr": "200", "tolerance": "1e-06", "executeControl": "writeTime", "writeControl": "writeTime"}
        age = {key[2]: value for key, value in files["system/controlDict"].items() if key[:2] == ("functions", "age")}
        self.assertEqual(age, wanted)
        self.assertNotIn("0/age", files)
        self.assertRegex((folder / "system/fvSchemes").read_text(), r"div\(phi,age\) +bounded Gauss upwind;")

    def test_the_foundation_keeps_the_wind_in_a_file_since_14(self):
        """Conditions have other names and take the profile from there; fvSolution says how often age is solved for."""
        arguments = ("--age-of-air",)
        one, other = (dictionaries(self.case(dialect, *arguments)) for dialect in ("foundation-11", "foundation-14"))
        wanted = {("constant/momentumTransport", "RAS", "printCoeffs"): ("on", ABSENT),
                  ("0/nut", "boundaryField", "zMin", "type"): ("nutkAtmRoughWallFunction", "nutAtmosphericBoundaryLayerWallFunction"),
                  ("0/nut", "boundaryField", "zMin", "z0"): ("uniform 0.1", ABSENT)}
        profile = {"flowDir": "( 1 0 0 )", "zDir": "( 0 0 1 )", "Uref": "5", "Zref": "10", "z0": "0.1", "zGround": "0"}
        names = {"U": ("Velocity", "Velocity"), "k": ("K", "TurbulentKineticEnergy"), "epsilon": ("Epsilon", "TurbulentEpsilon")}
        for field, (old, new) in names.items():
            inlet = (f"0/{field}", "boundaryField", "xMin")
            wanted[(*inlet, "type")] = (f"atmBoundaryLayerInlet{old}", f"atmosphericBoundaryLayer{new}")
            for key, value in profile.items():
                wanted[(*inlet, key)] = (f"uniform {value}" if key.startswith("z") and key != "zDir" else value, ABSENT)
        for key, value in profile.items():
            wanted[("constant/atmosphericBoundaryLayerProperties", key)] = (
                ABSENT, f"constant {value}" if key in ("z0", "zGround") else value)
        for function, region, name in MEASURED:
            here = ("system/controlDict", "functions", function)
            wanted |= {(*here, "select"): (region, ABSENT), (*here, "name"): (name, ABSENT)}
        found = differences(one, other)
        solvers = {key: values for key, values in found.items() if key[:2] == ("system/fvSolution", "solvers")}
        self.assertEqual({key: values for key, values in found.items() if key not in solvers}, wanted)
        self.assertEqual(solvers[("system/fvSolution", "solvers", "age", "nCorr")], (ABSENT, "200"))
        self.assertIn(("system/fvSolution", "solvers", '"(U|k|epsilon|omega)"', "solver"), solvers)

    def test_a_room_of_14_has_no_wind(self):
        folder = self.case("foundation-14", "--kind", "room", "--patch", "xMin", "inlet:1m/s", "--patch", "xMax", "outlet",
                           "--patch", "y*", "wall", "--patch", "z*", "wall")
        self.assertFalse((folder / "constant/atmosphericBoundaryLayerProperties").exists())
        self.assertNotIn("atmospheric", (folder / "0/U").read_text() + (folder / "system/controlDict").read_text())

    @unittest.skipUnless(shutil.which("foamDictionary"), "OpenFOAM is not installed")
    def test_openfoam_reads_all_dictionaries(self):
        environment = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
        for dialect in ("opencfd-1912", "opencfd-2006", "foundation-11", "foundation-14"):
            folder = self.case(dialect, "--processors", "2", "--age-of-air")
            for file in dictionaries(folder):
                run = subprocess.run(["foamDictionary", folder / file], capture_output=True, text=True, check=False, env=environment)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
