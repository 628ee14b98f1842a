# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case with warm air: what is refused, how dictionaries differ by dialect, that OpenFOAM runs it and no heat is lost, what
the report says, and the study's formulas.

Usage: test_warm_air.py FOLDER_OF_THE_STUDY ATRIA
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1])
ATRIA = pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER))

import cavity  # noqa: E402
import make_room  # noqa: E402
import study  # noqa: E402
import numpy  # noqa: E402
from atria.report import Case, stack  # noqa: E402
from atria.report.results import History  # noqa: E402
from atria.report.warmth import Warmth  # noqa: E402
from box_mesh import write_box  # noqa: E402
from decomposed import MPI  # noqa: E402
from kept_rows import keep  # noqa: E402  (study knows where it is)
from test_dialects import dictionaries, differences  # noqa: E402

HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
BOUNDS = ((0.0, 5.0), (0.0, 4.0), (0.0, 3.0))
COUNTS = (10, 8, 6)  # cells of half a meter
OPENINGS = ("--patch", "Lower", "inletOutlet", "--patch", "Upper", "inletOutlet")
CALM = ("--kind", "room", *OPENINGS, "--calm", "--outdoor-temperature", "20")


def room_patch(side, place):
    """A low opening of a square meter on one side, a high one on the other, a floor, and walls."""
    across = place[1] in range(3, 5)
    if side == "xMin" and across and place[2] < 2:
        return "Lower"
    if side == "xMax" and across and place[2] >= 4:
        return "Upper"
    return "Floor" if side == "zMin" else "Walls"


def room_with_a_slanting_sheet():
    """A closed room of 4 m × 3 m × 3 m, but for an opening across its floor, as OBJ."""
    level = lambda x0, x1, z: [(x0, 0, z), (x1, 0, z), (x1, 3, z), (x0, 3, z)]
    along = lambda y: [(0, y, 0), (4, y, 0), (4, y, 3), (0, y, 3)]
    across = lambda x: [(x, 0, 0), (x, 3, 0), (x, 3, 3), (x, 0, 3)]
    surfaces = {"Floor": [level(0, 1.5, 0), level(2.5, 4, 0)], "Opening": [level(1.5, 2.5, 0)], "West": [across(0)], "East": [across(4)],
                "South": [along(0)], "North": [along(3)], "Top": [level(0, 4, 3)],
                "Sheet": [[(0.8, 0.7, 1.1), (2.9, 0.5, 2.3), (2.8, 2.4, 2.5), (0.9, 2.5, 1.2)]]}
    text, count = "", 0
    for name, polygons in surfaces.items():
        text += f"o {name}\n"
        for polygon in polygons:
            text += "".join("v {:g} {:g} {:g}\n".format(*point) for point in polygon)
            text += "f " + " ".join(str(count + i) for i in range(1, 5)) + "\n"
            count += 4
    return text


