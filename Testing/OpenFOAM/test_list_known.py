# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests list_known.py with sources and a case that are made up, so that OpenFOAM is not needed."""

import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from foam_dictionary import DictionaryError, parse

PROGRAM = pathlib.Path(__file__).with_name("list_known.py")

FIELDS = "src/finiteVolume/fields/fvPatchFields"
SCHEMES = "src/finiteVolume/finiteVolume"
METER = "src/functionObjects/meter"

# A version of OpenFOAM, as small as can be.
SOURCES = {
    # A program
    "applications/solvers/testFoam/testFoam.C": "int main() { return 0; }",
    "applications/solvers/testFoam/Make/files": "testFoam.C\n\nEXE = $(FOAM_APPBIN)/testFoam\n",
    # The keywords and classes of files
    "src/OpenFOAM/db/Time/Time.C": 'read("controlDict"); read("application"); read("endTime"); read("functions");',
    "src/OpenFOAM/db/IOdictionary/IOdictionary.H": 'class IOdictionary { TypeName("dictionary"); };',
    "src/OpenFOAM/fields/GeometricFields/GeometricField.C":
        'read("dimensions"); read("internalField"); read("boundaryField");',
    "src/finiteVolume/fields/volFields/volFields.C":
        'defineTemplateTypeNameAndDebugWithName(volScalarField, "volScalarField", 0);',
    # Boundary conditions: the base class, one that is registered, and one that is not
    f"{FIELDS}/fvPatchField/fvPatchField.H": "template<class Type> class fvPatchField { };",
    f"{FIELDS}/fvPatchField/fvPatchField.C": 'read("value"); read("uniform");',
    f"{FIELDS}/jet/jetFvPatchScalarField.H":
        'class jetFvPatchScalarField : public fvPatchScalarField { TypeName("jet"); };',
    f"{FIELDS}/jet/jetFvPatchScalarField.C":
        'makePatchTypeField(fvPatchScalarField, jetFvPatchScalarField); dict.lookup("speed"); // "oldSpeed"',
    f"{FIELDS}/hidden/hiddenFvPatchScalarField.H":
        'class hiddenFvPatchScalarField : public fvPatchScalarField { TypeName("hidden"); };',
    # Function objects: the base class, one in a library, and a library without it
    "src/OpenFOAM/db/functionObjects/functionObject/functionObject.H": "class functionObject { };",
    "src/OpenFOAM/db/functionObjects/functionObject/functionObject.C": 'read("log");',
    f"{METER}/meter/meter.H": '#include "reader.H"\nclass meter : public functionObject { TypeName("meter"); };',
    f"{METER}/meter/meter.C": 'addToRunTimeSelectionTable(functionObject, meter, dictionary); read("position");',
    f"{METER}/Make/files": "folder = meter\n$(folder)/meter.C\n\nLIB = $(FOAM_LIBBIN)/libmeter\n",
    "src/reader/reader.H": "class reader { };",
    "src/reader/reader.C": 'read("unit");',
    "src/other/other.C": "",
    "src/other/Make/files": "other.C\n\nLIB = $(FOAM_LIBBIN)/libother\n",
    # Schemes, and a tutorial that has the key div(phi,k)
    f"{SCHEMES}/fvSchemes.C": 'read("fvSchemes"); read("divSchemes"); read("default");',
    f"{SCHEMES}/convectionScheme/convectionScheme.H": "class convectionScheme { };",
    f"{SCHEMES}/gauss/gaussScheme.H": 'class gaussScheme : public convectionScheme { TypeName("Gauss"); };',
    f"{SCHEMES}/gauss/gaussScheme.C": "makeFvConvectionScheme(gaussScheme)",
    "tutorials/pipe/system/fvSchemes": "divSchemes { div(phi,k) Gauss; }",
}

CONTROL = """
FoamFile { version 2.0; class dictionary; }
application testFoam;
endTime 10;
functions
{
    meter1 { type meter; libs ("libmeter.so"); position (0 0 1); log yes; unit 1; }
}
"""

SCHEMES_FILE = """
FoamFile { version 2.0; class dictionary; }
divSchemes { default none; div(phi,T) Gauss; }
"""

FIELD = """
FoamFile { version 2.0; class volScalarField; }
dimensions [0 0 0 1 0 0 0];
internalField uniform 0;
boundaryField
{
    inlet { type jet; speed 2; value uniform 0; }
}
"""

