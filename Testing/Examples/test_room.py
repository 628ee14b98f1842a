# SPDX-License-Identifier: GPL-3.0-or-later
"""atria case of ventilated rooms: which meshes are rooms, what blows how, that OpenFOAM runs it, and what the page says.

Usage: test_room.py ATRIA
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

import numpy
from atria.report import Case
from atria.report.results import History
from atria.report.scalars import Age, Scalar
from box_mesh import header, write_box
from decomposed import MPI
from test_dialects import dictionaries, differences

ATRIA = pathlib.Path(sys.argv[1])
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
BOUNDS = ((0.0, 5.0), (0.0, 4.0), (0.0, 3.0))
COUNTS = (10, 8, 6)  # cells of half a meter


def openings(**places):
    """For `write_box`: patches {name: (side, range of i, j, k)}; all else are walls."""
    def patch_of(side, place):
        for name, (where, *ranges) in places.items():
            if side == where and all(index in inside for index, inside in zip(place, ranges)):
                return name
        return "Walls"
    return patch_of


ANY = range(1000)
# Inlets of 1 and 0.5 m² high on one side and in the ceiling, outlets of 1 and 0.25 m².
SEVERAL = {"Supply_1": ("xMin", ANY, range(2, 4), range(4, 6)), "Supply_2": ("zMax", range(4, 6), range(5, 6), ANY),
           "Exhaust_1": ("xMax", ANY, range(1, 3), range(0, 2)), "Return": ("yMax", range(8, 9), ANY, range(5, 6))}


def wall(name, points, faces):
    return f"o {name}\n" + "".join("v {} {} {}\n".format(*p) for p in points) + "".join(
        "f {}\n".format(" ".join(str(i - len(points)) for i in face)) for face in faces)


def box(name, low, high):
    """A closed box as a group of an OBJ file."""
    points = [tuple((low, high)[i >> axis & 1][axis] for axis in range(3)) for i in range(8)]
    return wall(name, points, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])


def rectangle(name, points):
    return wall(name, points, [(0, 1, 2, 3)])


def open_room(inlet, outlet):
    """A room of 5 m × 4 m × 3 m whose sides at x = 0 and x = 5 are patches of their own."""
    points = [(x, y, z) for z in (0, 3) for x, y in ((0, 0), (5, 0), (5, 4), (0, 4))]
    return (wall("Walls", points, [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6)]) +
            wall(outlet, points, [(0, 4, 7, 3)]) + wall(inlet, points, [(1, 2, 6, 5)]))


class Room(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def mesh(self, model, *arguments, name="model"):
        file = self.folder / f"{name}.obj"
        file.write_text(model)
        target = file.with_suffix(".vtu")
        run = self.atria("mesh", file, "--model-bounds", "-o", target, *arguments)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        return target

    def box(self, places, name="box"):
        write_box(self.folder / name, COUNTS, BOUNDS, patch_of=openings(**places))
        return self.folder / name

    def case(self, mesh, *arguments, stderr="", name="case"):
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

    def roles(self, folder):
        return self.described(folder)["directions"][0]["patches"]

    def condition(self, folder, field, patch):
        text = (folder / "0" / field).read_text()
        block = re.search(r"^    " + re.escape(patch) + r"\n    \{\n(.*?)^    \}", text, re.DOTALL | re.MULTILINE)
        return dict(re.findall(r"^\s*(\w+)\s+(.*);$", block[1], re.MULTILINE)) if block else None

    def run_case(self, folder):
        run = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False, env=os.environ | MPI)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def flow(self, folder, patch):
        """Out of the domain, m3/s."""
        return float((folder / f"postProcessing/flow_{patch}/0/surfaceFieldValue.dat").read_text().split()[-1])

    def report(self, folder, status=0):
        run = self.atria("report", folder)
        self.assertEqual(run.returncode, status, run.stderr)
        return run.stderr

    def test_rooms_are_known_by_names_and_walls(self):
        folder = self.case(self.box(SEVERAL))
        self.assertEqual(self.roles(folder), {"Walls": "wall", "Supply_1": "inlet", "Supply_2": "inlet", "Exhaust_1": "outlet",
                                              "Return": "outlet"})
        described = self.described(folder)
        self.assertEqual(described["kind"], "room")
        self.assertAlmostEqual(described["mesh"]["volume"], 60.0)
        self.assertNotIn("towards", described["directions"][0])
        self.assertRegex(self.said, r"Room of 60 m3, 90 air changes per hour: in through Supply_1 \(1 m/s, 1 m3/s\), "
                                    r"Supply_2 \(1 m/s, 0.5 m3/s\); out through Exhaust_1, Return\n")
        boundary = (folder / "constant/polyMesh/boundary").read_text()
        self.assertEqual(dict(re.findall(r"^(\w+) \{ type (\w+);", boundary, re.MULTILINE)),
                         {"Walls": "wall"} | dict.fromkeys(SEVERAL, "patch"))
        for file in (folder / "0").iterdir():
            self.assertNotRegex(file.read_text(), r"atm|Atm|z0|flowDir", file.name)
        self.assertNotIn("atmospheric", (folder / "system/controlDict").read_text())

    def test_a_side_that_is_no_wall_makes_wind(self):
        for side in ("xMin", "zMax"):
            patch_of = lambda s, place: s if s == side else "Inlet" if s == "xMax" else "Outlet" if s == "yMin" else "Walls"
            write_box(self.folder / side, COUNTS, BOUNDS, patch_of=patch_of)
            run = self.atria("case", self.folder / side, "-o", self.folder / f"{side}case")
            if run.returncode == 0:
                self.assertEqual(self.described(self.folder / f"{side}case")["kind"], "wind")
            else:  # the names say nothing in the wind
                self.assertIn("no patch lets air", run.stderr)
            folder = self.case(self.folder / side, "--kind", "room", name=f"{side}room")
            self.assertEqual(self.roles(folder)[side], "wall")

    def test_how_inlets_blow(self):
        mesh = self.box(SEVERAL)
        folder = self.case(mesh, "--inlet-speed", "0.3", "--patch", "Supply_2", "inlet:180m3/h")
        self.assertEqual(self.condition(folder, "U", "Supply_1"),
                         {"type": "surfaceNormalFixedValue", "refValue": "uniform -0.3", "value": "uniform (0 0 0)"})
        self.assertEqual(self.condition(folder, "U", "Supply_2"),
                         {"type": "flowRateInletVelocity", "volumetricFlowRate": "0.05", "value": "uniform (0 0 0)"})
        self.assertEqual(self.condition(folder, "U", "Exhaust_1")["type"], "inletOutlet")
        self.assertEqual(self.condition(folder, "p", "Exhaust_1"), {"type": "fixedValue", "value": "uniform 0"})
        self.assertEqual(self.condition(folder, "p", "Supply_1"), {"type": "zeroGradient"})
        k = self.condition(folder, "k", "Supply_1")
        self.assertEqual((k["type"], k["intensity"]), ("turbulentIntensityKineticEnergyInlet", "0.05"))
        self.assertAlmostEqual(float(k["value"].split()[1]), 1.5 * (0.05 * 0.3) ** 2)
        length = float(self.condition(folder, "epsilon", "Supply_1")["mixingLength"])
        self.assertAlmostEqual(length, 0.07)  # of a square of 1 m
        length = float(self.condition(folder, "epsilon", "Supply_2")["mixingLength"])
        self.assertAlmostEqual(length, 0.07 * 4 * 0.5 / 3)  # 1 m by 0.5 m
        folder = self.case(mesh, "--inlet-flow", "0.1", "--turbulence", "k-omega-sst", name="flow")
        self.assertEqual(self.condition(folder, "U", "Supply_1")["volumetricFlowRate"], "0.1")
        self.assertEqual(self.condition(folder, "omega", "Supply_1")["type"], "turbulentMixingLengthFrequencyInlet")
        self.assertEqual(self.described(folder)["directions"][0]["supplies"], {"Supply_1": 0.1, "Supply_2": 0.1})
        folder = self.case(mesh, "--condition", "Supply*", "U", "type fixedValue; value uniform (1 0 0);", name="condition")
        self.assertIn("Room of 60 m3: in through Supply_1, Supply_2;", self.said)

    def test_what_is_refused(self):
        mesh = self.box(SEVERAL)
        self.refuses(3, "out of the room: it has inlets only", mesh, "--patch", "Exhaust_1", "wall", "--patch", "Return", "wall")
        self.refuses(3, "into the room: it has outlets only", mesh, "--patch", "Supply*", "outlet")
        self.refuses(3, "both a speed and a flow rate", mesh, "--patch", "Supply_1", "inlet:1m/s", "--patch", "Supply_1", "inlet:1l/s")
        self.refuses(2, "--inlet-speed", mesh, "--inlet-speed", "1", "--inlet-flow", "1")
        self.refuses(2, "--inlet-flow", mesh, "--inlet-flow", "0")
        self.refuses(2, "room", mesh, "--kind", "rooms")
        self.refuses(3, "a room has no wind", mesh, "--kind", "room", "--wind", "90")
        self.refuses(3, "without wind it is a room", mesh, "--wind", "90")
        self.refuses(3, "inlet:50l/s", mesh, "--patch", "Supply_1", "inlet:0.5")
        self.refuses(3, "no ground", mesh, "--kind", "room", "--patch", "Walls", "ground")
        self.refuses(3, "--patch NAME inlet and --patch NAME outlet", mesh, "--kind", "room", "--patch", "*", "wall")

    def test_options_without_use_are_told(self):
        self.case(self.box(SEVERAL), "--speed", "2", stderr="--speed is for wind, and this is a room")
        write_box(self.folder / "wind", COUNTS, BOUNDS)
        self.case(self.folder / "wind", "--inlet-flow", "2", stderr="--inlet-flow is for rooms, and this is a case of wind",
                  name="wind_case")

    def test_inlets_that_the_wind_does_not_enter_are_told(self):
        """Whether it blows out of them, along them, or along the top; not those that blow by themselves."""
        write_box(self.folder / "wind", COUNTS, BOUNDS)
        for side in ("xMax", "yMin", "zMax"):
            self.case(self.folder / "wind", "--patch", side, "inlet", "--patch", "yMax", "outlet", name=side,
                      stderr=f"the wind does not enter at inlet '{side}':.* --patch {side} inlet:1m/s")
        self.case(self.folder / "wind", "--patch", "xMax", "inlet:1m/s", "--patch", "yMax", "outlet", name="blows")
        self.case(self.folder / "wind", "--patch", "yMin", "inlet", "--rose", "4", "--patch", "zMax", "outlet", name="rose",
                  stderr="at inlet 'yMin' in wind_000, wind_090, wind_270: ")

    def test_both_sides_of_a_sheet_blow(self):
        sides = {"Inlet_front": SEVERAL["Supply_1"], "Inlet_back": SEVERAL["Supply_2"], "Outlet": SEVERAL["Return"]}
        mesh = self.box(sides)
        self.case(mesh, "--inlet-flow", "0.5", stderr="sides of one sheet.* 1 m3/s in all.*--patch Inlet_back wall")
        self.case(mesh, "--patch", "Inlet_back", "wall", name="one")

    def test_dialects_differ_by_what_measures_alone(self):
        mesh = self.box(SEVERAL)
        arguments = ("--patch", "Supply_2", "inlet:1l/s", "--patch", "Return", "inletOutlet")
        first = dictionaries(self.case(mesh, *arguments))
        for dialect in ("opencfd-2006", "foundation-11", "foundation-14"):
            found = differences(first, dictionaries(self.case(mesh, *arguments, "--dialect", dialect, name=dialect)))
            self.assertFalse([key for key in found if key[0].startswith("0/")], found)
            self.assertEqual(bool(found), dialect.startswith("foundation"))

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_an_inlet_against_the_wind_blows_into_the_room(self):
        """Along its own normal, where the wind of a case of wind would leave."""
        mesh = self.mesh(open_room("East", "West"), "--size-min", "0.5")
        folder = self.case(mesh, "--patch", "East", "inlet", "--patch", "West", "outlet", "--iterations", "60")
        self.run_case(folder)
        self.assertAlmostEqual(self.flow(folder, "East"), -12.0, delta=1e-6)
        self.assertAlmostEqual(self.flow(folder, "West"), 12.0, delta=1e-3)
        fields = Case(folder).runs[0].fields
        velocity = fields.mesh.GetCellData().GetArray("U")
        self.assertLess(max(velocity.GetTuple3(i)[0] for i in range(velocity.GetNumberOfTuples())), 0.1)
        self.assertEqual(self.report(folder), "")
        page = (folder / "report.html").read_text()
        self.assertIn("<b>720</b> air changes per hour", page)
        self.assertIn("Speed 1.5 m above the floor", page)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_where_nothing_flows_the_report_fails(self):
        """As a case of wind the same room has still air; so has a room whose inlet a condition closes."""
        mesh = self.mesh(open_room("East", "West"), "--size-min", "0.5")
        roles = ("--patch", "East", "inlet", "--patch", "West", "outlet", "--iterations", "5")
        folder = self.case(mesh, "--kind", "wind", *roles, stderr="the wind does not enter at inlet 'East'")
        self.run_case(folder)
        said = self.report(folder, 6)
        self.assertIn("nothing flows: the air is at rest everywhere. The wind enters at none of the inlets (East)", said)
        self.assertNotIn("ERROR", said)
        folder = self.case(mesh, *roles, "--condition", "East", "U", "type noSlip;", name="closed")
        self.run_case(folder)
        self.assertIn("room: nothing flows: the air is at rest everywhere", self.report(folder, 6))
        shutil.rmtree(folder / "5")
        self.assertIn("no fields of a run", self.report(folder, 3))

    def test_places_of_scalars_are_checked(self):
        room = self.box(SEVERAL)
        self.refuses(3, "did you mean 'Supply_1'?", room, "--scalar", "CO2", "Suply_1", "4e-4")
        self.refuses(3, "air flows through 'Return'", room, "--scalar", "CO2", "Return", "1/s")
        self.refuses(3, "add up to nothing", room, "--scalar", "CO2", "Walls", "0/s")
        config = self.folder / "case.toml"
        self.assertEqual(self.atria("case", "--scalar", "CO2", "Supply*", "4e-4", "--write-config", config).returncode, 0)
        folder = self.case(room, "--config", config)
        self.assertEqual(self.described(folder)["scalars"], [{"name": "CO2", "sources": {}, "incoming": {"Supply_1": 4e-4,
                                                                                                       "Supply_2": 4e-4}}])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_what_comes_into_the_air_leaves_with_it(self):
        """Sources in a zone and on walls, and what comes in: the concentration at the outlets is the sum over the flow."""
        room = self.folder / "zoned"
        write_box(room, COUNTS, BOUNDS, zone_at=4, patch_of=openings(**SEVERAL))
        folder = self.case(room, "--inlet-speed", "0.5", "--iterations", "250", "--scalar", "CO2", "hall", "5e-6/s", "--scalar", "CO2",
                           "Supply*", "4e-4", "--scalar", "dust", "Walls", "2e-3/s", "--scalar", "dust", "hall", "1e-3/s")
        self.run_case(folder)
        self.report(folder)
        run = Case(folder).runs[0]
        flow = 0.5 * 1.5
        self.assertAlmostEqual(run.mixed_concentration("CO2", True) / (4e-4 + 5e-6 / flow), 1.0, delta=0.001)
        self.assertAlmostEqual(run.mixed_concentration("dust", True) / (3e-3 / flow), 1.0, delta=0.01)
        self.assertEqual(run.mixed_concentration("dust", False), 0.0)
        self.assertGreater(run.effectiveness("CO2", run.fields.mean_everywhere("CO2")), 0.5)
        self.assertIn("effectiveness for dust", (folder / "report.html").read_text())

    def scalar(self, leaving, incoming=(), mean=None, sources=5e-6):
        """Made results of a room: 0.01 m3/s with the given concentration come in, and `leaving` goes out, units/s."""
        time = numpy.arange(1.0, 101.0)
        columns = {"flow_CO2_Inlet/0/surfaceFieldValue.dat": numpy.full(100, -0.01 * dict(incoming).get("Inlet", 0.0)),
                   "flow_CO2_Outlet/0/surfaceFieldValue.dat": leaving * numpy.ones(100)}
        if mean is not None:
            columns["meanCO2_hall/0/volFieldValue.dat"] = mean * numpy.ones(100)
        for name, values in columns.items():
            file = self.folder / "postProcessing" / name
            file.parent.mkdir(parents=True, exist_ok=True)
            numpy.savetxt(file, numpy.transpose([time, values]))
        flows = {name: History(time, numpy.full(100, flow)) for name, flow in (("Inlet", -0.01), ("Outlet", 0.01))}
        described = {"name": "CO2", "sources": {"hall": sources}, "incoming": dict(incoming)}
        return Scalar(self.folder, described, flows, {"Inlet": "inlet", "Outlet": "outlet"}, ["hall"])

    def test_scalars_that_have_not_settled_are_doubted(self):
        """By what leaves and its change, by means that change, and by a room with less than comes in."""
        grows = 1.0 - numpy.exp(-numpy.arange(1.0, 101.0) / 40.0)
        fresh = {"Inlet": 4e-4}
        self.assertEqual(self.scalar(5e-6).reasons({"hall": 6e-4}), [])
        self.assertEqual(self.scalar(9e-6, fresh, mean=9e-4).reasons({"hall": 9e-4}), [])
        found = "\n".join(self.scalar(5e-6 * grows, mean=5e-4 * grows).reasons({"hall": 4e-4}))
        for text in ("what leaves changes by 6.", "% of what sources give",
                     "4.474e-06 units/s leave beyond what comes in, and sources give 5e-06",
                     "the mean in hall, 0.0004474 units/m³, changes by 7"):
            self.assertIn(text, found)
        self.assertEqual(self.scalar(9e-6, fresh, mean=9e-4).reasons({"hall": 3e-4, "other": 5e-4}),
                         ["the mean in hall, 0.0003 units/m³, is below the 0.0004 of the air that comes in"])
        self.assertEqual(self.scalar(3e-6, fresh, mean=9e-4, sources=-1e-6).reasons({"hall": 3e-4}), [])

    def test_an_age_that_has_not_settled_is_doubted(self):
        time = numpy.arange(1.0, 101.0)
        falling, level, low = (History(time, values) for values in (10.0 ** (-time / 40.0), numpy.full(100, 3e-3), numpy.full(100, 9e-5)))
        reasons = lambda residual, *of: Age(self.folder, ["hall"], residual).reasons({"hall": 50.0}, *of)
        self.assertEqual([reasons(residual, None, 0.0) for residual in (level, low, None)], [[], [], []])
        self.assertRegex(reasons(falling, None, 0.0)[0], r"residual still falls, 0\.0058 in the last fifth and 0\.018 in")
        self.assertEqual(reasons(falling, 0.97, 0.0), [])
        self.assertEqual(reasons(level, 0.9, 0.0), ["the air that leaves has 90 % of the age that it must have"])
        (self.folder / "0").mkdir()
        for start, wanted in (("uniform 0;", 1), ("nonuniform List<scalar> 1(3);", 0)):
            (self.folder / "0/age").write_text(f"internalField   {start}\n")
            self.assertEqual(len(reasons(falling, None, 100.0)), wanted)
            self.assertEqual(reasons(falling, None, 500.0), [])
        file = self.folder / "postProcessing/meanage_hall/0/volFieldValue.dat"
        file.parent.mkdir(parents=True)
        numpy.savetxt(file, numpy.transpose([time, time]))
        self.assertEqual(reasons(low, 1.0, 0.0), ["the mean in hall, 90.5 s, changes by 22 %"])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_what_the_air_carries_after_a_few_iterations_is_doubted(self):
        room = self.folder / "zoned"
        write_box(room, COUNTS, BOUNDS, zone_at=4, patch_of=openings(**SEVERAL))
        folder = self.case(room, "--inlet-speed", "0.5", "--iterations", "15", "--age-of-air", "--scalar", "CO2", "hall", "5e-6/s")
        self.run_case(folder)
        said = self.report(folder)
        page = (folder / "report.html").read_text()
        doubts = page[page.index("What to doubt"):]
        for text in ("CO2 has not settled: ", "the age of air has not settled: the air that leaves has "):
            self.assertIn(f"atria: warning: room: {text}", said)
            self.assertIn(text, doubts)
        self.assertIn("Run more iterations, and do not use its values before", said)
        self.assertIn("Means of the age of air are those of the last iteration, 15; the case does not measure them before.", page)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_an_inlet_blows_into_its_room(self):
        """The hall gets all its air through a patch, and gives it to the space beside it through its opening."""
        room = self.folder / "zoned"
        write_box(room, COUNTS, BOUNDS, zone_at=4)
        folder = self.case(room, "--kind", "room", "--patch", "xMin", "inlet:0.5m/s", "--patch", "xMax", "outlet", "--iterations", "60",
                           "--scalar", "CO2", "xMin", "4e-4")
        self.run_case(folder)
        self.report(folder)
        case = Case(folder)
        run, volume = case.runs[0], case.volumes["hall"]
        self.assertAlmostEqual(run.inflow("hall"), 6.0, delta=1e-6)
        self.assertAlmostEqual(run.fresh("hall"), 6.0, delta=0.1)
        self.assertAlmostEqual(run.air_changes("hall").last(), 6.0 * 3600.0 / volume, delta=1e-3)
        self.assertAlmostEqual(run.all_air_changes().last(), 6.0 * 3600.0 / volume, delta=1e-3)
        self.assertEqual(list(run.unbalanced()), [])
        self.assertEqual(list(run.passages["hall"]), ["xMin"])
        self.assertIsNone(run.effectiveness("CO2", 4e-4))

    def test_an_effectiveness_of_nothing_is_none(self):
        folder = self.case(self.box(SEVERAL), "--scalar", "CO2", "Walls", "5e-6/s")
        run = Case(folder).runs[0]
        run.mixed_concentration = lambda scalar, outwards: 5e-4 if outwards else 0.0
        self.assertAlmostEqual(run.effectiveness("CO2", 2.5e-4), 2.0)
        for concentration in (2.8e-19, 0.0, -1e-4):
            self.assertIsNone(run.effectiveness("CO2", concentration))

    def hedge(self, columns=range(30, 50)):
        """A duct of 40 m with a hedge across, 15 m to 25 m from its inlet, or in the given columns of half a meter."""
        duct, across = self.folder / "duct", 80
        write_box(duct, (across, 2, 2), ((0.0, 40.0), (0.0, 2.0), (0.0, 2.0)))
        cells = [i + across * row for row in range(4) for i in columns]
        (duct / "constant/polyMesh/cellZones").write_text(header("cellZones", "regIOobject") + (
            f"1\n(\nHedge {{ type cellZone; cellLabels List<label> {len(cells)}({' '.join(map(str, cells))}); }}\n)\n"))
        return duct, ("--kind", "room", "--patch", "xMin", "inlet:5m/s", "--patch", "xMax", "outlet", "--patch", "y*", "slip",
                      "--patch", "z*", "slip")

    def test_trees_become_zones(self):
        duct, roles = self.hedge()
        table = self.folder / "trees.csv"
        table.write_text("x,y,height,crown radius,LAD,Cd\n20,1,1.8,1,1,0.2\n30,1,1.8,1,2,0.2\n35,1,0.1,0.1,1,0.2\n")
        for _ in range(2):  # again into the same folder
            folder = self.case(duct, *roles, "--trees", table, stderr="1 of 3 trees are smaller than the cells")
            self.assertRegex(self.said, r"2 of 3 trees in \d+ cells, [\d.]+ m3: cell zones trees_1, trees_2")
            described = self.described(folder)
            self.assertEqual(described["tree_zones"], ["trees_1", "trees_2"])
            self.assertEqual([room["name"] for room in described["rooms"]], ["Hedge"])
            self.assertEqual([canopy["leaf_area_density"] for canopy in described["canopies"]], [1.0, 2.0])
        self.assertTrue((folder / "constant/fvOptions").exists())
        folder = self.case(duct, *roles)  # without them
        self.assertFalse((folder / "constant/fvOptions").exists())
        self.assertNotIn("trees_1", (folder / "constant/polyMesh/cellZones").read_text(errors="replace"))
        self.refuses(3, "did you mean 'Hedge'?", duct, *roles, "--canopy", "Hegde", "1", "0.2")
        table.write_text("20 1 1.8 1 1 0.2\n20 1 -1 1 1 0.2\n")
        self.refuses(3, "line 2", duct, *roles, "--trees", table)
        self.refuses(3, "at most 2", duct, *roles, "--canopy", "Hedge", "0.2", "20")

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_leaves_take_momentum(self):
        """The pressure falls by Cd LAD U^2 a meter."""
        duct, roles = self.hedge()
        folder = self.case(duct, *roles, "--canopy", "Hedge", "1.5", "0.2", "--iterations", "200", stderr="canopies slow the air")
        self.run_case(folder)
        pressure = Case(folder).runs[0].fields.mesh.GetCellData().GetArray("p").GetValue
        self.assertAlmostEqual((pressure(35) - pressure(45)) / 5.0, 0.2 * 1.5 * 25.0, delta=0.05)
        self.assertAlmostEqual((pressure(5) - pressure(75)) / 10.0, 0.2 * 1.5 * 25.0, delta=0.2)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_few_cells_of_leaves_take_as_much(self):
        """A limited gradient of the pressure would make it up to two fifths more."""
        for count in (1, 2):
            duct, roles = self.hedge(range(30, 30 + count))
            folder = self.case(duct, *roles, "--canopy", "Hedge", "1.5", "0.2", "--iterations", "200", stderr="canopies slow the air")
            self.run_case(folder)
            pressure = Case(folder).runs[0].fields.mesh.GetCellData().GetArray("p").GetValue
            self.assertAlmostEqual((pressure(5) - pressure(75)) / (0.5 * count * 0.2 * 1.5 * 25.0), 1.0, delta=0.1)
            shutil.rmtree(folder)
            shutil.rmtree(duct)

    def test_of_crowns_that_overlap_the_denser_holds(self):
        duct, roles = self.hedge()
        table = self.folder / "trees.csv"
        for rows in (("20,1,1.8,1,1,0.2", "20,1,1.8,1,9,0.2"), ("20,1,1.8,1,9,0.2", "20,1,1.8,1,1,0.2")):
            table.write_text("\n".join(rows))
            canopies = self.described(self.case(duct, *roles, "--trees", table, stderr="canopies slow the air"))["canopies"]
            self.assertEqual([canopy["leaf_area_density"] for canopy in canopies], [9.0])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_run_that_failed_is_run_again(self):
        duct, roles = self.hedge()
        folder = self.case(duct, *roles, "--iterations", "2")
        solution = folder / "system/fvSolution"
        text = solution.read_text()
        solution.write_text("nonsense")
        failed = subprocess.run(["sh", "Allrun"], cwd=folder, capture_output=True, text=True, check=False, env=os.environ | MPI)
        self.assertEqual((failed.returncode, "simpleFoam failed" in failed.stderr), (1, True), failed.stderr)
        solution.write_text(text)
        self.run_case(folder)
        again = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False, env=os.environ | MPI)
        self.assertIn("simpleFoam has run", again.stdout)
        subprocess.run(["sh", "Allclean"], cwd=folder, check=True)
        self.assertEqual(list(folder.glob("log.*")), [])

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_leaves_make_turbulence(self):
        """Within the hedge k goes to U^2 / 5.1, where leaves make as much as they destroy, and falls behind it."""
        duct, roles = self.hedge()
        folder = self.case(duct, *roles, "--canopy", "Hedge", "1.5", "0.2", "--turbulence", "k-epsilon", "--iterations", "300")
        self.assertEqual(self.described(folder)["canopies"][0]["sources"], "momentum, k, epsilon")
        self.run_case(folder)
        value = lambda name, i: Case(folder).runs[0].fields.mesh.GetCellData().GetArray(name).GetValue(i)
        self.assertAlmostEqual((value("p", 35) - value("p", 45)) / 5.0, 0.2 * 1.5 * 25.0, delta=0.05)
        self.assertLess(value("k", 10), 0.1 * value("k", 46))
        self.assertAlmostEqual(value("k", 46) / (25.0 / 5.1), 1.0, delta=0.03)
        self.assertLess(value("k", 75), value("k", 50))
        subprocess.run([folder / "Allclean"], check=True)
        self.case(duct, *roles)  # again without
        self.assertFalse((folder / "constant/triSurface/canopy_Hedge.obj").exists())

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_several_inlets_and_outlets(self):
        """Each inlet blows what it was given, all goes out, and air is as old at the outlets as the room's air lasts."""
        for model in ("realizable", "k-omega-sst"):
            folder = self.case(self.box(SEVERAL, name=f"box_{model}"), "--inlet-speed", "0.4", "--patch", "Supply_2", "inlet:100l/s",
                               "--age-of-air", "--iterations", "400", "--turbulence", model, name=model)
            self.run_case(folder)
            self.assertAlmostEqual(self.flow(folder, "Supply_1"), -0.4, delta=1e-6)
            self.assertAlmostEqual(self.flow(folder, "Supply_2"), -0.1, delta=1e-6)
            out = {name: self.flow(folder, name) for name in ("Exhaust_1", "Return")}
            self.assertAlmostEqual(sum(out.values()), 0.5, delta=1e-3)
            self.assertGreater(min(out.values()), 0.01)
            run = Case(folder).runs[0]
            self.assertAlmostEqual(run.supplied_changes().last(), 30.0, delta=0.05)
            age = sum(out[name] * self.mean_age(run.fields.patches[name]) for name in out) / 0.5
            self.assertAlmostEqual(age, 120.0, delta=12.0, msg=model)
            self.report(folder)

    def mean_age(self, patch):
        array = patch.GetCellData().GetArray("age")
        return sum(array.GetValue(i) for i in range(array.GetNumberOfTuples())) / array.GetNumberOfTuples()

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_rooms_run_on_processors(self):
        folder = self.case(self.box(SEVERAL), "--inlet-flow", "0.2", "--processors", "2", "--iterations", "20")
        self.run_case(folder)
        for name in ("Supply_1", "Supply_2"):
            self.assertAlmostEqual(self.flow(folder, name), -0.2, delta=1e-6)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_diffuser_and_a_sheet_in_the_middle(self):
        """A closed box blows from all its faces, a sheet from both sides."""
        model = (open_room("Outlet_E", "Outlet_W") + box("Diffuser", (2.0, 1.5, 2.0), (3.0, 2.5, 2.5)) +
                 rectangle("SupplyPanel", [(1.5, 1, 0.5), (3.5, 1, 0.5), (3.5, 3, 0.5), (1.5, 3, 0.5)]))
        mesh = self.mesh(model, "--size-min", "0.25", "--size-max", "0.5")
        folder = self.case(mesh, "--patch", "SupplyPanel_back", "inlet:200l/s", "--inlet-flow", "0.3", "--iterations", "40",
                           stderr="'SupplyPanel_front' and 'SupplyPanel_back' are the sides of one sheet")
        self.assertEqual({name: role for name, role in self.roles(folder).items() if role != "wall"},
                         {"Diffuser": "inlet", "SupplyPanel_front": "inlet", "SupplyPanel_back": "inlet", "Outlet_E": "outlet",
                          "Outlet_W": "outlet"})
        self.run_case(folder)
        for name, wanted in (("Diffuser", 0.3), ("SupplyPanel_front", 0.3), ("SupplyPanel_back", 0.2)):
            self.assertAlmostEqual(self.flow(folder, name), -wanted, delta=1e-6)
        self.assertAlmostEqual(self.flow(folder, "Outlet_E") + self.flow(folder, "Outlet_W"), 0.8, delta=0.01)
        fields = Case(folder).runs[0].fields
        for name in ("Diffuser", "SupplyPanel_front"):  # blown along the faces' own normals
            velocity = fields.patches[name].GetCellData().GetArray("U")
            speeds = [sum(x * x for x in velocity.GetTuple3(i)) ** 0.5 for i in range(velocity.GetNumberOfTuples())]
            self.assertAlmostEqual(min(speeds), max(speeds), delta=1e-6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
