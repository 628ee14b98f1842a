# SPDX-License-Identifier: GPL-3.0-or-later
"""Domains, seeds, and what is left out of the mesh.

Usage: test_domains.py ATRIA FOLDER_OF_MODELS
"""

import json
import re
import sys
import unittest

from command_line import COARSE, DATA, FINE, HOUSE, CommandLineTest


class Domains(CommandLineTest):
    def test_preflight(self):
        report = self.folder / "preflight.json"
        run = self.atria("mesh", HOUSE, *COARSE, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("BuildingHeight", run.stdout)
        self.assertIn("narrowest opening", run.stderr)
        data = json.loads(report.read_text())
        self.assertAlmostEqual(data["BuildingHeight"], 11)
        self.assertAlmostEqual(data["OpeningWidth"], 1.0)
        self.assertAlmostEqual(data["DomainZMax"], 68.1)
        self.assertAlmostEqual(data["Blockage"], (14 * 7 + 14 * 2) / (182 * 68.1), places=6)
        self.assertTrue(data["warnings"])
        # The filter itself warns, as ParaView shows nothing of a table's field arrays.
        self.assertEqual(run.stderr.count("warning:"), len(data["warnings"]), run.stderr)

    def test_domain_and_grid_options(self):
        turned = DATA / "house_turned17.wrl"
        report, out = self.folder / "turned.json", self.folder / "turned.vtu"
        run = self.atria("mesh", turned, "-o", out, "--automatic", "--wind", "30", "--align", "walls", "--size-max", "16",
                         "--size-mid", "4", "--size-min", "2", "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        areas = {patch["name"]: patch["area"] for patch in json.loads(report.read_text())["patches"]}
        self.assertAlmostEqual(areas["xMin"] / areas["xMax"], 1, places=2)
        self.refuses(2, "--automatic", "mesh", HOUSE, "-o", out, "--automatic", "--site", "Site")
        self.refuses(2, "--wind", "mesh", HOUSE, "-o", out, "--wind", "10", "--site", "Site")
        self.refuses(2, "--model-bounds", "mesh", HOUSE, "-o", out, "--model-bounds", "--site", "Site")
        self.refuses(2, "--domain-angle needs", "mesh", HOUSE, "-o", out, "--domain-angle", "10")
        self.refuses(2, "--domain-sides", "mesh", HOUSE, "-o", out, "--domain-sides", "2")
        self.refuses(2, "R must be above 0", "mesh", HOUSE, "-o", out, "--domain-cylinder", "0", "0", "0", "0", "5")
        self.refuses(2, "'1' is no corner", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 1")
        self.refuses(2, "--domain-sides", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 0,9", "--domain-sides", "3")
        self.refuses(2, "--domain-polygon", "mesh", HOUSE, "-o", out, "--domain-heights", "0", "9")
        self.refuses(2, "Z0 must be less", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 0,9", "--domain-heights", "9", "0")
        self.refuses(3, "not convex at corner 3 (1, 1)", "mesh", HOUSE, "-o", out, "--domain-polygon", "0,0 9,0 1,1 0,9")
        self.refuses(2, "--align", "mesh", HOUSE, "-o", out, "--align", "roof")
        self.refuses(3, "dgm*", "mesh", HOUSE, "-o", out, "--terrain", "dgm*")

    def preflight(self, *options):
        report = self.folder / "domain.json"
        run = self.atria("mesh", *options, "--preflight", "--report", report)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text())

    def test_the_domain_follows_from_the_buildings_unless_it_is_given(self):
        sizes = COARSE[:6]
        plain = self.preflight(HOUSE, *sizes)
        self.assertEqual(plain, self.preflight(HOUSE, *sizes, "--automatic"))
        for side, heights in (("XMin", 5), ("XMax", 15), ("YMin", 5), ("YMax", 5), ("ZMax", 5)):
            self.assertAlmostEqual(plain["Distance" + side], heights)
        self.assertEqual(plain["DomainAngle"], 0)
        self.assertEqual(self.preflight(HOUSE, *sizes, "--wind", 20)["DomainAngle"], 20)
        bounds = self.preflight(HOUSE, *sizes, "--model-bounds")
        self.assertEqual([bounds["Domain" + side] for side in ("XMin", "XMax", "YMin", "YMax", "ZMin", "ZMax")],
                         [-90, 137, -84, 98, 0, 11])
        self.assertEqual(self.preflight(HOUSE, *sizes, "--model-bounds", "--domain-angle", 5)["DomainAngle"], 5)
        self.assertEqual((plain["DomainSides"], self.preflight(HOUSE, *sizes, "--domain-sides", 8)["DomainSides"]), (4, 8))
        cylinder = self.preflight(HOUSE, *sizes, "--domain-cylinder", 30, 5, 200, 0, 60)
        self.assertEqual(cylinder["DomainSides"], 16)
        triangle = self.preflight(HOUSE, *sizes, "--domain-polygon", "-90,-80 130,-70 20,95")
        self.assertEqual((triangle["DomainSides"], triangle["DomainXMin"], triangle["DomainYMax"]), (3, -90, 95))
        self.assertEqual((triangle["DomainZMin"], triangle["DomainZMax"]), (plain["DomainZMin"], plain["DomainZMax"]))
        self.assertEqual({name for name in triangle if name.startswith("DistanceDomainSide")},
                         {f"DistanceDomainSide{i}" for i in (1, 2, 3)})
        high = self.preflight(HOUSE, *sizes, "--domain-polygon", "-90,-80 130,-70 20,95", "--domain-heights", -1, 70)
        self.assertEqual((high["DomainZMin"], high["DomainZMax"]), (-1, 70))
        for side, wanted in (("XMin", -170), ("XMax", 230), ("YMin", -195), ("YMax", 205), ("ZMin", 0), ("ZMax", 60)):
            self.assertAlmostEqual(cylinder["Domain" + side], wanted, places=6)

    def test_a_room_is_meshed_by_its_bounds_or_by_a_seed(self):
        model = self.folder / "room.wrl"
        model.write_text("#VRML V2.0 utf8\nDEF Room Shape { geometry Box { size 8 6 3 } }\n")
        sizes = ["--size-max", "1", "--size-mid", "0.5", "--size-min", "0.5", "--layers", "0"]
        out, report = self.folder / "room.vtu", self.folder / "room.json"
        for options in (["--model-bounds"], ["--seed", "0", "0", "0"]):
            run = self.atria("mesh", model, *sizes, *options, "-o", out, "--report", report)
            self.assertEqual((run.returncode, run.stderr), (0, ""))
            zones = [zone for zone in json.loads(report.read_text())["zones"] if zone["kept"]]
            self.assertEqual(len(zones), 1)
            self.assertAlmostEqual(zones[0]["volume"], 8 * 6 * 3, places=6)

    def test_domains_that_do_not_suit_the_model_are_told(self):
        out, report = self.folder / "domain.vtu", self.folder / "domain.json"
        beside = ["--domain", 200, 300, 200, 300, 0, 50]
        self.refuses(3, "holds nothing of the model: it reaches x from 200 to 300", "mesh", HOUSE, *COARSE[:6], *beside, "-o", out)
        self.refuses(3, "holds nothing of the model", "mesh", HOUSE, *COARSE[:6], *beside, "--estimate")
        self.refuses(3, "holds nothing of the model", "mesh", HOUSE, *COARSE[:6], *beside, "--preflight")
        self.assertFalse(out.exists())
        through = ["--domain", -90, 137, -84, 98, 0, 8]
        run = self.atria("mesh", HOUSE, *COARSE[:6], *through, "-o", out, "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertEqual(run.stderr.count("cuts through surfaces at zMax"), 1)
        self.assertIn("'RoofSouth'", run.stderr)
        self.assertEqual(len(json.loads(report.read_text())["diagnostics"]["InputWarning"]), 1)
        self.assertIn("cuts through surfaces at zMax", self.atria("mesh", HOUSE, *COARSE[:6], *through, "--estimate").stderr)
        self.assertIn("cuts through surfaces at zMax", self.preflight(HOUSE, *COARSE[:6], *through)["warnings"][0])
        ridge = ["--domain", -90, 137, -84, 98, 0, 11]
        self.assertIn("without air between: zMax", self.preflight(HOUSE, *COARSE[:6], *ridge)["warnings"][0])

    def test_seeds_may_be_repeated(self):
        out, report = self.folder / "seeds.vtu", self.folder / "seeds.json"
        run = self.atria("mesh", "--seed", "-20", "-20", "10", "--seed", "12", "7", "2", HOUSE, "-o", out, *COARSE,
                         "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertGreater(json.loads(report.read_text())["counts"]["elements"], 1000)

    def test_what_is_left_out_at_lateral_sides_is_warned_of(self):
        model, out, report = (self.folder / name for name in ("terrain.wrl", "terrain.vtu", "terrain.json"))
        model.write_text("""#VRML V2.0 utf8
DEF Terrain Shape { geometry IndexedFaceSet {
  coord Coordinate { point [ -30 -30 6, 30 -30 7, 30 30 9, -30 30 8 ] } coordIndex [ 0 1 2 3 -1 ] } }
""")
        run = self.atria("mesh", model, "-o", out, "--report", report, "--domain", -20, 20, -20, 20, 0, 30)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        kept, left_out = json.loads(report.read_text())["zones"]
        self.assertTrue(kept["kept"])
        self.assertFalse(left_out["kept"])
        self.assertEqual(left_out["surfaces"], ["Terrain"])
        seed = re.search("--seed (\\S+) (\\S+) ([^\\s;,]+)", run.stderr).groups()
        for said, inside in zip(seed, left_out["inside"]):
            self.assertAlmostEqual(float(said), inside, delta=0.01)
        run = self.atria("mesh", model, "-o", out, "--report", report, "--domain", -20, 20, -20, 20, 0, 30, "--layers", 0,
                         "--no-support", "--seed", *seed)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertNotIn("left out", run.stderr)
        self.assertEqual(json.loads(report.read_text())["counts"]["elements"], left_out["elements"])

    def test_rooms_that_nothing_opens_are_told_with_a_seed(self):
        model, out, report = (self.folder / name for name in ("rooms.wrl", "rooms.vtu", "rooms.json"))
        sheet = "DEF %s Shape { geometry IndexedFaceSet { coord Coordinate { point [ %s ] } coordIndex [ 0 1 2 3 ] } }\n"
        corners = [(x, y, z) for z in (0, 4) for y in (0, 6) for x in (0, 8)]
        sides = {"Floor": (0, 1, 3, 2), "Roof": (4, 5, 7, 6), "South": (0, 1, 5, 4), "North": (2, 3, 7, 6),
                 "West": (0, 2, 6, 4), "East": (1, 3, 7, 5)}
        def room(prefix, left_out=()):
            # A wall stands 2 cm apart: what is closed as drawn is taken for a solid.
            shift = {"West": -0.02}
            return "".join(sheet % (prefix + name, ", ".join(
                               "%g %d %d" % (corners[i][0] + shift.get(name, 0), *corners[i][1:]) for i in side))
                           for name, side in sides.items() if name not in left_out)
        model.write_text("#VRML V2.0 utf8\n" + room("") + "Transform { translation 0 20 0 children [ " + room("Open", ["East"]) +
                         "] }\nTransform { translation 20 0 2 children DEF Block Shape { geometry Box { size 6 6 4 } } }\n")
        options = [model, "-o", out, "--report", report, "--size-max", "4", "--size-mid", "1", "--size-min", "1",
                   "--domain", -20, 40, -20, 40, -4, 24]
        run = self.atria("mesh", *options)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        (warning,) = [line for line in run.stderr.splitlines() if "closed space" in line]
        (note,) = [line for line in run.stderr.splitlines() if "insides of solids" in line]
        self.assertIn("atria: warning: ", warning)
        self.assertIn("left out: 1 (", note)
        self.assertIn("the largest of Block", note)
        self.assertIn("atria: note: ", note)
        left_out = {zone["kind"]: zone for zone in json.loads(report.read_text())["zones"] if not zone["kept"]}
        self.assertEqual(set(left_out), {"room", "solid"})
        self.assertEqual(set(left_out["room"]["surfaces"]), set(sides))
        self.assertAlmostEqual(left_out["room"]["rough_volume"], 8 * 6 * 4, delta=0.3 * 8 * 6 * 4)
        self.assertIn("%d elements, about %.3g m3" % (left_out["room"]["elements"], left_out["room"]["rough_volume"]), warning)
        seed = warning.split("--seed ")[1].split()
        self.assertEqual([float(x) for x in seed], left_out["room"]["inside"])
        run = self.atria("mesh", *options, "--layers", 0, "--seed", *seed)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertNotIn("left out", run.stderr)
        (kept,) = [zone for zone in json.loads(report.read_text())["zones"] if zone["kept"]]
        self.assertEqual(kept["kind"], "room")
        self.assertNotIn("left out", self.atria("mesh", *options, "--zone", "all").stderr)

    def test_a_leak_is_a_warning_that_names_place_and_surfaces(self):
        out, report = self.folder / "leak.vtu", self.folder / "leak.json"
        run = self.atria("mesh", "--sealed-seed", "12", "7", "2", HOUSE, "-o", out, *FINE, "--report", report)
        self.assertIn(run.returncode, (0, 4), run.stderr)
        self.assertIn("atria: warning: ", run.stderr)
        self.assertIn("should be sealed", run.stderr)
        data = json.loads(report.read_text())
        (leak,) = data["leaks"]
        self.assertEqual(leak["seed"], [12, 7, 2])
        self.assertGreater(leak["width"], 0)
        self.assertTrue(leak["surfaces"])
        self.assertIn(leak["surfaces"][0], run.stderr)
        self.assertEqual(data["diagnostics"]["LeakPath"], 1)
        self.refuses(3, "sealed seed", "mesh", "--sealed-seed", "0", "0", "999", HOUSE, "-o", out, *COARSE)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