CASE = {"system/controlDict": CONTROL, "system/fvSchemes": SCHEMES_FILE, "0/T": FIELD}


def write_files(folder, files):
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def run(*arguments):
    command = [sys.executable, "-B", PROGRAM, *arguments]
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)


def cells(output):
    """{entry: its cells} of the table."""
    rows = [line.strip("| ").split(" | ") for line in output.splitlines() if line.startswith("| `")]
    return {row[0].strip("`"): row[1:] for row in rows}


class TemporaryFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)


class WithCase(TemporaryFolder):
    """Has the sources and the case in a temporary folder."""

    def setUp(self):
        super().setUp()
        self.sources = self.folder / "sources"
        self.case = self.folder / "case"
        write_files(self.sources, SOURCES)
        write_files(self.case, CASE)

    def replace(self, name, old, new):
        """Changes a file of the case."""
        text = CASE[name]
        self.assertIn(old, text)
        write_files(self.case, {name: text.replace(old, new)})

    def check(self, *options):
        return run(*options, f"test={self.sources}", "--", self.case)

    def assert_not_known(self, *entries):
        """Exactly these entries are not known."""
        result = self.check()
        self.assertEqual(result.stderr, "")
        found = cells(result.stdout)
        self.assertEqual({entry for entry, row in found.items() if row == ["no"]}, set(entries))
        self.assertEqual(list(found)[:len(entries)], sorted(entries), "these come first")
        self.assertEqual(result.returncode, 1 if entries else 0)
        self.assertTrue(result.stdout.endswith(f"test: {len(found)} entries, {len(entries)} not known\n"))


class KnownTest(WithCase):
    def test_all_entries_are_known(self):
        self.assert_not_known()

    def test_where(self):
        found = cells(self.check("--where").stdout)
        expected = {
            "application testFoam": "applications/solvers/testFoam/Make/files",
            "class dictionary": "src/OpenFOAM/db/IOdictionary/IOdictionary.H",
            "class volScalarField": "src/finiteVolume/fields/volFields/volFields.C",
            "condition: type jet": f"{FIELDS}/jet/jetFvPatchScalarField.H",
            "condition jet: speed": f"{FIELDS}/jet/jetFvPatchScalarField.C",
            "condition jet: value": f"{FIELDS}/fvPatchField/fvPatchField.C",
            "condition jet: value uniform": f"{FIELDS}/fvPatchField/fvPatchField.C",
            "controlDict: application": "src/OpenFOAM/db/Time/Time.C",
            "controlDict: endTime": "src/OpenFOAM/db/Time/Time.C",
            "controlDict: functions": "src/OpenFOAM/db/Time/Time.C",
            "divSchemes Gauss": f"{SCHEMES}/gauss/gaussScheme.H",
            "field: boundaryField": "src/OpenFOAM/fields/GeometricFields/GeometricField.C",
            "field: dimensions": "src/OpenFOAM/fields/GeometricFields/GeometricField.C",
            "field: internalField": "src/OpenFOAM/fields/GeometricFields/GeometricField.C",
            "file controlDict": "src/OpenFOAM/db/Time/Time.C",
            "file fvSchemes": f"{SCHEMES}/fvSchemes.C",
            "function: type meter": f"{METER}/meter/meter.H",
            "function meter: is in libmeter": f"{METER}/meter/meter.C",
            "function meter: log": "src/OpenFOAM/db/functionObjects/functionObject/functionObject.C",
            "function meter: position": f"{METER}/meter/meter.C",
            "function meter: unit": "(included) src/reader/reader.C",
            "fvSchemes: divSchemes": f"{SCHEMES}/fvSchemes.C",
            "fvSchemes: divSchemes: default": f"{SCHEMES}/fvSchemes.C",
            "fvSchemes: divSchemes: div(phi,T)": "tutorials/pipe/system/fvSchemes",
            "libs libmeter": f"{METER}/Make/files",
        }
        self.assertEqual(found, {entry: [where] for entry, where in expected.items()})

    def test_key_with_choices(self):
        self.replace("system/fvSchemes", "div(phi,T)", r'"div\(phi,(T|k)\)"')
        self.assert_not_known()
        key = r'fvSchemes: divSchemes: "div\(phi,(T\|k)\)"'
        found = cells(self.check().stdout)
        self.assertEqual(found[f"{key} = div(phi,T)"], ["known"])
        self.assertEqual(found[f"{key} = div(phi,k)"], ["known"])

    def test_names_of_the_case(self):
        """Patches and their groups are not looked up, and nor is what the mesh writes of itself."""
        write_files(self.sources, {
            "src/mesh/polyPatch.H": 'class polyPatch { TypeName("patch"); };',
            "src/mesh/polyPatch.C": 'addToRunTimeSelectionTable(polyPatch, polyPatch, dictionary); read("inGroups");',
            "src/mesh/polyBoundaryMesh.H": 'class polyBoundaryMesh { TypeName("polyBoundaryMesh"); };',
        })
        write_files(self.case, {"constant/polyMesh/boundary": """
            FoamFile { version 2.0; class polyBoundaryMesh; }
            1 ( inlet { type patch; inGroups (openings); nFaces 2; startFace 3; } )
        """})
        self.replace("system/controlDict", "log yes", "log (inlet openings T)")
        self.assert_not_known()
        self.replace("system/controlDict", "log yes", "log (inlet outlet)")
        self.assert_not_known("function meter: log outlet")

    @unittest.skipUnless(shutil.which("git"), "needs git")
    def test_revision_of_a_repository(self):
        git = ["git", "-C", self.sources, "-c", "user.name=test", "-c", "user.email=test@example.org"]
        for arguments in (["init", "-q"], ["add", "."], ["commit", "-q", "-m", "Sources"]):
            subprocess.run([*git, *arguments], check=True, capture_output=True)
        from_folder = self.check("--where")
        from_git = run("--where", f"test={self.sources}/.git@HEAD", "--", self.case)
        self.assertEqual(from_git.stdout, from_folder.stdout)
        self.assertEqual(from_git.returncode, 0)
        no_revision = run(f"test={self.sources}/.git@nothing", "--", self.case)
        self.assertEqual(no_revision.returncode, 2)
        self.assertIn("has no revision nothing", no_revision.stderr)

    def test_two_versions(self):
        other = self.folder / "other"
        write_files(other, SOURCES)
        write_files(other, {f"{FIELDS}/jet/jetFvPatchScalarField.C": ""})
        result = run(f"new={self.sources}", f"old={other}", "--", self.case)
        found = cells(result.stdout)
        self.assertTrue(result.stdout.startswith("| entry | new | old |\n"))
        self.assertEqual(found["condition: type jet"], ["known", "no"])
        self.assertEqual(found["condition jet: speed"], ["known", "-"])
        self.assertEqual(found["controlDict: endTime"], ["known", "known"])
        self.assertTrue(result.stdout.endswith("new: 25 entries, 0 not known\nold: 22 entries, 1 not known\n"))
        self.assertEqual(result.returncode, 1)


