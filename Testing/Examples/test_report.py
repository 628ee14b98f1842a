# SPDX-License-Identifier: GPL-3.0-or-later
"""atria report: what it reads of a run, what follows from it, and the page.

Usage: test_report.py ATRIA SCRIPT_OF_A_BUILDING
"""

import base64
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import warnings
from html.parser import HTMLParser

import numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from atria import Error
from atria.report import Case, charts, comfort, page_of, read_climate, results, yearly
from atria.report.writing import percent
from atria.report.__main__ import noted
from atria.report.pictures import ends_within, levels
from box_mesh import BOX, header, write_box

ATRIA = pathlib.Path(sys.argv[1])
BUILDING = pathlib.Path(sys.argv[2])
HAVE_OPENFOAM = shutil.which("simpleFoam") is not None
CANNOT_DRAW = not os.environ.get("DISPLAY") and not shutil.which("xvfb-run")


class Page(HTMLParser):
    """Tables as rows of texts, headings, addresses, and whether all elements are closed."""

    EMPTY = {"meta", "img", "image", "path", "polyline", "br"}

    def __init__(self, text):
        super().__init__()
        self.open, self.tables, self.headings, self.addresses, self.items = [], [], [], [], []
        self.feed(text)
        self.close()
        assert not self.open, self.open

    def handle_starttag(self, tag, attributes):
        self.addresses += [value for key, value in attributes if key in ("src", "href")]
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")
        elif tag == "h2":
            self.headings.append("")
        elif tag == "li":
            self.items.append("")
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.EMPTY:
            assert self.open.pop() == tag, tag

    def handle_data(self, data):
        if "td" in self.open or "th" in self.open:
            self.tables[-1][-1][-1] += data
        elif "li" in self.open:
            self.items[-1] += data
        elif "h2" in self.open:
            self.headings[-1] += data

    def table(self, first):
        """The table whose head begins so, as rows by their first cell."""
        return next({row[0]: row for row in table} for table in self.tables if table[0][0] == first)


def png_size(address):
    data = base64.b64decode(address.removeprefix("data:image/png;base64,"))
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


