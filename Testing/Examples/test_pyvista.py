# SPDX-License-Identifier: GPL-3.0-or-later
"""atria.mesh takes what PyVista makes, and PyVista takes what it returns. Without PyVista it is skipped.

Usage: test_pyvista.py MODEL.wrl
"""

import pathlib
import sys
import tempfile
import unittest

try:
    import pyvista
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)

import atria

MODEL = sys.argv[1]
CUBE = (0, 4, 0, 4, 0, 4)
ROOM = (-5, 9, -5, 9, -5, 9)
SIDES = ["xMin", "xMax", "yMin", "yMax", "zMin", "zMax"]


class PyVista(unittest.TestCase):
    def test_its_surfaces_are_meshed(self):
        cube = pyvista.Cube(bounds=CUBE)
        before = (cube.n_points, cube.n_cells, cube.array_names)
        result = atria.mesh(cube, 1, domain=ROOM)
        self.assertEqual(list(result.patches), ["surface"] + SIDES)
        self.assertEqual((cube.n_points, cube.n_cells, cube.array_names), before, "the input stays as it is")

    def test_its_names_stay(self):
        ball = pyvista.Sphere(radius=2, center=(0, 0, 2))
        ball["SurfaceName"] = ["ball"] * ball.n_cells
        self.assertIn("ball", atria.mesh(ball, 1).patches)
        blocks = pyvista.MultiBlock({"low": pyvista.Cube(bounds=CUBE), "high": pyvista.Cube(bounds=(6, 8, 0, 4, 0, 8))})
        result = atria.mesh(blocks, 1, domain=(-5, 13, -5, 9, 0, 13))
        self.assertEqual(list(result.patches)[:2], ["low", "high"])

    def test_it_wraps_the_mesh(self):
        result = atria.mesh(pyvista.Cube(bounds=CUBE), 1, domain=ROOM)
        mesh = pyvista.wrap(result.mesh)
        self.assertIsInstance(mesh, pyvista.UnstructuredGrid)
        self.assertEqual(mesh.n_cells, result.report["counts"]["elements"])
        self.assertAlmostEqual(mesh.volume, 14**3 - 4**3, places=6)
        self.assertAlmostEqual(float(mesh["NonOrthogonality"].max()), result.report["quality"]["NonOrthogonality"]["max"])

    def test_it_wraps_patches_and_diagnostics(self):
        result = atria.mesh(pyvista.Cube(bounds=CUBE), 1, domain=ROOM)
        for name, patch in result.patches.items():
            self.assertAlmostEqual(pyvista.wrap(patch).area, 14**2 if name in SIDES else 6 * 4**2, places=6)
        self.assertIsInstance(pyvista.wrap(result.diagnostics), pyvista.PolyData)

    def test_what_it_wrote_and_read_is_a_case(self):
        """The patches are recorded in the mesh, and go with it through PyVista's files."""
        result = atria.mesh(MODEL, 2, domain=(-40, 80, -40, 60, 0, 40))
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "mesh.vtu"
            pyvista.wrap(result.mesh).save(str(file))
            writer = atria.vtkAtriaOpenFOAMWriter()
            writer.SetCaseDirectory(str(file.with_suffix("")))
            writer.SetInputData(pyvista.read(str(file)))
            writer.Write()
            boundary = (file.with_suffix("") / "constant/polyMesh/boundary").read_text()
        for name in result.patches:
            self.assertIn(f"    {name}\n", boundary)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