class WarmAir(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.room = self.folder / "room"
        write_box(self.room, COUNTS, BOUNDS, zone_at=4, patch_of=room_patch)
        self.wind = self.folder / "wind"
        write_box(self.wind, (10, 8, 8), ((0.0, 40.0), (-20.0, 20.0), (0.0, 40.0)), zone_at=5)

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def case(self, mesh, *arguments, name="case", stderr=""):
        folder = self.folder / name
        run = self.atria("case", mesh, "-o", folder, *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertEqual(run.stderr, "") if not stderr else self.assertRegex(run.stderr, stderr)
        self.said = run.stdout
        return folder

    def refuses(self, status, text, *arguments):
        run = self.atria("case", *arguments, "-o", self.folder / "refused")
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn(text, run.stderr)

    def described(self, folder):
        return json.loads((folder / "case.json").read_text())

    def run_case(self, folder):
        run = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False, env=os.environ | MPI)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def report(self, folder, status=0):
        run = self.atria("report", folder)
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stderr

    def test_bad_input_is_refused_by_name(self):
        heat = ("--heat", "hall", "100W")
        self.refuses(2, "300 kelvin are 26.85", self.room, *OPENINGS, "--outdoor-temperature", "300", *heat)
        self.refuses(2, "'-250'", self.room, *OPENINGS, "--outdoor-temperature", "-250", *heat)
        self.refuses(3, "'Floor': 300 is not from -90 to 200", self.room, *CALM, "--temperature", "Floor", "300")
        self.refuses(3, "did you mean 'hall'?", self.room, *CALM, "--heat", "hal", "100W")
        self.refuses(3, "'1kW' is no amount of heat", self.room, *CALM, "--heat", "hall", "1kW")
        self.refuses(3, "'Upper': air flows through it: give the temperature of the air that comes in by --temperature", self.room,
                     *CALM, "--heat", "Upper", "100W")
        self.refuses(3, "nothing warms or cools the air", self.room, *CALM, "--heat", "hall", "0W")
        self.refuses(3, "there is no warm air for --heat: set --outdoor-temperature, degrees", self.wind, *heat)
        self.refuses(3, "no warm air for --calm", self.wind, "--calm")
        self.refuses(3, "no warm air for --transient", self.wind, "--transient", "10")
        self.refuses(3, "--calm is without wind", self.wind, "--calm", "--wind", "90", "--outdoor-temperature", "20", *heat)
        self.refuses(3, "let warm air move by itself, --calm", self.room, "--kind", "room", *OPENINGS, "--outdoor-temperature", "20", *heat)
        for dialect in ("foundation-11", "foundation-14"):
            self.refuses(3, "opencfd-1912 or opencfd-2006", self.room, *CALM, *heat, "--dialect", dialect)

    def test_settings_may_stand_in_a_file(self):
        config = self.folder / "case.toml"
        given = (*CALM, "--heat", "hall", "100W", "--heat", "Floor", "5W/m2", "--temperature", "Lower", "18", "--transient", "30")
        self.assertEqual(self.atria("case", *given, "--write-config", config).returncode, 0)
        folder = self.case(self.room, "--config", config)
        warm = self.described(folder)["warm_air"]
        self.assertEqual((warm["outdoor_temperature"], warm["zones"], warm["incoming"], warm["duration"]),
                         (20.0, {"hall": 100.0}, {"Lower": 18.0}, 30.0))
        self.assertAlmostEqual(warm["surfaces"]["Floor"], 100.0)
        self.assertIn("Room of 60 m3, whose air heat moves through Lower, Upper", self.said)

    def test_calm_air_is_open_all_around(self):
        folder = self.case(self.wind, "--calm", "--outdoor-temperature", "20", "--heat", "hall", "1000W", "--speed", "3",
                           stderr="--speed has no use with --calm")
        described = self.described(folder)
        self.assertEqual(described["kind"], "calm")
        self.assertNotIn("towards", described["directions"][0])
        self.assertEqual(described["directions"][0]["patches"], {"zMin": "ground"} | dict.fromkeys(
            ("xMin", "xMax", "yMin", "yMax", "zMax"), "inletOutlet"))
        for file in (folder / "0").iterdir():
            self.assertNotIn("atmBoundaryLayer", file.read_text(), file.name)

    def test_wind_keeps_its_inlet(self):
        """Warm air with wind differs from wind by what is about heat, and by schemes and solvers."""
        wind = dictionaries(self.case(self.wind, name="wind_only"))
        warm = dictionaries(self.case(self.wind, "--outdoor-temperature", "15", "--heat", "zMin", "20W/m2", name="warm"))
        found = differences(wind, warm)
        self.assertEqual({key[0] for key in found}, {"0/T", "0/p", "constant/g", "constant/fvOptions", "system/controlDict",
                                                     "system/fvSchemes", "system/fvSolution"})
        self.assertEqual(warm["0/T"][("boundaryField", "xMin", "type")], "fixedValue")
        self.assertEqual(warm["0/T"][("boundaryField", "xMax", "type")], "inletOutlet")
        self.assertEqual(warm["0/T"][("boundaryField", "zMin", "type")], "exprMixed")
        self.assertEqual(warm["0/p"][("boundaryField", "zMin", "type")], "fixedFluxExtrapolatedPressure")
        self.assertFalse([key for key in found if key[0] == "0/p" and key[2] in ("xMin", "xMax", "yMin", "zMax")])

    def test_a_case_without_heat_in_the_same_folder_has_none(self):
        self.case(self.wind, "--outdoor-temperature", "15", "--heat", "hall", "200W")
        folder = self.case(self.wind)
        self.assertEqual(dictionaries(folder), dictionaries(self.case(self.wind, name="new")))

    def test_dialects_differ_by_the_ground_alone(self):
        given = ("--outdoor-temperature", "15", "--heat", "hall", "200W", "--temperature", "zMin", "25", "--age-of-air")
        for more in ((), ("--calm",), ("--transient", "60")):
            label = "".join(more[:1])
            old, new = (dictionaries(self.case(self.wind, *given, *more, "--dialect", dialect, name=dialect + label))
                        for dialect in ("opencfd-1912", "opencfd-2006"))
            self.assertEqual({key[0] for key in differences(old, new)} - {"0/U", "0/k", "0/epsilon"}, {"0/nut"}, more)

    @unittest.skipUnless(shutil.which("foamDictionary"), "OpenFOAM is not installed")
    def test_openfoam_reads_all_dictionaries(self):
        environment = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
        for more in ((), ("--transient", "60")):
            folder = self.case(self.room, *CALM, "--heat", "hall", "100W", "--heat", "Floor", "9W", "--temperature", "Walls", "21", *more)
            for file in dictionaries(folder):
                run = subprocess.run(["foamDictionary", folder / file], capture_output=True, text=True, check=False, env=environment)
                self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_all_heat_leaves_with_the_air(self):
        """Of a zone and of the floor; warm air leaves above, and as much comes in below."""
        folder = self.case(self.room, *CALM, "--heat", "hall", "200W", "--heat", "Floor", "100W", "--iterations", "400", "--age-of-air")
        self.run_case(folder)
        self.assertEqual(self.report(folder), "")
        run = Case(folder).runs[0]
        self.assertLess(abs(run.warmth.imbalance()), 0.005)
        self.assertLess(run.flows["Lower"].last(), -0.05)
        self.assertAlmostEqual(run.flows["Lower"].last(), -run.flows["Upper"].last(), delta=1e-3 * run.flows["Upper"].last())
        self.assertAlmostEqual(run.warmth.out["Upper"].last(), 300.0, delta=3.0)
        self.assertGreater(run.warmth.everywhere.last(), 20.0)
        self.assertGreater(run.warmth.walls["Floor"].last(), run.warmth.everywhere.last())
        page = (folder / "report.html").read_text()
        self.assertIn("<b>300</b> W come in", page)
        self.assertIn("mean temperature, °C", page)
        self.assertNotIn("the air has one temperature", page)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_surfaces_of_a_temperature_give_what_leaves(self):
        """Their heat is measured; here cold air that comes in takes it."""
        folder = self.case(self.room, *CALM, "--temperature", "Floor", "35", "--iterations", "500")
        self.run_case(folder)
        run = Case(folder).runs[0]
        self.assertGreater(run.warmth.surfaces["Floor"].last(), 20.0)
        self.assertLess(abs(run.warmth.imbalance()), 0.01)

    def test_flows_that_swing_did_not_converge(self):
        """Only with high residuals, too, and only in a steady run."""
        described = {"outdoor_temperature": 20, "duration": 0, "heat_capacity": 1210, "diffusivities": [2e-5, 1.2], "zones": {"hall": 100},
                     "surfaces": {}, "temperatures": {}}
        times = numpy.arange(1.0, 101.0)
        calm, swinging = History(times, numpy.ones(100)), History(times, 1.0 + 0.2 * numpy.sin(times))
        low, high = ({"Ux": History(times, numpy.full(100, value))} for value in (1e-3, 5e-2))
        warmth = Warmth(self.folder, described, {}, [], {})
        self.assertEqual(warmth.doubts(low, {"Door": swinging}), [])
        self.assertEqual(warmth.doubts(high, {"Door": calm}), [])
        said, = warmth.doubts(high, {"Window": calm, "Door": swinging})
        self.assertIn("residuals of the velocity stay at 0.05 and the flow through Door swings by ±20 %", said)
        self.assertIn("atria case --transient 600", said)
        self.assertEqual(Warmth(self.folder, described | {"duration": 60}, {}, [], {}).doubts(high, {"Door": swinging}), [])

    def test_temperatures_beyond_boussinesq_are_doubted(self):
        described = {"outdoor_temperature": 20, "duration": 0, "heat_capacity": 1210, "diffusivities": [2e-5, 1.2], "zones": {"hall": 100},
                     "surfaces": {"Roof": 50}, "temperatures": {}}
        places = {"hall": "meanT_hall/0/volFieldValue.dat", "cellar": "meanT_cellar/0/volFieldValue.dat",
                  "Roof": "temperature_Roof/0/surfaceFieldValue.dat"}
        for name, celsius, wanted in (("hall", 50.2, "hall with 50.2 °C"), ("cellar", -10.5, "cellar with -10.5 °C"), ("hall", 49.9, None),
                                      ("Roof", 61.0, "the surface Roof with 61 °C")):
            for place, file in places.items():
                path = self.folder / "postProcessing" / file
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text("".join(f"{i} {celsius if place == name else 25}\n" for i in range(1, 101)))
            found = Warmth(self.folder, described, {}, [], ["hall", "cellar"]).beyond_boussinesq()
            self.assertEqual(len(found), bool(wanted))
            self.assertTrue(not wanted or f"{wanted}, and 20 °C outdoors" in found[0], found)

    def test_warmth_alone_moves_what_the_formulas_say(self):
        """Two small openings, one tall one, openings with a screen, and colder air."""
        speed = (2 * 9.81 * 3.0 * 4.0 / 293.15) ** 0.5
        flow = stack.flow([stack.Portal(0.5, 0.999, 1.001), stack.Portal(0.2, 3.999, 4.001)], 4.0, 20.0)
        self.assertAlmostEqual(flow, 0.6 * (0.5**-2 + 0.2**-2) ** -0.5 * speed, places=4)
        level = [stack.Portal(0.5, 1.0, 1.0), stack.Portal(0.2, 4.0, 4.0)]
        self.assertAlmostEqual(stack.flow(level, 4.0, 20.0) / flow, 1.0, places=3)
        self.assertAlmostEqual(stack.flow(level, -4.0, 20.0), stack.flow(level, 4.0, 20.0))
        tall = stack.flow([stack.Portal(2.0, 5.0, 7.0)], 4.0, 20.0)
        self.assertAlmostEqual(tall, 0.6 * 2.0 / 3.0 * (9.81 * 2.0 * 4.0 / 293.15) ** 0.5, places=6)
        screened = stack.flow([stack.Portal(2.0, 5.0, 7.0, resistance=3.0)], 4.0, 20.0)
        self.assertAlmostEqual(screened / tall, (1.0 + 3.0 * 0.36) ** -0.5, places=6)
        self.assertEqual(stack.flow([stack.Portal(2.0, 5.0, 7.0)], 0.0, 20.0), 0.0)
        self.assertAlmostEqual(stack.rest(5.0, 3.0), 4.0)
        self.assertEqual(stack.rest(3.0, 5.0), 0.0)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_the_page_parts_warmth_and_wind(self):
        folder = self.case(self.wind, "--outdoor-temperature", "15", "--heat", "hall", "2000W", "--iterations", "40")
        self.run_case(folder)
        self.atria("report", folder)
        run = Case(folder).runs[0]
        row = re.search(r"<tr><td>hall</td><td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)</td><td>([^<]*)</td><td>",
                        (folder / "report.html").read_text().split("by wind, estimated")[-1])
        warmer, whole, warm, wind = map(float, row.groups())
        opening = run.case.openings[0]
        low, high = run.fields.face_zones[opening["name"]].GetBounds()[4:]
        self.assertEqual((low, high), (0.0, 40.0))
        self.assertAlmostEqual(warmer, run.warmth.rooms["hall"].last() - 15.0, delta=0.01 * warmer)
        formula = 0.6 * opening["area"] / 3.0 * (9.81 * high * warmer / 288.15) ** 0.5
        self.assertAlmostEqual(warm, formula, delta=0.02 * formula)
        self.assertAlmostEqual(wind, max(whole**2 - warm**2, 0.0) ** 0.5, delta=0.02 * whole)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_what_did_not_converge_is_told(self):
        folder = self.case(self.room, *CALM, "--heat", "hall", "200W", "--iterations", "10")
        self.run_case(folder)
        self.assertRegex(self.report(folder), r"room: the steady run has not converged: .* W leave, and 200 W come in\. Run more "
                                              r"iterations.* atria case --transient 600")
        self.assertIn("the steady run has not converged", (folder / "report.html").read_text())

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_transient_run_warms_the_room(self):
        folder = self.case(self.room, *CALM, "--heat", "hall", "1000W", "--transient", "20", "--age-of-air", "--scalar", "CO2", "hall",
                           "5e-6/s")
        self.run_case(folder)
        self.assertRegex(self.report(folder), "the air still warms up.*Compute a longer time, with a longer --transient")
        run = Case(folder).runs[0]
        self.assertEqual(run.warmth.everywhere.times[-1], 20.0)
        warmest = 20.0 + 1000.0 * 20.0 / (60.0 * self.described(folder)["warm_air"]["heat_capacity"])
        self.assertAlmostEqual(run.warmth.everywhere.values[-1], warmest, delta=0.2 * (warmest - 20.0))
        page = (folder / "report.html").read_text()
        for text in ("<p>20 s, ", "CO2 has not settled", "the age of air has not settled",
                     "Means of the age of air are those of the last time, 20 s"):
            self.assertIn(text, page)
        self.assertNotIn("more iterations", page)
        self.assertNotRegex(page, r"e[+-]\d\d %")
        self.means_of_the_last_fifth(folder)

    def means_of_the_last_fifth(self, folder):
        """Where a case measures means of what the air carries."""
        for name in ("CO2", "age"):
            file = folder / f"postProcessing/mean{name}_hall/0/volFieldValue.dat"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("".join(f"{i} {i}\n" for i in range(1, 102)))
            run = Case(folder).runs[0]
            self.assertEqual(run.mean_of("hall", name), 91.0)
            self.assertNotIn(name, run.of_last_time())

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_air_beside_a_slanting_sheet_stays_calm(self):
        """Least squares without a limit blow up here within some seconds."""
        model, mesh = self.folder / "room.obj", self.folder / "room.vtu"
        model.write_text(room_with_a_slanting_sheet())
        made = self.atria("mesh", model, "--model-bounds", "--size-min", 0.1, "--size-mid", 0.2, "--size-max", 0.4, "-o", mesh)
        self.assertIn(made.returncode, (0, 5), made.stderr)
        folder = self.case(mesh, "--kind", "room", "--patch", "Opening", "inletOutlet", "--calm", "--outdoor-temperature", "20",
                           "--temperature", "Top", "26", "--transient", "10", stderr=".*")
        self.run_case(folder)
        speed = Case(folder).runs[0].fields.mesh.GetCellData().GetArray("U")
        self.assertLess(speed.GetMaxNorm(), 0.05)  # m/s

    def test_the_study_has_rooms_with_openings(self):
        for has_plume in (False, True):
            row = study.Row("test", 100.0, has_plume)
            folder = self.folder / str(has_plume)
            folder.mkdir()
            make_room.main(folder / "room.obj", has_plume)
            study.mesh(ATRIA, row, folder, folder / "room.obj")
            subprocess.run(list(map(str, study.case_command(ATRIA, row, folder))), check=True, capture_output=True)
            openings = self.described(folder / "case")["openings"]
            area = make_room.opening_area
            wanted = [make_room.WIDE, make_room.WIDE, make_room.SMALL] if has_plume else [make_room.LOWER, make_room.UPPER]
            self.assertEqual(len(openings), len(wanted))
            self.assertAlmostEqual(sum(opening["area"] for opening in openings), sum(map(area, wanted)), places=3)

    def test_the_study_has_the_formulas(self):
        self.assertAlmostEqual(study.effective_area(), 0.4 / 2**0.5)
        self.assertAlmostEqual(study.stack_flow(2.316), 0.1195, places=4)
        share = study.interface_share()
        area = 2**0.5 * 0.6 * study.effective_area(True) / study.rise() ** 2
        self.assertAlmostEqual(study.plume_constant() ** 1.5 * (share**5 / (1 - share)) ** 0.5, area, places=9)
        self.assertAlmostEqual(study.interface_height([0.5, 1.5, 2.5], [20.0, 21.0, 24.0]), 1.5 + 1.0 / 3.0)

    def test_the_tables_compare(self):
        for row in (study.ROWS[0], study.ROWS[-1]):
            keep(row, self.folder, {"cells": 1000, "worst_non_orthogonality": 50.0, "mesh_seconds": 1.0, "solve_seconds": 2.0, "flow": 0.08,
                                    "warmer": 0.919, "heat_through_openings": 150.0, "imbalance": 0.001, "capacity": 1210.0,
                                    "unconverged": [], "below_ceiling": 21.0, "interface": 1.5})
        text = study.tables(self.folder)
        for table in text.split("\n\n")[1:]:
            self.assertEqual(len({line.count("|") for line in table.strip().splitlines()}), 1, table)
        self.assertRegex(text, r"\| stack150 \| 150 \| 1,000 \| 2 \| 0\.0800 \| 0\.919 \| 0\.0753 \| \+6\.3 % \| 150\.0 \| \+0\.10 % \|")
        self.assertIn("not run", text)

    def test_the_cavity_has_its_walls_and_table(self):
        row = cavity.ROWS[0]
        self.assertGreater(cavity.mesh(ATRIA.resolve(), row, self.folder), 0.0)
        run = subprocess.run([str(word) for word in cavity.case_command(ATRIA, row, self.folder)], capture_output=True, text=True, check=False)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        described = self.described(self.folder / "case")
        self.assertEqual(described["directions"][0]["patches"], {"Cold": "wall", "Hot": "wall", "Side": "slip", "Ceiling": "wall",
                                                                 "Floor": "wall", "Opening": "inletOutlet"})
        self.assertAlmostEqual(cavity.heat_of_correlation(), 37.8, delta=0.1)  # Nu of 5.8
        keep(row, self.folder, {"cells": 1000, "solve_seconds": 2.0, "hot": 30.0, "cold": -30.0, "fastest": 0.1, "speed": 0.02,
                                "temperature": 0.5})
        lines = cavity.tables(self.folder).strip().splitlines()[2:]
        self.assertEqual(len({line.count("|") for line in lines}), 1, lines)
        self.assertIn("not run", lines[3])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