class Folder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def file(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path


class Comfort(Folder):
    def test_a_weibull_distribution_is_exceeded_as_its_formula_says(self):
        climate = [comfort.Sector(0.0, 0.25, 4.0, 2.0), comfort.Sector(180.0, 0.75, 6.0, 1.5)]
        percent = comfort.exceedance(climate, [0.0, 180.0], [[0.5, 1.0, 0.0], [1.0, 2.0, 0.0]], 5.0)
        for place, (north, south) in enumerate(((0.5, 1.0), (1.0, 2.0))):
            wanted = 0.25 * math.exp(-((5 / (4 * north)) ** 2)) + 0.75 * math.exp(-((5 / (6 * south)) ** 1.5))
            self.assertAlmostEqual(percent[place], 100 * wanted, places=10)
        self.assertEqual(percent[2], 0.0)

    def test_sectors_take_the_next_direction_also_across_north(self):
        climate = [comfort.Sector(350.0, 1.0, 5.0, 2.0)]
        near, far = comfort.exceedance(climate, [10.0, 180.0], [[1.0], [0.0]], 5.0), math.exp(-1.0)
        self.assertAlmostEqual(near[0], 100 * far, places=10)
        self.assertEqual(comfort.widest_gap(climate, [10.0, 180.0]), 20.0)
        self.assertEqual(comfort.widest_gap([*climate, comfort.Sector(90.0, 0.0, 5.0, 2.0)], [10.0, 180.0]), 20.0)

    def of_percent(self, percent, speed):
        """The amplification with which `speed` is exceeded in so many percent of hours, for scale 5 and shape 2."""
        return speed / 5.0 / math.sqrt(-math.log(percent / 100.0))

    def test_classes_change_at_the_limits(self):
        climate = [comfort.Sector(0.0, 1.0, 5.0, 2.0)]
        for limits, speed, classify in ((comfort.NEN_8100_LIMITS, 5.0, comfort.nen_8100),
                                        (comfort.DANGER_LIMITS, 15.0, comfort.danger)):
            for number, limit in enumerate(limits):
                below, above = self.of_percent(0.999 * limit, speed), self.of_percent(1.001 * limit, speed)
                self.assertEqual(list(classify(climate, [0.0], [[below, above, math.nan]])), [number, number + 1, -1])
        for number, speed in enumerate(comfort.LAWSON_SPEEDS):
            below, above = self.of_percent(4.99, speed), self.of_percent(5.01, speed)
            self.assertEqual(list(comfort.lawson(climate, [0.0], [[below, above, math.nan]])), [number, number + 1, -1])

    def test_air_changes_follow_the_wind_of_each_hour(self):
        one = [comfort.Sector(10.0, 1.0, 4.0, 2.0)]
        self.assertAlmostEqual(yearly.mean(one, {0.0: 8.0, 180.0: 99.0}, 4.0), 8.0 * math.gamma(1.5))
        self.assertAlmostEqual(yearly.exceeded(one, {0.0: 8.0}, 4.0, 0.5), 8.0 * math.sqrt(math.log(2.0)))
        two = [comfort.Sector(0.0, 0.25, 4.0, 1.0), comfort.Sector(180.0, 0.75, 2.0, 1.0)]
        self.assertAlmostEqual(yearly.mean(two, {0.0: 8.0, 180.0: 2.0}, 4.0), 0.25 * 8.0 + 0.75 * 1.0)
        # No air comes in by the first: three quarters of the hours have some.
        self.assertAlmostEqual(yearly.exceeded(two, {0.0: 0.0, 180.0: 2.0}, 4.0, 0.25), math.log(3.0))
        self.assertEqual(round(yearly.exceeded(two, {0.0: 0.0, 180.0: 2.0}, 4.0, 0.9), 9), 0.0)

    def test_shares_leave_out_what_is_not_known(self):
        self.assertEqual(comfort.shares([0, 0, 1, -1, 3], 4), [0.5, 0.25, 0.0, 0.25])

    def test_a_climate_is_read_from_both_formats_in_shares_or_percent(self):
        table = self.file("climate.csv", "from, frequency, scale, shape\n0, 40, 4, 2\n-90, 60, 5, 1.8\n")
        listed = self.file("climate.json", json.dumps([{"from": 0, "frequency": 0.4, "scale": 4, "shape": 2},
                                                       {"from": 270, "frequency": 0.6, "scale": 5, "shape": 1.8}]))
        self.assertEqual(read_climate(table), read_climate(listed))
        self.assertEqual(read_climate(table)[1], comfort.Sector(270.0, 0.6, 5.0, 1.8))

    def test_what_is_no_climate_is_refused_with_its_place(self):
        head = "from,frequency,scale,shape\n"
        for row, wanted in (("", "no sectors"), ("0,1,4\n", "sector 1: 'shape'"), ("0,0.5,4,2\n", "sum up to 0.5"),
                            ("0,1,0,2\n", "scale and shape"), ("0,x,4,2\n", "'frequency'"), ("nan,1,4,2\n", "sector 1")):
            with self.assertRaisesRegex(Error, wanted):
                read_climate(self.file("climate.csv", head + row))
        for row in ("0,0.5,4,2\n90,0.3,4,2\n-270.02,0.2,5,2\n", "0,0.8,4,2\n90,0.2,4,2\n90,0,5,2\n"):
            with self.assertRaisesRegex(Error, "climate.csv, sector 3: sector 2 has the direction 90, too; give each direction once"):
                read_climate(self.file("climate.csv", head + row))
        with self.assertRaisesRegex(Error, "sector 2: sector 1 has the direction 0, too"):
            read_climate(self.file("climate.csv", head + "359.98,0.5,4,2\n0,0.5,4,2\n"))
        for weather in (b"LOCATION,Z\xfcrich,-,CHE\nDESIGN CONDITIONS,0\n", b"\xef\xbb\xbfLOCATION,City,-,LND\r\n",
                        b'700000,"CITY",ST\nDate (MM/DD/YYYY),Time (HH:MM)\n'):
            (self.folder / "year.epw").write_bytes(weather)
            with self.assertRaisesRegex(Error, "year.epw is a weather file and no table of the wind: make the table of it first, by `atria climate`"):
                read_climate(self.folder / "year.epw")
        with self.assertRaisesRegex(Error, "climate.json"):
            read_climate(self.file("climate.json", "{"))
        with self.assertRaisesRegex(Error, "absent.csv"):
            read_climate(self.folder / "absent.csv")

    def test_a_station_over_the_same_ground_changes_nothing(self):
        climate = [comfort.Sector(0.0, 1.0, 5.0, 2.0)]
        case = {"reference_height": 10.0, "roughness_length": 0.03}
        self.assertAlmostEqual(comfort.at_reference(climate, 10.0, 0.03, case)[0].scale, 5.0, delta=0.02)  # z + z0 for z
        rough = comfort.at_reference(climate, 10.0, 0.03, {**case, "roughness_length": 1.0})[0]
        self.assertLess(rough.scale, 4.0)
        self.assertEqual((rough.origin, rough.frequency, rough.shape), (0.0, 1.0, 2.0))
        with self.assertRaisesRegex(Error, "above its roughness"):
            comfort.at_reference(climate, 0.01, 0.03, case)


class Results(Folder):
    def history(self, values):
        return results.History(numpy.arange(1.0, len(values) + 1.0), numpy.asarray(values, float))

    def test_means_and_drift_are_of_the_last_fifths(self):
        history = self.history([9.0] * 60 + [1.0] * 20 + [2.0] * 21)
        self.assertAlmostEqual(history.last(), 2.0)
        self.assertAlmostEqual(history.drift(), 1.0)
        self.assertEqual(history.spread(), 0.0)

    def test_verdicts(self):
        steps = numpy.arange(200)
        for values, wanted in ((numpy.full(200, 5.0), "settled"), (5.0 + steps * 5e-3, "unsettled"),
                               (5.0 + steps * 1e-3, "nearly settled"), (5.0 + numpy.sin(steps * math.pi / 4), "settled"),
                               (numpy.full(200, math.nan), "unsettled"), ([1.0], "unsettled")):
            self.assertEqual(results.verdict(self.history(values), 5.0), wanted)

    def test_a_table_goes_on_where_a_run_began_again(self):
        self.file("f/0/x.dat", "# Time v\n1 (1 2 3)\n2 (2 2 3)\n3 (3 2 3)\n")
        self.file("f/2/x.dat", "# Time v\n2 (9 2 3)\n3 (8 2 3)\n4 (7 2")  # not finished
        table = results.read_table(self.folder / "f", "x.dat")
        self.assertEqual(table.tolist(), [[1, 1, 2, 3], [2, 9, 2, 3], [3, 8, 2, 3]])
        self.assertEqual(results.read_table(self.folder / "none", "x.dat").size, 0)

    def test_a_log_tells_residuals_and_its_end(self):
        text = ("Time = 1\n\nsmoothSolver:  Solving for Ux, Initial residual = 1, Final residual = 0.01, No Iterations 3\n"
                "GAMG:  Solving for p, Initial residual = 0.5, Final residual = 0.01, No Iterations 3\n"
                "GAMG:  Solving for p, Initial residual = 0.2, Final residual = 0.01, No Iterations 3\n"
                "ExecutionTime = 1.5 s  ClockTime = 2 s\n")
        log = results.read_log(self.file("log", text + text.replace("Time = 1\n", "Time = 2\n").replace("= 0.5", "= 1e-05")))
        self.assertEqual(log.residuals["p"].values.tolist(), [0.5, 1e-05])  # the first solution of each
        self.assertEqual(log.residuals["Ux"].times.tolist(), [1.0, 2.0])
        self.assertEqual((log.ended, log.seconds), (False, 1.5))
        self.assertTrue(results.read_log(self.file("log", text + "End\n")).ended)

    def opening(self, rooms, forward, backward):
        return results.Opening("o", rooms, 1.0, self.history([forward - backward] * 10), self.history([forward + backward] * 10))

    def test_air_comes_in_by_either_way_of_an_opening(self):
        openings = [self.opening(("outside", "a"), 3.0, 1.0), self.opening(("a", "b"), 2.0, 0.5),
                    self.opening(("outside", "b"), 0.25, 1.75), self.opening(("b", "b"), 7.0, 0.0)]
        self.assertAlmostEqual(results.inflow("a", openings).last(), 3.5)
        self.assertAlmostEqual(results.inflow("b", openings).last(), 2.25)
        self.assertAlmostEqual(results.inflow_from("outside", openings).last(), 3.25)
        self.assertAlmostEqual(results.net_inflow("a", openings).last(), 0.5)
        self.assertIsNone(results.inflow("c", openings))

    def test_what_is_missing_between_flows(self):
        self.assertAlmostEqual(results.imbalance([-4.0, 1.0, 2.0]), 0.25)

    def test_percentages_have_no_exponents(self):
        for share, wanted in ((-0.996, "-100 %"), (12.34, "1234 %"), (0.0244, "2.4 %"), (9.9e-5, "less than 0.01 %"), (1e-4, "0.01 %"),
                              (math.inf, "∞ %")):
            self.assertEqual(percent(share), wanted)

    def test_long_names_beside_a_chart_still_differ(self):
        names = [f"flow through {wall}_opening_{number}" for wall in ("WallSouth", "WallOfTheOldHouseToTheSouth") for number in (1, 2)]
        chart = charts.line_chart("Flows", [(name, [1, 2], [0.0, 1.0]) for name in names])
        written = re.findall(r"<text[^>]*>(flow .*?)</text>", chart)
        self.assertEqual(written[:2], names[:2])
        self.assertEqual(len(set(written)), 4)
        self.assertLess(len(written[2]), len(names[2]))

    def test_sections_end_where_the_domain_does(self):
        box, place = (-10.0, 10.0, -4.0, 4.0, 0.0, 3.0), numpy.array([5.0, 2.0, 0.0])
        self.assertEqual(ends_within(box, place, numpy.array([1.0, 0.0, 0.0])), (-10.0, 10.0))
        self.assertEqual(ends_within(box, place, numpy.array([0.0, -1.0, 0.0])), (-4.0, 4.0))
        way = numpy.array([0.6, 0.8, 0.0])
        low, high = ends_within(box, place, way)
        for distance, wanted in ((low, -4.0), (high, 4.0)):
            self.assertAlmostEqual((place + (distance - place @ way) * way)[1], wanted)

    def test_levels_cut_every_opening(self):
        self.assertEqual(levels([(1.0, 2.5), (0.0, 2.0), (4.0, 5.0), (3.0, 6.0)]), [1.5, 4.5])
        self.assertEqual(levels([]), [])
        for ends in ([(0.0, 1.0), (1.0, 2.0)], [(0.0, 9.0), (1.0, 2.0), (3.0, 4.0), (3.5, 7.0)]):
            self.assertTrue(all(any(low < z < high for z in levels(ends)) for low, high in ends))


class Runs(Folder):
    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def case(self, mesh, name, *arguments):
        run = self.atria("case", mesh, "-o", self.folder / name, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        return self.folder / name

    def box(self, name="box"):
        write_box(self.folder / name, (20, 8, 8), BOX, zone_at=10)
        return self.folder / name

    def run_case(self, folder):
        run = subprocess.run([folder / "Allrun"], capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def report(self, folder, *arguments):
        run = self.atria("report", folder, *arguments)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        page = Page((folder / "report.html").read_text(encoding="utf-8"))
        self.assertTrue(all(address.startswith("data:image/png;base64,") for address in page.addresses))
        return page

    def flow(self, folder, function):
        return float((folder / "postProcessing" / function / "0/surfaceFieldValue.dat").read_text().split()[-1])

    def test_a_case_that_has_not_run_says_so(self):
        folder = self.case(self.box(), "case")
        run = self.atria("report", folder)
        self.assertEqual(run.returncode, 6)
        self.assertIn("run its Allrun", run.stderr)
        page = Page((folder / "report.html").read_text(encoding="utf-8"))
        self.assertTrue(any("run its Allrun" in item for item in page.items), page.items)
        self.assertEqual(page.addresses, [])

    def test_what_is_no_case_is_refused(self):
        for folder, text in ((self.folder, "case.json"), (self.folder / "absent", "atria case")):
            run = self.atria("report", folder)
            self.assertEqual(run.returncode, 3)
            self.assertIn(text, run.stderr)
        for text in ("{", "{}", "[]", '{"openings": 3}'):
            self.file("case.json", text)
            run = self.atria("report", self.folder)
            self.assertEqual(run.returncode, 3, text)
            self.assertIn("atria case", run.stderr)
        self.assertEqual(self.atria("report").returncode, 2)
        self.assertEqual(self.atria("report", self.folder, "--station", "10", "0.1").returncode, 2)
        folder = self.case(self.box(), "case")
        run = self.atria("report", folder, "-o", self.folder / "absent/page.html")
        self.assertEqual(run.returncode, 1)
        self.assertIn("absent/page.html: No such file", run.stderr)
        run = subprocess.run([ATRIA, "report", folder], capture_output=True, text=True, check=False,
                             env={**os.environ, "ATRIA_PYTHON": "/absent"})
        self.assertIn("ATRIA_PYTHON", run.stderr)

    def measured(self):
        """A case with results that were made by hand: 10 m3/s into the hall, 4 of them back; the flow drifts."""
        folder = self.case(self.box(), "made")
        self.file("made/log.simpleFoam", "Time = 1\nsmoothSolver:  Solving for Ux, Initial residual = 0.1, Final residual = 0\n")
        for name, value in (("flow_Wall_opening_1", -6.0), ("flowBothWays_Wall_opening_1", 14.0), ("flow_xMin", -100.0),
                            ("flow_xMax", 98.0)):
            rows = "".join(f"{i}\t{value * (1 + 0.002 * i):.6e}\n" for i in range(1, 101))
            self.file(f"made/postProcessing/{name}/0/surfaceFieldValue.dat", "# Time\tsum(phi)\n" + rows)
        return folder

    def test_doubts_follow_from_what_was_measured(self):
        run = Case(self.measured()).runs[0]
        mean = 1 + 0.002 * numpy.arange(81, 101).mean()
        self.assertAlmostEqual(run.inflow("hall"), 10.0 * mean, delta=0.01)
        self.assertAlmostEqual(run.all_air_changes().last(), 10.0 * mean * 3600 / 80000, delta=1e-3)
        doubts = "\n".join(run.doubts())
        for text in ("did not end", "not settled: air changes of the building", "differ by 2 %",
                     "hall: the air that enters and leaves"):
            self.assertIn(text, doubts)
        self.file("made/log.simpleFoam", "Time = 1\nsmoothSolver:  Solving for Ux, Initial residual = nan, Final residual = nan\n")
        self.assertIn("blew up", "\n".join(Case(self.folder / "made").runs[0].failures()))

    def test_places_that_openfoam_did_not_find_are_left_out(self):
        folder = self.measured()
        rows = "".join(f"{i} (3 4 0) (-1e+300 -1e+300 -1e+300) (0 0 {2 * i})\n" for i in range(1, 11))
        self.file("made/postProcessing/pedestrians/0/U", "# Time\n" + rows)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            speed = Case(folder).runs[0].speed()
        self.assertEqual(speed.values.tolist(), [(5 + 2 * i) / 2 for i in range(1, 11)])

    def solved(self, fastest, **patches):
        """A case with made results: 2 m/s, 4 m/s at the inlet, and `fastest` in the cell about (52.5, 7.5, 22.5)."""
        folder = self.folder / f"solved{len(list(self.folder.iterdir()))}"
        self.case(self.box(f"box{folder.name}"), folder.name)
        self.file(f"{folder.name}/log.simpleFoam",
                  "Time = 1\nsmoothSolver:  Solving for Ux, Initial residual = 0.1, Final residual = 0\nEnd\n")
        velocity = numpy.tile([2.0, 0.0, 0.0], (1280, 1))
        velocity[10 + 20 * (5 + 8 * 4)] = 0.0, 0.0, fastest
        at = {"xMin": "(4 0 0)", "xMax": "(2 0 0)", "yMin": "(2 0 0)", "yMax": "(2 0 0)", "zMin": "(0 0 0)", "zMax": "(99 0 0)"} | patches
        listed = b"nonuniform List<vector> 1280(" + velocity.tobytes() + b")"
        for name, of, inside, boundary in (("U", "volVectorField", listed, at),
                                           ("p", "volScalarField", b"uniform 0", dict.fromkeys(at, 0))):
            rows = " ".join(f"{patch} {{ type fixedValue; value uniform {value}; }}" for patch, value in boundary.items())
            head = header(name, of).replace("constant/polyMesh", "1").replace("ascii", "binary")
            file = self.file(f"{folder.name}/1/{name}", "")
            file.write_bytes(f"{head}dimensions [0 0 0 0 0 0 0];\ninternalField ".encode() + inside +
                             f";\nboundaryField {{ {rows} }}\n".encode())
        return folder

    def test_speeds_that_no_wind_has_are_doubted(self):
        page = self.report(self.solved(11.9))
        self.assertFalse([item for item in page.items if "no wind has" in item])
        folder = self.solved(12.1)
        run = self.atria("report", folder)
        self.assertEqual(run.returncode, 6)
        page = Page((folder / "report.html").read_text(encoding="utf-8"))
        for text in (run.stderr, page.items[0]):
            for part in ("12.1 m/s at (52.5, 7.5, 22.5)", "the 4 m/s", "as much: 1)"):
                self.assertIn(part, text)

    def test_speeds_follow_from_what_comes_in_or_is_drawn_out(self):
        """Not from those along slip, nor from a place where air goes out fast beside one where it comes back."""
        failures = lambda *args, **patches: Case(self.solved(*args, **patches)).runs[0].failures()
        self.assertTrue(failures(30.0, xMax="(5 0 0)"))
        self.assertFalse(failures(30.0, xMax="(11 0 0)"))
        self.assertTrue(failures(30.0, xMax="(-11 0 0)"))
        self.assertFalse(failures(30.0, zMin="(0 0 11)"))
        # Where all goes out through the inlet, the wind at the top is what counts: 5 m/s at 10 m, 6.5 at 40 m.
        self.assertFalse(failures(19.0, xMin="(-4 0 0)", xMax="(0 0 0)"))
        self.assertTrue(failures(20.0, xMin="(-4 0 0)", xMax="(0 0 0)"))
        self.assertIn("no number", failures(math.nan)[0])

    def test_still_air_is_a_failure(self):
        """Also where the air moves within, and none comes in."""
        folder = self.solved(3.0)
        for name in ("xMin", "xMax"):
            self.file(f"{folder.name}/postProcessing/flow_{name}/0/surfaceFieldValue.dat", "# Time\tsum(phi)\n1\t-1e-9\n2\t1e-4\n")
        run = self.atria("report", folder)
        self.assertEqual(run.returncode, 6)
        self.assertIn("wind from 270°: nothing flows through xMin, xMax. The wind enters at none of the inlets (xMin)", run.stderr)
        self.file(f"{folder.name}/postProcessing/flow_xMin/0/surfaceFieldValue.dat", "# Time\tsum(phi)\n1\t-9\n2\t-9\n")
        self.report(folder)
        velocity = folder / "1/U"
        velocity.write_bytes(velocity.read_bytes().replace(numpy.float64(2.0).tobytes(), numpy.float64(1e-7).tobytes())
                             .replace(numpy.float64(3.0).tobytes(), numpy.float64(0.0).tobytes()))
        self.assertIn("the air is at rest everywhere", Case(folder).runs[0].failures()[0])

    def test_errors_of_vtk_are_kept(self):
        with noted() as errors:
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(self.folder / "absent.vtp"))
            reader.Update()
        self.assertIn("absent.vtp", errors[0])

    def test_results_without_fields_are_refused(self):
        run = self.atria("report", self.measured())
        self.assertEqual(run.returncode, 3)
        self.assertIn("no fields", run.stderr)

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_air_changes_of_a_hall(self):
        folder = self.case(self.box(), "hall", "--iterations", "60", "--age-of-air")
        self.run_case(folder)
        page = self.report(folder)
        through = self.flow(folder, "flow_Wall_opening_1")
        run = Case(folder).runs[0]
        self.assertAlmostEqual(run.all_air_changes().last(), 0.0, delta=0.01)  # air leaves the hall through its one opening
        self.assertAlmostEqual(run.openings[0].forward(), through, delta=0.01 * through)
        row = page.table("opening")["Wall_opening_1"]
        self.assertEqual(row[2], "hall → outside")
        self.assertAlmostEqual(float(row[3]), through, delta=0.01 * through)
        age = float(page.table("room")["hall"][5]) * 60.0
        self.assertGreater(age, 2.0)  # 50 m at 5 to 7 m/s, the mean is half as old
        self.assertLess(age, 40.0)
        self.assertTrue(any("hall: the air that enters" in item for item in page.items))  # as the inlet is none of its openings

    @unittest.skipUnless(HAVE_OPENFOAM, "OpenFOAM is not installed")
    def test_a_building_in_the_wind(self):
        subprocess.run([sys.executable, BUILDING, self.folder / "school.wrl"], check=True)
        mesh = self.folder / "school.vtu"
        made = self.atria("mesh", self.folder / "school.wrl", "-o", mesh, "--site", "Site", "--openings", "--size-min", "2",
                          "--size-mid", "2", "--size", "Site", "16", "--size-max", "16")
        self.assertIn(made.returncode, (0, 5), made.stderr)
        folder = self.case(mesh, "school", "--rose", "4", "--iterations", "20")
        self.run_case(folder)
        climate = self.file("climate.csv", "from,frequency,scale,shape\n0,25,4,2\n90,25,4,2\n180,25,6,2\n270,25,5,2\n")
        page = self.report(folder, "--climate", climate, "--station", "10", "0.03")
        case = Case(folder)
        summary = page.table("air changes per hour")
        self.assertEqual(summary["air changes per hour"][1:], ["building", *case.ventilated])
        self.assertEqual(len(case.ventilated), 4)
        for run in case.runs:
            outside = [o for o in case.openings if "outside" in o["rooms"]]
            self.assertEqual(len(outside), 6)
            into = 0.0
            for opening in outside:
                measured = run.folder / "postProcessing"
                net, both = (numpy.loadtxt(measured / f"{kind}_{opening['name']}/0/surfaceFieldValue.dat")[-4:, 1].mean()
                             for kind in ("flow", "flowBothWays"))
                into += 0.5 * (both + (net if opening["rooms"][1] != "outside" else -net))
            wanted = into * 3600 / sum(case.volumes.values())
            self.assertAlmostEqual(float(summary[run.title][1]), wanted, delta=0.02 * wanted)
        hours = comfort.at_reference(read_climate(climate), 10.0, 0.03, case.described)
        by_direction = {run.origin: run.all_air_changes().last() for run in case.runs}
        wanted = sum(s.frequency * s.scale * math.gamma(1.5) / 5.0 * by_direction[s.origin] for s in hours)
        self.assertAlmostEqual(float(summary["mean over the climate's hours"][1]), wanted, delta=0.01 * wanted)
        self.assertLess(float(summary["exceeded in 90 % of them"][1]), float(summary["exceeded in 50 % of them"][1]))
        self.assertEqual(page.headings, ["Rooms and openings", "What to doubt", "Speed 1.75 m above the ground", "The flow",
                                         "Wind comfort", "Mesh and wind", "Convergence"])
        # Of each direction the ground, a section through openings, one along the wind and one in space; classes of three kinds.
        self.assertEqual(len(page.addresses), 4 * (3 if CANNOT_DRAW else 4) + 3)
        self.assertTrue(all(min(png_size(address)) > 30 for address in page.addresses))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