class NotKnownTest(WithCase):
    def test_keyword(self):
        self.replace("0/T", "speed", "sped")
        self.assert_not_known("condition jet: sped")

    def test_keyword_that_only_a_comment_has(self):
        self.replace("0/T", "speed", "oldSpeed")
        self.assert_not_known("condition jet: oldSpeed")

    def test_keyword_of_another_class(self):
        self.replace("0/T", "speed", "position")
        self.assert_not_known("condition jet: position")

    def test_keyword_of_no_type(self):
        self.replace("system/controlDict", "endTime", "endtime")
        self.assert_not_known("controlDict: endtime")

    def test_word_given_as_value(self):
        self.replace("0/T", "value uniform", "value uniformly")
        self.assert_not_known("condition jet: value uniformly")

    def test_type(self):
        self.replace("0/T", "type jet", "type jett")
        self.assert_not_known("condition: type jett")

    def test_type_that_is_not_registered(self):
        self.replace("0/T", "type jet", "type hidden")
        self.assert_not_known("condition: type hidden")

    def test_type_of_another_base_class(self):
        self.replace("0/T", "type jet", "type meter")
        self.assert_not_known("condition: type meter")

    def test_library_without_the_function_object(self):
        self.replace("system/controlDict", "libmeter", "libother")
        self.assert_not_known("function meter: is in libother")

    def test_library(self):
        self.replace("system/controlDict", "libmeter", "libnothing")
        self.assert_not_known("libs libnothing", "function meter: is in libnothing")

    def test_program(self):
        self.replace("system/controlDict", "testFoam", "otherFoam")
        self.assert_not_known("application otherFoam")

    def test_scheme(self):
        self.replace("system/fvSchemes", "Gauss", "Gaus")
        self.assert_not_known("divSchemes Gaus")

    def test_key_made_of_fields(self):
        self.replace("system/fvSchemes", "div(phi,T)", "div(T)")
        self.assert_not_known("fvSchemes: divSchemes: div(T)")

    def test_class_of_file(self):
        self.replace("0/T", "volScalarField", "volThingField")
        self.assert_not_known("class volThingField")

    def test_file(self):
        write_files(self.case, {"constant/thing": "FoamFile { class dictionary; }"})
        self.assert_not_known("file thing")


