# SPDX-License-Identifier: GPL-3.0-or-later
"""The study of a square building: its meshes and cases, what is measured of runs, the grid convergence index.

Usage: test_square_building.py FOLDER_OF_THE_STUDY ATRIA
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FOLDER = pathlib.Path(sys.argv[1])
ATRIA = pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(FOLDER))

import make_building  # noqa: E402
import reference  # noqa: E402
import snappy  # noqa: E402
import study  # noqa: E402
from convergence import convergence  # noqa: E402
from kept_rows import keep  # noqa: E402  (study knows where it is)
from measures import end_of_reversed_flow, reversed_lengths, speeds_at  # noqa: E402
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkImageData  # noqa: E402
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkCellCenters  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkPlaneSource  # noqa: E402

B, H = make_building.WIDTH, make_building.HEIGHT


class Convergence(unittest.TestCase):
    def test_order_and_limit_are_found_again(self):
        for order in (0.6, 1.0, 1.7, 2.0):
            for sizes in ((1.0, 1.5, 2.25), (1.0, 4 / 3, 2.0), (0.2, 0.5, 0.6)):
                found = convergence(sizes, [2.0 + 0.3 * size**order for size in sizes])
                self.assertEqual(found.kind, "monotonic")
                self.assertAlmostEqual(found.order, order, places=6)
                self.assertAlmostEqual(found.limit, 2.0, places=6)
                # The index is the distance from the limit, relative to the finest value, and a quarter more.
                value = 2.0 + 0.3 * sizes[0] ** order
                self.assertAlmostEqual(found.index, 1.25 * (value - 2.0) / value, places=6)

    def test_orders_above_that_of_the_schemes_do_not_make_the_index_small(self):
        found = convergence((1.0, 1.5, 2.25), [2.0 + 0.3 * size**6 for size in (1.0, 1.5, 2.25)])
        self.assertAlmostEqual(found.order, 6.0, places=6)
        difference = 0.3 * (1.5**6 - 1.0)
        self.assertAlmostEqual(found.limit, 2.3 - difference / (1.5**2 - 1.0), places=6)
        self.assertAlmostEqual(found.index, 1.25 * difference / 2.3 / (1.5**2 - 1.0), places=6)

    def test_equal_values_are_the_limit(self):
        found = convergence((1.0, 2.0, 4.0), (0.7, 0.7, 0.7))
        self.assertEqual((found.limit, found.index), (0.7, 0.0))

    def test_what_swings_or_diverges_is_told(self):
        self.assertEqual(convergence((1.0, 1.5, 2.0), (1.0, 0.9, 1.15)).kind, "oscillating")
        diverging = convergence((1.0, 1.5, 2.0), (1.0, 1.2, 1.25))
        self.assertEqual(diverging.kind, "diverging")
        self.assertTrue(math.isnan(diverging.index))
        with self.assertRaises(ValueError):
            convergence((2.0, 1.5, 1.0), (1.0, 1.1, 1.2))


class Reference(unittest.TestCase):
    def test_the_wind_is_as_measured(self):
        for height, speed, k in reference.INFLOW:
            found = reference.inflow(height * B)
            self.assertAlmostEqual(found[0], speed * reference.SPEED, places=9)
            self.assertAlmostEqual(found[1], k * reference.SPEED**2, places=9)
        heights = [0.0005 * i for i in range(1, 800)]
        speeds = [reference.inflow(z)[0] for z in heights]
        self.assertEqual(speeds, sorted(speeds))
        self.assertTrue(all(epsilon > 0 for _, _, epsilon in map(reference.inflow, heights)))
        self.assertAlmostEqual(reference.inflow(0.0)[0], 0.0)

    def test_tables_of_the_wind_go_up_to_the_domains_top(self):
        for omega in (False, True):
            options = reference.inflow_conditions("xMin", omega)
            self.assertEqual(options[2::4], ["U", "k", "omega" if omega else "epsilon"])
            for field, entries in zip(options[2::4], options[3::4]):
                row = r"\(([0-9.e-]+) \(" if field == "U" else r"\(([0-9.e-]+) "
                heights = [float(z) for z in re.findall(row, entries.split("direction")[0])]
                self.assertTrue(all(a < b for a, b in zip(heights, heights[1:])), heights)
                self.assertAlmostEqual(heights[-1], make_building.DOMAIN[2][1])

    def test_profiles_are_complete_and_agree_where_they_meet(self):
        for places, profiles in ((reference.HEIGHTS, reference.MIDDLE), (reference.SIDES, reference.NEAR_GROUND)):
            self.assertTrue(all(len(values) == len(places) for values in profiles.values()))
        for x, values in reference.MIDDLE.items():  # both have the place in the middle plane at z/b = 0.125
            self.assertAlmostEqual(values[0], reference.NEAR_GROUND[x][0], delta=0.011)


def strip(x0, x1, z, count, along):
    """A row of faces beside the middle plane with friction along x, as OpenFOAM writes it, and a row further away."""
    plane = vtkPlaneSource()
    plane.SetOrigin(x0, 0.0, z)
    plane.SetPoint1(x1, 0.0, z)
    plane.SetPoint2(x0, 0.02, z)
    plane.SetXResolution(count)
    plane.SetYResolution(2)
    plane.Update()
    patch = plane.GetOutput()
    centers = vtkCellCenters()
    centers.SetInputData(patch)
    centers.Update()
    places = vtk_to_numpy(centers.GetOutput().GetPoints().GetData()).astype(float)
    friction = [[-along(x) if y < 0.01 else 1.0, 0.0, 0.0] for x, y, _ in places]
    array = numpy_to_vtk(friction, deep=1)
    array.SetName("wallShearStress")
    patch.GetCellData().AddArray(array)
    return patch


class Measures(unittest.TestCase):
    def test_reversed_flow_ends_where_friction_turns(self):
        self.assertAlmostEqual(end_of_reversed_flow([0.0, 1.0, 2.0, 3.0], [-1.0, -1.0, 3.0, 4.0]), 1.25)
        # A vortex in the corner, whose flow at the wall is forward, is not the end.
        self.assertAlmostEqual(end_of_reversed_flow([0.0, 1.0, 2.0, 3.0], [1.0, -1.0, -2.0, 2.0]), 2.5)
        self.assertIsNone(end_of_reversed_flow([0.0, 1.0], [1.0, 0.5]))
        self.assertEqual(end_of_reversed_flow([0.0, 1.0], [1.0, -0.5]), math.inf)

    def test_lengths_are_from_the_front_of_the_roof_and_the_back_of_the_building(self):
        roof = strip(-B / 2, B / 2, H, 40, lambda x: x - (-B / 2 + 0.6 * B))
        ground = strip(-2 * B, 6 * B, 0.0, 320, lambda x: x - (B / 2 + 1.9 * B))
        found = reversed_lengths({"Building": roof, "Ground": ground})
        self.assertAlmostEqual(found[0], 0.6, places=6)
        self.assertAlmostEqual(found[1], 1.9, places=6)

    def test_speeds_are_what_elements_have_also_beside_walls(self):
        image = vtkImageData()
        image.SetDimensions(11, 11, 11)
        image.SetSpacing(0.1 * B, 0.1 * B, 0.1 * B)
        velocity = numpy_to_vtk([[reference.SPEED, 0.0, 0.0]] * image.GetNumberOfCells(), deep=1)
        velocity.SetName("U")
        image.GetCellData().AddArray(velocity)
        on_walls = numpy_to_vtk([[0.0, 0.0, 0.0]] * image.GetNumberOfPoints(), deep=1)
        on_walls.SetName("U")
        image.GetPointData().AddArray(on_walls)
        grid = vtkAppendFilter()
        grid.AddInputData(image)
        grid.Update()
        self.assertTrue(all(abs(u - 1.0) < 1e-9 for u in speeds_at(grid.GetOutput(), [(0.5, 0.0, 0.02), (0.5, 0.5, 0.99)])))


class Study(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name)

    def keep(self, row, **values):
        keep(row, self.out, {"cells": 1000, "mesh_seconds": 1.0, "solve_seconds": 2.0, "iterations": 3,
                             "residuals": {"p": 1e-4}, "worst_non_orthogonality": 50.0, "roof": 0.5, "wake": 2.0, "drag": 1.3, "drift": 1e-4,
                             "profiles": study.MEASURED, **values})

    def test_half_of_the_tunnel_is_meshed_and_gets_the_measured_wind(self):
        model = self.out / "tower.wrl"
        make_building.main(model)
        volume = math.prod(high - low for low, high in make_building.DOMAIN) - B * B * H / 2
        for kind in ("uniform", "adaptive", "layered"):
            folder = self.out / kind
            folder.mkdir()
            mesh, _ = study.mesh_by_atria(ATRIA, study.Row(kind, kind, 8), model, folder)
            case = folder / "case"
            subprocess.run([ATRIA, "case", mesh, "-o", case, *reference.inflow_conditions("xMin")],
                           check=True, capture_output=True)
            described = json.loads((case / "case.json").read_text())
            roles = described["directions"][0]["patches"]
            self.assertEqual({roles[side] for side in ("yMin", "yMax", "zMax")}, {"slip"})
            self.assertEqual([roles[patch] for patch in ("xMin", "xMax", "Ground", "Building")],
                             ["inlet", "outlet", "ground", "wall"])
            self.assertEqual(described["mesh"]["failed_checks"], 0)
            if kind == "uniform":
                self.assertEqual(described["mesh"]["cells"], round(volume / (B / 8) ** 3))
            self.assertIn("fixedProfile", (case / "0/epsilon").read_text())

    def test_the_other_mesher_gets_the_same_sizes(self):
        commands = snappy.write_case(self.out / "case", B / 12, B / 6, B / 3)
        self.assertEqual(list(commands), ["blockMesh", "surfaceFeatureExtract", "snappyHexMesh"])
        block = (self.out / "case/system/blockMeshDict").read_text()
        cells = [int(n) for n in re.search(r"\(0 1 2 3 4 5 6 7\) \((\d+) (\d+) (\d+)\)", block).groups()]
        self.assertEqual(cells, [round((high - low) / (B / 3)) for low, high in make_building.DOMAIN])
        text = (self.out / "case/system/snappyHexMeshDict").read_text()
        self.assertIn("near { mode inside; levels ((1e15 2)); }", text)
        self.assertIn("ground { mode inside; levels ((1e15 1)); }", text)

    def test_a_name_means_one_row(self):
        members = [*sum(study.FAMILIES.values(), []), *study.OTHERS, *study.EMPTY]
        self.assertEqual(len({row.name for row in members}), len(set(members)))

    def test_tables_tell_lengths_differences_and_convergence(self):
        family = study.FAMILIES["uniform"]
        for row, wake in zip(family[1:], (2.4, 2.2, 2.1)):
            self.keep(row, wake=wake, roof=None)
        shifted = {x: [value + 0.1 for value in values] for x, values in study.MEASURED["middle"].items()}
        self.keep(study.OTHERS[1], roof=math.inf, profiles={**study.MEASURED, "middle": shifted})
        self.keep(study.EMPTY[0], wind=[0.9 * speed for _, speed, _ in reference.INFLOW[:-1]])
        text = study.tables(self.out)
        for table in text.split("\n\n")[1::2]:
            self.assertEqual(len({line.count("|") for line in table.strip().splitlines()}), 1, table)
        line = next(line for line in text.splitlines() if line.startswith("| k-epsilon |"))
        self.assertIn("| beyond | 2.00 | 1.300 | 0.100 | 0.000 | 0.100 |", line)
        self.assertIn("| uniform8 | 1,000 |", text)
        self.assertIn("| uniform | 8, 12, 16 | wake | 2.400 | 2.200 | 2.100 | monotonic |", text)
        self.assertNotIn("| roof | 0", text)
        self.assertIn("| adaptive24 | not run |", text)
        self.assertIn("| empty8 |" + 13 * " 0.90 |", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
