# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of natural ventilation: its building, that it goes on where it stopped, and that it tells what failed.

Usage: test_study.py FOLDER_OF_THE_STUDY ATRIA
"""

import contextlib
import dataclasses
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1])
ATRIA = pathlib.Path(sys.argv[2])
sys.path.insert(0, str(FOLDER))

import make_building  # noqa: E402
import make_weather  # noqa: E402
import snappy  # noqa: E402
import study  # noqa: E402
import warm_rooms  # noqa: E402
import year  # noqa: E402
from kept_rows import go_on  # noqa: E402  (study knows where it is)
from polygons import area  # noqa: E402  (make_building knows where it is)


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name)

    def keep(self, row, **values):
        (self.out / "results").mkdir(exist_ok=True)
        result = {**dataclasses.asdict(row), "cells": 1000, "mesh_seconds": 1.0, "solve_seconds": 2.0, "iterations": 3,
                  "air_changes": 10.0, "drift": 0.001, "worst_non_orthogonality": 50.0,
                  "residuals": {"p": 1e-4}, "warmer": 1.0, "heat_balance": 0.0, "unconverged": [], "least": 5.0, "most": 20.0,
                  "hours": {}, **values}
        (self.out / "results" / f"{row.name}.json").write_text(json.dumps(result))

    def main(self, atria, *names):
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            status = go_on(study.make, study.rows(), study.tables, str(atria), str(self.out), *names)
        return status, output.getvalue(), errors.getvalue()

    def test_walls_and_openings_fill_each_plane(self):
        sheets, openings = make_building.sheets(), make_building.openings()
        whole = {"WallSouth": make_building.LENGTH * make_building.HEIGHT, "Corridor": make_building.LENGTH * make_building.HEIGHT,
                 "CrossSouth": make_building.CORRIDOR * make_building.HEIGHT}
        for name, wanted in whole.items():
            holes = sum(area(polygons[0]) for opening, polygons in openings.items() if opening.startswith(name))
            self.assertAlmostEqual(sum(map(area, sheets[name][0])) + holes, wanted)
        self.assertEqual(sum(name.startswith(("WallSouth", "WallNorth")) for name in openings), 6)

    def test_atria_finds_the_openings_and_rooms(self):
        model, report = self.out / "school.wrl", self.out / "report.json"
        make_building.main(model)
        run = subprocess.run([ATRIA, "mesh", model, "-o", self.out / "mesh.vtu", "--site", "Site", "--openings", "--size-min", "2",
                              "--size-mid", "2", "--size", "Site", "16", "--size-max", "16", "--report", report],
                             capture_output=True, text=True, check=False)
        self.assertIn(run.returncode, (0, 5), run.stderr)
        found = json.loads(report.read_text())
        wanted = {name: area(polygons[0]) for name, polygons in make_building.openings().items()}
        measured = {opening["name"]: opening["area"] for opening in found["openings"]}
        self.assertEqual(measured.keys(), wanted.keys())
        for name, value in wanted.items():
            self.assertAlmostEqual(measured[name], value, delta=1e-3 * value)
        volume = sum(room["volume"] for room in found["rooms"] if room["name"] != "outside")
        self.assertAlmostEqual(volume, make_building.volume(), delta=1e-3 * volume)

    def test_the_whole_may_stand_across_the_grid(self):
        model = self.out / "school.wrl"
        row = study.Row("turned", far=16.0, ground=16.0, angle=17.0)
        make_building.main(model, *row.site, row.angle)
        mesh, _ = study.mesh_by_atria(ATRIA.resolve(), row, model, self.out)
        case = self.out / "case"
        subprocess.run(study.case_command(ATRIA, row, mesh, case), check=True, capture_output=True)
        described = json.loads((case / "case.json").read_text())
        self.assertEqual([described["directions"][0]["patches"][side] for side in ("yMin", "yMax", "xMin", "xMax")],
                         ["inlet", "outlet", "slip", "slip"])
        wanted = sorted(area(polygons[0]) for polygons in make_building.openings().values())
        for found, value in zip(sorted(opening["area"] for opening in described["openings"]), wanted, strict=True):
            self.assertAlmostEqual(found, value, delta=0.01 * value)

    def test_fine_ground_holds_the_building_however_it_is_turned(self):
        self.assertEqual(study.bounds_about_building(5.0, 0.0), ((-5.0, -5.0), (make_building.LENGTH + 5.0, make_building.WIDTH + 5.0)))
        for angle in (17.0, 90.0, 200.0):
            low, high = study.bounds_about_building(5.0, angle)
            for polygon in make_building.turned(make_building.sheets()["Roof"][0], angle):
                for x, y, _ in polygon:
                    self.assertTrue(low[0] + 4.9 < x < high[0] - 4.9 and low[1] + 4.9 < y < high[1] - 4.9, angle)

    def test_a_name_means_one_row(self):
        members = {row for table in (*study.TABLES.values(), study.WARM, [study.YEAR]) for row in table}
        self.assertEqual(len({row.name for row in members}), len(members))

    def test_rows_that_are_there_are_not_made_again(self):
        for row in study.rows():
            self.keep(row)
        status, output, errors = self.main("/absent")
        self.assertEqual((status, errors), (0, ""))
        self.assertNotIn("…", output)

    def test_rows_of_other_settings_are_made_again(self):
        row = study.rows()[0]
        self.keep(row, far=row.far * 2)
        self.assertIsNone(study.known(row, self.out))
        (self.out / "results" / f"{row.name}.json").write_text('{"name": ')
        self.assertIsNone(study.known(row, self.out))

    def test_what_failed_is_told_and_the_others_go_on(self):
        broken = self.out / "atria"
        broken.write_text("#!/bin/sh\necho sizes make no sense\nexit 3\n")
        broken.chmod(0o755)
        status, output, errors = self.main(broken, "far4", "far8")
        self.assertEqual(status, 1)
        self.assertEqual(len(re.findall(r"^(far[48]): mesh ended with 3: see (.*)$", errors, re.MULTILINE)), 2)
        self.assertIn("sizes make no sense", (self.out / "rows/far8/log.mesh").read_text())
        tables = (self.out / "tables.md").read_text()
        self.assertEqual(tables.count("not run"), sum(map(len, study.TABLES.values())) + len(study.WARM) + 1)
        with self.assertRaisesRegex(SystemExit, "no row far7"):
            self.main(broken, "far7")

    def test_tables_compare_with_their_first_row(self):
        self.keep(study.FAR[0], air_changes=20.0)
        self.keep(study.FAR[1], air_changes=20.5)
        lines = study.table("Far", study.FAR[:3], self.out).splitlines()
        columns = lines[2].count("|")
        self.assertTrue(all(line.count("|") == columns for line in lines[2:] if line), lines)
        self.assertIn("20.50 (+2.5 %)", lines[5])
        self.assertIn("not run", lines[6])

    def test_warm_rooms_have_their_heat_with_and_without_wind(self):
        calm, windy = ([str(word) for word in study.case_command("atria", row, "mesh", "case")] for row in study.WARM[:2])
        self.assertIn("--calm", calm)
        self.assertNotIn("--speed", calm)
        self.assertEqual(windy[windy.index("--speed") + 1], "1")
        for command in (calm, windy):  # 30 W for each of 1,248 m2
            self.assertEqual(command[command.index("--heat") + 1:][:2], ["room_*", "37440W"])

    def test_flow_by_wind_and_warmth_is_compared_with_formulas(self):
        # 6 windows of 24 m2, 4 m high: 0.6 * 24 / 3 sqrt(9.81 * 4 * 2 / 295.15) each.
        self.assertAlmostEqual(warm_rooms.stack_flow(2.0), 6 * 4.8 * math.sqrt(9.81 * 4.0 * 2.0 / 295.15))
        calm, windy = study.WARM[:2]
        results = {"air_changes": 3.0, "warmer": 4.0}, {"air_changes": 5.0, "warmer": 1.0}
        wanted = math.hypot(warm_rooms.flow_of(4.0), warm_rooms.flow_of(1.5))
        self.assertAlmostEqual(warm_rooms.expected(windy, results[1], results[0], 4.0), wanted)
        self.assertIsNone(warm_rooms.expected(windy, results[1], None, 4.0))
        for row, result in zip((calm, windy, study.WARM[3]), (*results, {"air_changes": 4.0 * study.SPEED})):
            self.keep(row, **result)
        lines = warm_rooms.table([(row, study.known(row, self.out)) for row in study.WARM]).splitlines()
        self.assertEqual(len({line.count("|") for line in lines[2:]}), 1, lines)
        self.assertIn(f"{wanted:.2f} ({100 * (warm_rooms.flow_of(5.0) / wanted - 1):+.1f} %)", lines[5])
        self.assertIn("not run", lines[6])

    def test_the_year_is_the_same_each_time(self):
        first, again = list(make_weather.hours()), list(make_weather.hours())
        self.assertEqual(first, again)
        self.assertEqual(len(first), 8760)
        weather = self.out / "year.epw"
        make_weather.main(weather)
        run = subprocess.run([ATRIA, "climate", weather, "--json", "--temperature", "18", "26"], capture_output=True, text=True, check=True)
        kept = [hour for hour in first if 18 <= hour.temperature <= 26]
        self.assertEqual(json.loads(run.stdout)["hours"]["kept"], len(kept))

    def test_hours_take_the_direction_next_to_them(self):
        hours = [make_weather.Hour(20.0, 350, 4.0), make_weather.Hour(20.0, 100, 2.0), make_weather.Hour(20.0, 0, 0.0)]
        self.assertAlmostEqual(year.hour_by_hour(hours, {0.0: 10.0, 90.0: 20.0}, 0.25), (10.0 + 10.0 + 0.0) / 3)

    def test_the_other_mesher_gets_the_same_surfaces_and_sizes(self):
        commands = snappy.write_case(self.out / "case", 2.0, 8.0, make_building.SITE)
        self.assertEqual(list(commands), ["blockMesh", "surfaceFeatureExtract", "snappyHexMesh"])
        surfaces = {file.stem for file in (self.out / "case/constant/triSurface").glob("*.stl")}
        self.assertEqual(surfaces, make_building.sheets().keys() | make_building.openings().keys() | {"Neighbor"})
        text = (self.out / "case/system/blockMeshDict").read_text()
        cells = [int(n) for n in re.search(r"\(0 1 2 3 4 5 6 7\) \((\d+) (\d+) (\d+)\)", text).groups()]
        for count, length in zip(cells, (*make_building.SITE, 0.3 * max(make_building.SITE))):
            self.assertLess(abs(math.log(length / count / 8.0)), 0.07)

    def test_the_other_mesher_gets_layers_on_walls_and_ground_only(self):
        def layers_of(number):
            case = self.out / f"layers{number}"
            snappy.write_case(case, 2.0, 8.0, make_building.SITE, number)
            text = (case / "system/snappyHexMeshDict").read_text()
            pattern, count = re.search(r'layers \{ "(.*?)" \{ nSurfaceLayers (\d+); \} \}', text).groups()
            return "addLayers true" in text, re.compile(pattern), int(count)

        self.assertFalse(layers_of(0)[0])
        added, pattern, count = layers_of(5)
        self.assertEqual((added, count), (True, 5))
        self.assertTrue(all(pattern.fullmatch(name) for name in ("Site", "Neighbor", *make_building.sheets())))
        self.assertFalse(any(pattern.fullmatch(name) for name in ("zMax", "xMin", *make_building.openings())))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
