# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line speaks of its options where the filters speak of their properties, in JSON as well.

Usage: test_words.py ATRIA FOLDER_OF_MODELS FOLDER_OF_SOURCES
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ATRIA, DATA, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
# The command line neither sets these nor runs what tells them, and neither do options for names of files.
WITHOUT_OPTION = {"OutputType", "HistogramMetric", "NumberOfBins", "Order", "CaseDirectory", "FileName", "SplitAngle", "DomainMode",
                  "UseRanksAsProcessors"}
TEXT = re.compile(r'"((?:[^"\\]|\\.)*)"')


def headers():
    return [file for folder in ("Filters", "IO") for file in sorted((SOURCES / folder).glob("*/vtkAtria*.h"))]


def properties():
    """Names of two words at least: single ones, such as Limit, are words of English, too."""
    found = set()
    for file in headers():
        text = file.read_text(encoding="utf-8")
        found |= set(re.findall(r"vtk\w*Set\w*Macro\((\w+)", text))
        found |= {name + "s" for name in re.findall(r"void Add(\w+)\(", text)}
    return {name for name in found if re.fullmatch(r"[A-Z][a-z]+(?:[A-Z][a-z]*)+", name)}


def ranged():
    return {name for file in headers() for name in re.findall(r"vtkAtriaSetInRangeMacro\((\w+), \w+, [^)]", file.read_text(encoding="utf-8"))}


def table():
    """What Words.cxx has options for."""
    text = (SOURCES / "Examples/CommandLine/Words.cxx").read_text(encoding="utf-8")
    return " ".join(re.findall(r'std::pair\{"([^"]+)", "', text))


def known(name):
    return name in WITHOUT_OPTION or re.search(rf"\b{name}\b", table())


class Words(unittest.TestCase):
    def test_every_property_that_messages_name_has_an_option(self):
        names = properties()
        self.assertIn("SurfaceSizeRules", names)
        missing = []
        for folder in ("Filters", "IO"):
            for file in sorted((SOURCES / folder).rglob("*.cxx")):
                for line in file.read_text(encoding="utf-8").splitlines():
                    if "indent <<" in line:
                        continue  # of PrintSelf
                    for text in TEXT.findall(line):
                        words = set(re.findall(r"\w+", text)) & names if " " in text else ()
                        missing += [f"{file.name}: {word}" for word in words if not known(word)]
        self.assertEqual(missing, [])

    def test_every_property_with_a_range_has_an_option(self):
        self.assertIn("DomainSides", ranged())
        self.assertEqual([name for name in sorted(ranged() - {"name"}) if not known(name)], [])

    def texts_in(self, value):
        if isinstance(value, dict):
            for one in value.values():
                yield from self.texts_in(one)
        elif isinstance(value, list):
            for one in value:
                yield from self.texts_in(one)
        elif isinstance(value, str) and " " in value:
            yield value

    def assert_in_options(self, texts, *wanted):
        for text in texts:
            self.assertFalse(properties() & set(re.findall(r"\w+", text)), text)
        for option in wanted:
            self.assertTrue(any(option in text for text in texts), f"{option}: {texts}")

    def test_json_speaks_of_options(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder)

            def run(*arguments):
                done = subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)
                self.assertIn(done.returncode, (0, 4, 5), done.stderr)
                return done

            sizes = ["--size-max", "8", "--size-mid", "4", "--size-min", "4"]
            cut = ["--domain", "5", "20", "0", "14", "0", "30"]
            done = run("mesh", DATA / "house.wrl", *sizes, *cut, "--preflight", "--report", out / "preflight.json")
            texts = list(self.texts_in(json.loads((out / "preflight.json").read_text())))
            self.assert_in_options([*texts, *done.stderr.splitlines()], "--domain", "--size-min")
            self.assertFalse(any("--automatic, --automatic" in text or "(--terrain)" in text for text in texts), texts)
            done = run("mesh", DATA / "house.wrl", *sizes, "--layers", "0", "--openfoam", out / "case", "-o", out / "m.vtu",
                       "--report", out / "mesh.json")
            self.assert_in_options([*self.texts_in(json.loads((out / "mesh.json").read_text())), *done.stderr.splitlines()],
                                   "(--layers)")
            done = run("quality", out / "m.vtu", "--checks", "--json")
            self.assert_in_options([*self.texts_in(json.loads(done.stdout)), *done.stderr.splitlines()], "(--layers)",
                                   "--first-layer")
            done = run("inspect", DATA / "sketchup_house.wrl", "--json")
            self.assert_in_options([*self.texts_in(json.loads(done.stdout)), *done.stderr.splitlines()], "--unit", "--up")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
