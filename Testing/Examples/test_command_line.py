# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command line takes and refuses, and that threads change nothing.

Usage: test_command_line.py ATRIA FOLDER_OF_MODELS
"""

import json
import sys
import unittest

from command_line import COARSE, HOUSE, CommandLineTest


class CommandLine(CommandLineTest):
    def test_help_is_no_error(self):
        for arguments in (["--help"], ["mesh", "--help"], ["inspect", "--help"], ["quality", "--help"], ["improve", "--help"],
                          ["convert", "--help"], ["climate", "--help"], ["--version"]):
            run = self.atria(*arguments)
            self.assertEqual((run.returncode, run.stderr), (0, ""), arguments)

    def test_usage_errors(self):
        out = self.folder / "out.vtu"
        self.refuses(2, "subcommand")
        self.refuses(2, "MODEL", "mesh", "-o", out)
        self.refuses(2, "--size-min", "mesh", HOUSE, "-o", out, "--size-min", "-1")
        self.refuses(2, "'0,5' is not a number more than 0; decimals follow a point: 0.5", "mesh", HOUSE, "--size-min", "0,5")
        self.refuses(2, "sizes", "mesh", HOUSE, "-o", out, "--size-mid", "16", "--size-max", "8")
        self.refuses(2, "--domain", "mesh", HOUSE, "-o", out, "--domain", "1", "0", "0", "1", "0", "1")
        self.refuses(2, "--site", "mesh", HOUSE, "-o", out, "--site", "Site", "--domain", "0", "1", "0", "1", "0", "1")
        self.refuses(2, "--zone", "mesh", HOUSE, "-o", out, "--zone", "inside")
        self.refuses(2, "--size", "mesh", HOUSE, "-o", out, "--size", "Wall*", "0.5:x")
        self.refuses(2, "--gap-cells", "mesh", HOUSE, "-o", out, "--gap-cells", "-1")
        self.refuses(2, "--cells-per-level", "mesh", HOUSE, "-o", out, "--cells-per-level", "0")
        for wrong in ("x", "-1", "1.5", "101", "1:2", "Wall*=", "Wall*=1:x", "Wall*=1:1:1:1"):
            self.refuses(2, "--layers", "mesh", HOUSE, "-o", out, f"--layers={wrong}")
        self.refuses(2, "--layer-growth", "mesh", HOUSE, "-o", out, "--layer-growth", "0")
        self.refuses(2, "--first-layer", "mesh", HOUSE, "-o", out, "--first-layer", "-1")
        self.refuses(2, "--threads", "mesh", HOUSE, "-o", out, "--threads", "0")
        self.refuses(2, ".vtu", "mesh", HOUSE, "-o", self.folder / "out.vtk")
        self.refuses(2, ".vtpc", "mesh", HOUSE, "-o", out, "--patches", self.folder / "out.vtm")
        self.refuses(2, "does not exist", "mesh", HOUSE, "-o", self.folder / "absent" / "out.vtu")
        self.refuses(2, "WallSouth", "mesh", HOUSE, "-o", out, "--site", "Lawn")
        self.assertFalse(out.exists())

    def test_bad_input(self):
        out = self.folder / "bad.vtu"
        self.refuses(3, "does not exist", "mesh", self.folder / "absent.wrl", "-o", out)
        self.refuses(3, "is a folder", "inspect", self.folder)
        text = self.folder / "text.wrl"
        text.write_text("This is no model.\n")
        self.refuses(3, "text.wrl", "inspect", text)
        self.refuses(3, "text.wrl", "quality", text)
        self.assertFalse(out.exists())
        parts = self.folder / "parts.wrl"
        parts.write_text('#VRML V2.0 utf8\nInline { url "gone.wrl" }\n')
        self.refuses(3, "parts.wrl:2:1: Inline: cannot read 'gone.wrl'", "inspect", parts)

    def test_other_formats(self):
        faces = {"Floor": "1 4 3 2", "Wall South": "1 2 6 5", "Wall North": "3 4 8 7", "Wall West": "4 1 5 8", "Roof": "5 6 7 8"}
        points = "".join(f"v {x} {y} {z}\n" for z in (0, 6) for x, y in ((0, 0), (8, 0), (8, 6), (0, 6)))
        obj = self.folder / "shed.obj"
        obj.write_text(points + "".join(f"g {name}\nf {face}\n" for name, face in faces.items()) + "l 1 2\n")
        run = self.atria("inspect", obj, "--json")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("shed.obj: 1 lines", run.stderr)
        report = json.loads(run.stdout)
        self.assertEqual([surface["name"] for surface in report["surfaces"]], list(faces))
        self.assertAlmostEqual(report["total"]["area"], 2 * 48 + 2 * 48 + 36)
        self.assertEqual(len(report["warnings"]), 1)
        out = self.folder / "shed.json"
        run = self.atria("mesh", obj, "-o", self.folder / "shed.vtu", *COARSE[:6], "--domain", "-16", "24", "-16", "24",
                         "0", "24", "--report", out)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        patches = {patch["name"] for patch in json.loads(out.read_text())["patches"]}
        self.assertLessEqual({"Roof_front", "Wall South_back", "Floor"}, patches)
        self.assertEqual(self.atria("mesh", obj, "--preflight", "--automatic").returncode, 0)
        unknown = "of no format that is known; give VRML"
        for name, what in (("shed.xyz", unknown), ("shed", unknown), ("shed.obj.gz", "is an archive; unpack it first"),
                           ("shed.dwg", "AutoCAD's own format, which is not read; export it there as DXF"),
                           ("shed.SKP", "SketchUp's own format"), ("shed.stp", "export it as OBJ or STL")):
            other = self.folder / name
            other.write_text("0\nSECTION\n")
            self.refuses(3, what, "inspect", other)
        for ending in ("wrl", "obj", "stl", "ply", "glb", "dae", "ifc", "dxf", "json", "vtp"):
            other = self.folder / f"empty.{ending}"
            other.write_text("")
            self.refuses(3, "holds no surfaces: it is empty", "mesh", other)
            self.assertNotIn("warning", self.atria("mesh", other).stderr)
        broken = self.folder / "broken.stl"
        broken.write_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n")
        self.refuses(3, "broken.stl", "inspect", broken)

    def test_vrml_by_any_of_its_endings(self):
        wanted = self.atria("inspect", HOUSE, "--json")
        self.assertEqual(wanted.returncode, 0, wanted.stderr)
        for name in ("house.vrml", "HOUSE.VRML"):
            copy = self.folder / name
            copy.write_bytes(HOUSE.read_bytes())
            run = self.atria("inspect", copy, "--json")
            self.assertEqual((run.returncode, run.stdout), (0, wanted.stdout), run.stderr)

    def test_the_same_files_whatever_the_threads(self):
        written = []
        for threads in (1, 2, 7):
            out = self.folder / f"threads{threads}.vtu"
            self.assertIn(self.atria("mesh", HOUSE, "-o", out, "--site", "Site", "--threads", threads).returncode, (0, 4))
            written.append(out.read_bytes())
        self.assertEqual(written[0], written[1])
        self.assertEqual(written[0], written[2])

    def without_seconds(self, file):
        """Counts and metrics to the last digit. (The files differ in the seconds they hold.)"""
        return self.atria("quality", file, "--json").stdout

    def test_same_mesh_from_any_number_of_threads(self):
        files = []
        for threads in ("1", "3"):
            files.append(self.folder / f"threads{threads}.vtu")
            run = self.atria("mesh", HOUSE, "-o", files[-1], *COARSE, "--threads", threads)
            self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertEqual(*(self.without_seconds(file) for file in files))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