class ErrorTest(WithCase):
    def assert_error(self, sentence, *arguments):
        result = run(*arguments)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn(sentence, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        self.assertEqual(result.stdout, "")

    def test_no_sources(self):
        self.assert_error("There is no folder /nothing.", "test=/nothing", "--", self.case)
        self.assert_error("There is no repository /nothing.", "test=/nothing@HEAD", "--", self.case)
        self.assert_error("has no folder src", f"test={self.case}", "--", self.case)

    def test_no_case(self):
        version = f"test={self.sources}"
        self.assert_error("There are no cases", version)
        self.assert_error("There are no cases", version, "--")
        self.assert_error("There is no folder /nothing.", version, "--", "/nothing")
        (self.case / "system/controlDict").unlink()
        self.assert_error("it has no system/controlDict", version, "--", self.case)

    def test_no_versions(self):
        self.assert_error("NAME=SOURCES", "--", self.case)
        self.assert_error("is not NAME=SOURCES", self.sources, "--", self.case)
        self.assert_error("is given to two versions", "a=/b", "a=/c", "--", self.case)

    def test_case_that_cannot_be_read(self):
        version = f"test={self.sources}"
        self.replace("0/T", "uniform 0; }", "uniform 0;")
        self.assert_error("T ends within an entry", version, "--", self.case)
        self.replace("0/T", "FoamFile", "Header")
        self.assert_error("T has no FoamFile header", version, "--", self.case)
        self.replace("0/T", "type jet;", "type;")
        self.assert_error("has no value: condition: type", version, "--", self.case)
        self.replace("0/T", "inlet {", "$inlet; other {")
        self.assert_error("is not a dictionary: condition", version, "--", self.case)


class ParserTest(TemporaryFolder):
    def parse(self, text, **others):
        write_files(self.folder, {"file": text, **others})
        return parse(self.folder / "file")

    def test_nested_dictionaries(self):
        self.assertEqual(self.parse("a { b { c 1; } d 2; } e 3;"), {"a": {"b": {"c": ["1"]}, "d": ["2"]}, "e": ["3"]})

    def test_lists(self):
        found = self.parse("a (1 2 (x y)); b 2 ({ c 1; } z); d;")
        self.assertEqual(found, {"a": [["1", "2", ["x", "y"]]], "b": ["2", [{"c": ["1"]}, "z"]], "d": []})

    def test_file_that_is_a_list(self):
        self.assertEqual(self.parse("1 ( wall { type wall; } )"), {"": ["wall", {"type": ["wall"]}]})

    def test_comments(self):
        found = self.parse('a 1; // b 2;\n/* c 3;\n d 4; */ e "//f"; // g\n')
        self.assertEqual(found, {"a": ["1"], "e": ['"//f"']})

    def test_header_is_left_out(self):
        self.assertEqual(self.parse("FoamFile { class dictionary; } a 1;"), {"a": ["1"]})

    def test_include(self):
        found = self.parse('a 1;\n#include "other"\nc 3;', other="FoamFile { class dictionary; }\nb { d 2; }")
        self.assertEqual(found, {"a": ["1"], "b": {"d": ["2"]}, "c": ["3"]})
        with self.assertRaisesRegex(DictionaryError, "nothing cannot be read"):
            self.parse('#include "nothing"')

    def test_dimensions(self):
        self.assertEqual(self.parse("nu [0 2 -1 0 0 0 0] 1.5e-05;"),
                         {"nu": [["0", "2", "-1", "0", "0", "0", "0"], "1.5e-05"]})

    def test_keys(self):
        found = self.parse('"(U|k).*" 1; div(phi,k) Gauss linear; grad(U) { a 2; }')
        self.assertEqual(found, {'"(U|k).*"': ["1"], "div(phi,k)": ["Gauss", "linear"], "grad(U)": {"a": ["2"]}})

    def test_end_within_an_entry(self):
        for text in ("a 1", "a (1;", "a { b 1;"):
            with self.subTest(text), self.assertRaisesRegex(DictionaryError, "ends within an entry"):
                self.parse(text)


if __name__ == "__main__":
    unittest.main()
