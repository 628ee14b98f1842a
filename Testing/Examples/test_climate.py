# SPDX-License-Identifier: GPL-3.0-or-later
"""atria climate: what it prints and writes, what it refuses, and that `atria report` and `atria case` take its table.
VTK's reader of weather makes the same table, and the writer of cases takes it.

Usage: test_climate.py ATRIA
"""

import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOCore import vtkDelimitedTextWriter

import atria
from atria.report import comfort, read_climate
from box_mesh import BoxCase
from weather_year import epw

ATRIA = pathlib.Path(sys.argv[1])


def mixed(number):
    return number * 1009 % 8760


class Climate(BoxCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        draw = random.Random(5)
        # 2,232 hours lie in 18 to 26 degrees; no wind comes from 150; every twentieth hour is calm.
        cls.weather = cls.folder / "town.epw"
        cls.weather.write_text(epw(lambda n: 22.0 if mixed(n) < 2232 else 17.9 if n % 2 else 26.1,
                                   lambda n: 0 if n % 20 == 0 else (30 * (n % 12) if n % 12 != 5 else 180),
                                   lambda n: 0.0 if n % 20 == 0 else round(draw.weibullvariate(4.0, 2.0) + 0.5, 1)))

    def atria(self, *arguments):
        return subprocess.run([ATRIA, *map(str, arguments)], capture_output=True, text=True, check=False)

    def climate(self, *arguments):
        run = self.atria("climate", *arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run

    def report(self, *arguments):
        return json.loads(self.climate(self.weather, "--json", *arguments).stdout)

    def refuses(self, status, text, *arguments):
        run = self.atria("climate", *arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertIn(text, run.stderr)

    def test_it_prints_place_hours_and_rose(self):
        text = self.climate(self.weather).stdout
        self.assertIn("Port & Town, AUS: EPW, 33.9 S, 150.2 E, 12.5 m", text)
        self.assertIn("Hours: 8,760 read, 8,760 kept\n", text)
        self.assertIn("(18 to 26 °C): 2,232 of 8,760 hours, 25.5 %", text)
        self.assertIn("438 calm hours (below 0.5 m/s, 5.0 %), shared out", text)
        rows = [line.split() for line in text.split("shape\n")[1].splitlines()]
        self.assertEqual([row[0] for row in rows[:13]], [*map(str, range(0, 360, 30)), "all"])
        self.assertAlmostEqual(sum(float(row[2]) for row in rows[:12]), 100.0, delta=0.6)

    def test_filters(self):
        self.assertEqual(self.report("--temperature", 18, 26)["hours"]["kept"], 2232)
        warm = self.report("--temperature", 26.1, 40)
        self.assertEqual(warm["ventilation"]["temperature"], [26.1, 40.0])
        self.assertEqual(warm["ventilation"]["hours"], warm["hours"]["kept"])
        night = self.report("--hours", 22, 6, "--months", "12-2")
        self.assertEqual(night["hours"]["kept"], 90 * 8)
        self.assertEqual(night["ventilation"]["of"], 90 * 8)
        summer = self.report("--season", "summer")
        self.assertEqual(summer["hours"], {"read": 8760, "kept": 90 * 24, "filter": "summer"})
        self.assertEqual(summer["sectors"], self.report("--months", "12,1,2")["sectors"], "the town lies in the south")

    def test_the_rose_sums_to_one_and_says_whose_shape_is_its_own(self):
        found = self.report()
        self.assertEqual(found["location"]["latitude"], -33.9)
        self.assertAlmostEqual(sum(sector["frequency"] for sector in found["sectors"]), 1.0, places=12)
        self.assertEqual([s["own_shape"] for s in found["sectors"]], [i != 5 for i in range(12)])
        self.assertEqual(sum(s["hours"] for s in found["sectors"]) + found["wind"]["calms"], found["wind"]["hours"])
        self.assertIn("fewer than 60 hours of wind from 150 degrees", self.climate(self.weather).stderr)
        self.assertEqual(len(self.report("--sectors", 36)["sectors"]), 36)
        self.assertIn("take 4, 12 or 36", self.climate(self.weather, "--sectors", 8).stderr)

    def test_report_takes_the_table(self):
        table = self.folder / "climate.csv"
        self.assertIn("--rose", self.climate(self.weather, "-o", table).stdout)
        with table.open() as lines:
            self.assertEqual(next(csv.reader(lines)), ["from", "frequency", "scale", "shape"])
        sectors, found = read_climate(table), self.report()["sectors"]
        self.assertEqual([s.origin for s in sectors], [s["from"] for s in found])
        for sector, wanted in zip(sectors, found):
            self.assertAlmostEqual(sector.frequency, wanted["frequency"], places=5)
            self.assertAlmostEqual(sector.scale, wanted["scale"], places=3)
        above = sum(s.frequency * math.exp(-((5.0 / s.scale) ** s.shape)) for s in sectors)
        self.assertAlmostEqual(above, self.report()["wind"]["above_5"]["by_table"], places=3)
        self.assertAlmostEqual(above, self.report()["wind"]["above_5"]["measured"], delta=0.02)
        moved = comfort.at_reference(sectors, 10.0, 0.03, {"reference_height": 10.0, "roughness_length": 0.5})
        self.assertLess(moved[0].scale, sectors[0].scale)
        case = self.folder / "reported"
        self.assertEqual(self.atria("case", self.box, "-o", case, "--rose", table).returncode, 0)
        run = self.atria("report", case, "--climate", table, "--station", "10", "0.03")
        self.assertNotIn("climate.csv", run.stderr)
        run = self.atria("report", case, "--climate", self.weather)
        self.assertEqual(run.returncode, 3, run.stderr)
        self.assertIn("town.epw is a weather file and no table of the wind: make the table of it first, by `atria climate`", run.stderr)

    def test_case_takes_the_table_for_its_rose(self):
        table = self.folder / "rose.csv"
        self.climate(self.weather, "-o", table)
        folder = self.folder / "rose"
        run = self.atria("case", self.box, "-o", folder, "--rose", table, "--north", "10")
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        directions = json.loads((folder / "case.json").read_text())["directions"]
        self.assertEqual([round(d["from"], 9) for d in directions], [d for d in range(0, 360, 30) if d != 150])
        self.assertEqual(directions[1]["folder"], "wind_030")
        config = self.folder / "rose.toml"
        self.atria("case", "--write-config", config, "--rose", table)
        run = self.atria("case", self.box, "-o", self.folder / "by_config", "--config", config)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        twice = self.folder / "twice.csv"
        twice.write_text("from,frequency,scale,shape\n0,0.5,4,2\n360,0.5,4,2\n")
        for status, text, rose in ((2, "neither a whole number from 0 to 360 nor a file", "absent.csv"), (2, "neither", "1.5"),
                                   (2, "neither", "361"), (3, "town.epw is a weather file and no table", self.weather),
                                   (3, "twice.csv, sector 2: sector 1 has the direction 0, too", twice)):
            run = self.atria("case", self.box, "-o", self.folder / "no", "--rose", rose)
            self.assertEqual(run.returncode, status, run.stderr)
            self.assertIn(text, run.stderr)

    def test_the_picture_is_svg(self):
        picture = self.folder / "rose.svg"
        self.climate(self.weather, "--picture", picture, "--temperature", 18, 26)
        root = ElementTree.parse(picture).getroot()
        self.assertEqual(root.tag, "{http://www.w3.org/2000/svg}svg")
        texts = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
        for text in ("Port & Town, AUS", "2,232 of 8,760 hours: 18 to 26 °C", "N", "calm", "Wind speed"):
            self.assertIn(text, texts)

    def test_missing_values_are_counted(self):
        few = self.folder / "few.epw"
        few.write_text(epw(lambda n: 99.9 if n % 100 == 0 else 20.0, lambda n: 90, lambda n: 999 if n % 50 == 0 else 3.0))
        run = self.climate(few)
        self.assertIn("note: ", run.stderr)
        self.assertIn("of 8,760 hours, 88 lack their temperature and 176 lack their wind;", run.stderr)
        self.assertNotIn("warning", run.stderr)
        self.assertIn("8,672 of 8,672 hours, 100.0 %", run.stdout)
        many = self.folder / "many.epw"
        many.write_text(epw(lambda n: 20.0, lambda n: 90, lambda n: 999 if n % 9 == 0 else 3.0))
        self.assertIn("warning: ", self.climate(many).stderr)
        self.assertIn("more than a tenth", self.climate(many).stderr)

    def test_bad_files_are_refused(self):
        text = self.weather.read_text()
        for status, wanted, content in ((3, "is empty", ""), (3, "neither an EPW file", "a,b\n1,2\n"),
                                        (3, "bad.epw:4009: the file ends with hour 17 of 6/16", "\n".join(text.split("\n")[:4009])),
                                        (3, "bad.epw:9: the dry-bulb temperature, 72 C", text.replace(",A7,22.0,", ",A7,72,"))):
            bad = self.folder / "bad.epw"
            bad.write_text(content)
            self.refuses(status, wanted, bad, "-o", self.folder / "bad.csv")
        self.assertFalse((self.folder / "bad.csv").exists())
        self.refuses(3, "does not exist", self.folder / "absent.epw")

    def test_temperatures_that_no_hour_has_are_named_as_the_cause(self):
        self.refuses(3, f"error: {self.weather}: no hour has a temperature from 60 to 70 C; the file has 17.9 to 26.1 C\n",
                     self.weather, "--temperature", 60, 70)
        self.refuses(3, "no hour has a temperature from 291.15 to 299.15 C; the file has 17.9 to 26.1 C; the limits look like "
                     "kelvin: write 18 to 26 degrees Celsius\n", self.weather, "--temperature", 291.15, 299.15)
        self.refuses(3, "none of the 744 hours selected has a temperature from 0 to 5 C; these have 17.9 to 26.1 C, and the file has ",
                     self.weather, "--temperature", 0, 5, "--months", 7)
        unknown = self.folder / "unknown.epw"
        unknown.write_text(epw(lambda n: 99.9, lambda n: 90, lambda n: 3.0))
        self.refuses(3, "no hour of the file has a known temperature; leave out", unknown, "--temperature", 18, 26)
        self.assertEqual(json.loads(self.climate(unknown, "--json").stdout)["hours"]["kept"], 8760)
        partly = self.folder / "partly.epw"
        partly.write_text(epw(lambda n: 99.9 if n < 2000 else 20.0, lambda n: 90, lambda n: 3.0))
        self.refuses(3, "none of the 744 hours selected has a known temperature; select", partly, "--temperature", 18, 26,
                     "--months", 1)

    def test_usage(self):
        self.refuses(2, "WEATHER is required")
        self.refuses(2, "the lower one comes first", self.weather, "--temperature", 26, 18)
        self.refuses(2, "no hours", self.weather, "--hours", 8, 8)
        self.refuses(2, "'25' is not a number from 0 to 24", self.weather, "--hours", 8, 25)
        self.refuses(2, "names no months", self.weather, "--months", "april")
        self.refuses(2, "--season", self.weather, "--season", "summer", "--months", "4-9")
        self.refuses(2, "--season", self.weather, "--season", "monsoon")
        self.refuses(2, ".csv", self.weather, "-o", self.folder / "table.txt")
        self.refuses(2, ".svg", self.weather, "--picture", self.folder / "rose.png")
        self.refuses(2, "--sectors", self.weather, "--sectors", 3)

    def test_config(self):
        config = self.folder / "climate.toml"
        self.climate("--write-config", config, "--temperature", 18, 26, "--months", "4-9")
        self.assertIn("[climate]\n", config.read_text())
        found = self.report("--config", config)
        self.assertEqual(found["hours"]["filter"], "18 to 26 °C, months 4-9")

    def reader(self, file=None):
        reader = atria.vtkAtriaWeatherReader()
        reader.SetFileName(str(file or self.weather))
        return reader

    def test_the_reader_makes_the_table_of_the_command_line(self):
        for arguments, change in (((), lambda reader: None),
                                  (("--temperature", 18, 26), lambda reader: (reader.UseTemperatureRangeOn(), reader.SetTemperatureRange(18, 26))),
                                  (("--hours", 22, 6, "--months", "12-2"), lambda reader: (reader.SetHours(22, 6), reader.SetMonths("12-2"))),
                                  (("--season", "summer", "--sectors", 36), lambda reader: (reader.SetSeason(reader.Summer), reader.SetSectors(36))),
                                  (("--calm", 2.5), lambda reader: reader.SetCalmSpeed(2.5))):
            reader, wanted = self.reader(), self.report(*arguments)
            change(reader)
            reader.Update()
            table, fields = reader.GetOutput(), reader.GetOutput().GetFieldData()
            self.assertEqual([table.GetColumnName(i) for i in range(table.GetNumberOfColumns())], ["from", "frequency", "scale", "shape"])
            for name in ("from", "frequency", "scale", "shape"):
                self.assertEqual(list(vtk_to_numpy(table.GetColumnByName(name))), [s[name] for s in wanted["sectors"]], arguments)
            value = lambda name: fields.GetAbstractArray(name).GetValue(0)
            self.assertEqual(value("StationName"), "Port & Town, AUS")
            self.assertEqual([value("Latitude"), value("Longitude"), value("Elevation")], [-33.9, 150.2, 12.5])
            self.assertEqual([value("HoursRead"), value("HoursKept")], [8760, wanted["hours"]["kept"]])
            self.assertEqual([value("VentilationHours"), value("VentilationHoursKnown")],
                             [wanted["ventilation"]["hours"], wanted["ventilation"]["of"]])
            self.assertEqual([value("CalmHours"), value("MeanSpeed")], [wanted["wind"]["calms"], wanted["wind"]["mean_speed"]])

    def test_the_reader_names_file_and_line(self):
        bad = self.folder / "hot.epw"
        bad.write_text(self.weather.read_text().replace(",A7,22.0,", ",A7,295.15,"))
        with self.assertRaisesRegex(atria.Error, r"hot.epw:9: the dry-bulb temperature, 295.15 C, is not from -70 to 70"):
            self.reader(bad).Update()
        self.assertRaisesRegex(atria.Error, "FileName is not set", atria.vtkAtriaWeatherReader().Update)
        for change, text in ((lambda reader: (reader.UseTemperatureRangeOn(), reader.SetTemperatureRange(60, 70)),
                              "town.epw: no hour has a temperature from 60 to 70 C; the file has 17.9 to 26.1 C"),
                             (lambda reader: reader.SetTemperatureRange(26, 18), "the lower one comes first"),
                             (lambda reader: reader.SetTemperatureRange(math.nan, 18), "TemperatureRange is nan"),
                             (lambda reader: reader.SetHours(8, 25), "Hours is 25"),
                             (lambda reader: reader.SetHours(8, 8), "no hours"),
                             (lambda reader: reader.SetMonths("april"), "names no months"),
                             (lambda reader: (reader.SetSeason(reader.Summer), reader.SetMonths("4-9")), "exclude each other")):
            reader = self.reader()
            change(reader)
            self.assertRaisesRegex(atria.Error, text, reader.Update)
            self.assertEqual(reader.GetOutput().GetNumberOfRows(), 0)

    def test_the_reader_knows_weather_by_its_beginning(self):
        tmy3 = self.folder / "tmy3.csv"
        tmy3.write_text('700000,"CITY",ST,1.0,50,8,10\nDate (MM/DD/YYYY),Time (HH:MM)\n')
        table = self.folder / "other.csv"
        table.write_text("from,frequency,scale,shape\n0,1,4,2\n")
        can_read = atria.vtkAtriaWeatherReader.CanReadFile
        self.assertEqual([can_read(str(file)) for file in (self.weather, tmy3, table, self.folder, self.folder / "absent.epw")],
                         [True, True, False, False, False])

    def test_the_writer_takes_the_table(self):
        table = self.folder / "of_vtk.csv"
        text = vtkDelimitedTextWriter()
        reader = self.reader()
        text.SetInputConnection(reader.GetOutputPort())
        text.SetFileName(str(table))
        text.Write()

        def written(name, change=lambda writer: None):
            writer = atria.vtkAtriaOpenFOAMCaseWriter()
            writer.SetCaseDirectory(str(self.folder / name))
            writer.SetNorthAngle(10.0)
            writer.SetRoseFileName(str(table))
            change(writer)
            writer.WriteForMesh(str(self.box))
            return json.loads((self.folder / name / "case.json").read_text())["directions"]

        self.assertEqual([round(d["from"], 9) for d in written("by_vtk")], [d for d in range(0, 360, 30) if d != 150])
        twice = self.folder / "twice.csv"
        twice.write_text("from,frequency,scale,shape\n0,0.5,4,2\n360,0.5,4,2\n")
        for change, wanted in ((lambda writer: writer.SetNumberOfRoseDirections(8), "RoseFileName excludes"),
                               (lambda writer: writer.AddWindAngle(0.0), "RoseFileName excludes"),
                               (lambda writer: writer.SetRoseFileName(str(twice)), "RoseFileName: .*sector 2: sector 1 has the direction 0"),
                               (lambda writer: writer.SetRoseFileName(str(self.weather)), "is a weather file and no table"),
                               (lambda writer: writer.SetRoseFileName("absent.csv"), "'absent.csv' does not exist")):
            with self.assertRaisesRegex(atria.Error, wanted):
                written("refused", change)
        self.assertFalse((self.folder / "refused").exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
