# SPDX-License-Identifier: GPL-3.0-or-later
"""atria.mesh: a model in, mesh, patches, diagnostics and report out.

Usage: test_mesh_function.py MODEL.wrl VERSION
"""

import ast
import base64
import importlib.metadata
import inspect
import os
import pathlib
import shutil
import tempfile
import unittest
import warnings
import sys
import xml.etree.ElementTree

from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOImage import vtkPNGReader

import atria

MODEL, VERSION = sys.argv[1:3]
BOX = (-40, 80, -40, 60, 0, 40)


class Wrapped(vtkPolyData):
    """As PyVista derives its data from VTK's."""


class Mesh(unittest.TestCase):
    def test_a_file_and_two_numbers(self):
        result = atria.mesh(MODEL, size=2.0, layers=2, domain=BOX)
        # VTK 9.6 makes objects of classes of its own that derive from these.
        self.assertIs(type(result.mesh), type(vtkUnstructuredGrid()))
        self.assertEqual(result.report["counts"]["elements"], result.mesh.GetNumberOfCells())
        shapes = ("hexahedra", "wedges", "pyramids", "tetrahedra", "polyhedra")
        self.assertEqual(sum(result.report["counts"][shape] for shape in shapes), result.mesh.GetNumberOfCells())
        self.assertIn("WallSouth_front", result.patches)
        for name, patch in result.patches.items():
            self.assertIs(type(patch), type(vtkPolyData()), name)
            self.assertGreater(patch.GetNumberOfCells(), 0)
        self.assertGreater(result.diagnostics.GetFieldData().GetNumberOfArrays(), 10)
        self.assertEqual({layer["layers"] for layer in result.report["layers"]}, {2})
        worst = result.mesh.GetCellData().GetArray("NonOrthogonality").GetRange()[1]
        self.assertAlmostEqual(result.report["quality"]["NonOrthogonality"]["max"], worst)
        zones = result.report["zones"]
        self.assertEqual([zone["kind"] for zone in zones if not zone["kept"]], ["solid"])
        self.assertEqual(sum(zone["elements"] for zone in zones if zone["kept"]), result.mesh.GetNumberOfCells())
        self.assertGreater(sum(result.report["seconds"].values()), 0)

    def test_sizes(self):
        counts = []
        for sizes in ({"size": 2}, {"size_min": 1}, {"size_max": 8}, {"size": 2, "size_min": 1, "size_max": 8}):
            result = atria.mesh(MODEL, domain=BOX, layers=0, **sizes)
            counts.append(result.report["counts"])
        self.assertEqual([counts[0]] * 4, counts)
        finer = atria.mesh(MODEL, 2, domain=BOX, layers=0, sizes={"Roof*": 0.5})
        self.assertGreater(finer.report["counts"]["elements"], counts[0]["elements"])
        suggested = atria.mesh(MODEL, layers=0)
        self.assertTrue(10_000 < suggested.report["counts"]["elements"] < 1_000_000)

    def test_layers_by_name(self):
        result = atria.mesh(MODEL, 2, domain=BOX, layers={"*": 1, "Wall*": 3, "Floor": (2, 0.05, 1.5)})
        layers = {layer["surface"]: layer["layers"] for layer in result.report["layers"]}
        self.assertEqual((layers["WallSouth"], layers["Floor"], layers["RoofSouth"]), (3, 2, 1))

    def test_what_vtk_and_others_have(self):
        cube = vtkCubeSource()
        cube.SetBounds(0, 4, 0, 4, 0, 4)
        cube.Update()
        wrapped = Wrapped()
        wrapped.ShallowCopy(cube.GetOutput())
        counts = [atria.mesh(model, 1, domain=(-5, 9, -5, 9, -5, 9)).report["counts"]
                  for model in (cube, cube.GetOutput(), wrapped)]
        self.assertEqual(counts, [counts[0]] * 3)
        self.assertRaises(TypeError, atria.mesh, vtkImageData(), 1)
        self.assertRaises(TypeError, atria.mesh, 3, 1)
        self.assertRaises(TypeError, atria.mesh, cube, 1, unit="in")

    def test_options_of_files_and_properties(self):
        small = atria.mesh(MODEL, 2 * 0.0254, unit="in", domain=[0.0254 * x for x in BOX], layers=0, SupportElements=False)
        whole = atria.mesh(MODEL, 2, domain=BOX, layers=0, SupportElements=False)
        self.assertEqual(small.report["counts"]["elements"], whole.report["counts"]["elements"])
        self.assertNotIn("Neighbor", atria.mesh(MODEL, 2, domain=BOX, layers=0, without=["Neighbor"]).patches)
        self.assertNotIn("Neighbor", atria.mesh(MODEL, 2, domain=BOX, layers=0, without="Neighbor").patches)
        self.assertNotEqual(atria.mesh(MODEL, 2, domain=BOX, layers=0, SupportElements=False, CellsPerLevel=3).report["counts"],
                            whole.report["counts"])
        with self.assertRaisesRegex(TypeError, "did you mean CellsPerLevel"):
            atria.mesh(MODEL, 2, CellPerLevel=3)
        for seeds in ([(51, 5, 3)], (51, 5, 3)):
            rooms = atria.mesh(MODEL, 2, domain=BOX, layers=0, seeds=seeds)
            self.assertEqual([zone["surfaces"] for zone in rooms.report["zones"] if zone["kept"]], [["Neighbor"]])
        self.assertRaises(ValueError, atria.mesh, MODEL, unit="yd")
        self.assertRaises(ValueError, atria.mesh, MODEL, surfaces_by="Group")
        sketchup = pathlib.Path(MODEL).parent / "sketchup_house.wrl"
        with warnings.catch_warnings():
            warnings.simplefilter("error", atria.ModelWarning)
            drawn = atria.mesh(sketchup, 2, unit="in", up="y", surfaces_by="group", domain=BOX, layers=0)
        self.assertIn("WallSouth_front", drawn.patches)
        self.assertRaises(ValueError, atria.mesh, MODEL, domain="everywhere")
        self.assertRaises(ValueError, atria.mesh, MODEL, domain=(0, 1))

    def test_errors_and_warnings(self):
        with self.assertRaisesRegex(atria.Error, "absent.wrl does not exist"):
            atria.mesh("absent.wrl", size=1)
        for name in ("size", "size_min", "size_max"):
            for value in (-1, 0, float("nan"), float("inf"), "1"):
                with self.assertRaisesRegex(atria.Error, f"^{name} is {value!r}; "):
                    atria.mesh(MODEL, **{name: value})
        with self.assertRaisesRegex(atria.Error, "did you mean 'WallSouth'"):
            atria.mesh(MODEL, size=2, sizes={"WallSouht": 1})
        with self.assertRaises(atria.Error) as caught:
            atria.mesh(MODEL, without="*")
        self.assertEqual(str(caught.exception).count("\n"), 0, "one error, and none of what follows from it")
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = atria.mesh(MODEL, 2, domain=(5, 20, 0, 14, 0, 30), layers=0)
        self.assertTrue(caught)
        self.assertTrue(all(issubclass(one.category, atria.ModelWarning) for one in caught))
        self.assertEqual([str(one.message) for one in caught], result.report["warnings"])
        self.assertIn("cuts through", result.report["warnings"][0])
        self.assertIn(__file__, caught[0].filename)

    def test_files_that_are_no_models(self):
        with tempfile.TemporaryDirectory() as folder:
            with self.assertRaisesRegex(atria.Error, "is a folder"):
                atria.mesh(folder)
            headless = pathlib.Path(folder) / "headless"
            headless.write_text(pathlib.Path(MODEL).read_text().split("\n", 1)[1])
            with self.assertRaisesRegex(atria.Error, r"no format that is known; give VRML \(.wrl.* \.obj"):
                atria.mesh(headless)
            foreign = pathlib.Path(folder) / "Haus.SKP"
            foreign.write_text("x")
            with self.assertRaisesRegex(atria.Error, r"SketchUp's own format, .* export it there as COLLADA \(.dae\) or VRML"):
                atria.mesh(foreign)
            named = headless.rename(headless.with_suffix(".WRL"))
            self.assertIn("WallSouth_front", atria.mesh(named, 2, domain=BOX, layers=0).patches)

    def test_it_shows_itself(self):
        result = atria.mesh(MODEL, 2, domain=BOX, layers=0)
        elements = str(result.mesh.GetNumberOfCells())
        self.assertIn(elements, repr(result))
        table = xml.etree.ElementTree.fromstring(result._repr_html_())
        text = " ".join(table.itertext())
        for word in (elements, "not valid", "WallSouth_front", "left out"):
            self.assertIn(word, text)
        image = table.find(".//img")
        if shutil.which("xvfb-run") or os.environ.get("DISPLAY"):
            self.check_picture(base64.b64decode(image.get("src").split(",")[1]))
        display = os.environ.pop("DISPLAY", None)
        path = os.environ["PATH"]
        try:  # neither a display nor a substitute
            os.environ["PATH"] = ""
            again = atria.Result(result.mesh, result.patches, result.diagnostics, result.report)
            self.assertIsNone(xml.etree.ElementTree.fromstring(again._repr_html_()).find(".//img"))
        finally:
            os.environ["PATH"] = path
            if display is not None:
                os.environ["DISPLAY"] = display

    def check_picture(self, data):
        """It shows more than one shade of one color."""
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "picture.png"
            file.write_bytes(data)
            reader = vtkPNGReader()
            reader.SetFileName(str(file))
            reader.Update()
        pixels = reader.GetOutput().GetPointData().GetScalars()
        seen = {pixels.GetTuple(i) for i in range(0, pixels.GetNumberOfTuples(), 7)}
        self.assertGreater(len(seen), 50)

    def test_a_domain_is_a_polygon_by_its_corners(self):
        result = atria.mesh(MODEL, 4, domain=[(-60, -50), (90, -40), (20, 80)], layers=0)
        self.assertEqual([name for name in result.patches if name.startswith("domainSide")],
                         ["domainSide1", "domainSide2", "domainSide3"])
        self.assertEqual(result.mesh.GetBounds()[:4], (-60, 90, -50, 80))
        with self.assertRaisesRegex(ValueError, r"corners \(x, y\)"):
            atria.mesh(MODEL, 4, domain=[1, 2])

    def test_it_is_saved(self):
        result = atria.mesh(MODEL, 2, domain=BOX, layers=0)
        with tempfile.TemporaryDirectory() as folder:
            result.save(pathlib.Path(folder) / "mesh.vtu")
            result.save(pathlib.Path(folder) / "case")
            self.assertTrue((pathlib.Path(folder) / "mesh.vtu").stat().st_size > 0)
            self.assertIn("WallSouth_front", (pathlib.Path(folder) / "case/constant/polyMesh/boundary").read_text())
            self.assertRaises(atria.Error, result.save, pathlib.Path(folder) / "absent" / "mesh.vtu")

    def test_its_ending_says_what_is_saved(self):
        result = atria.mesh(MODEL, 2, domain=BOX, layers=0)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            result.save(folder / "mesh.msh")
            result.save(folder / "mesh.su2")
            self.assertTrue("WallSouth_front" in (folder / "mesh.su2").read_text())
            self.assertTrue("WallSouth-shadow" in (folder / "mesh.msh").read_text())
            (folder / "version.2").mkdir()
            for case in ("house.openfoam", "version.2"):
                result.save(folder / case)
                self.assertTrue((folder / case / "constant" / "polyMesh" / "faces").is_file())
            with self.assertRaisesRegex(ValueError, "ends in .stl; it must end in .vtu, .msh, .su2, .msh4, .inp"):
                result.save(folder / "mesh.stl")
            self.assertFalse((folder / "mesh.stl").exists())


class Package(unittest.TestCase):
    def test_version_and_metadata(self):
        self.assertEqual(atria.__version__, VERSION)
        self.assertEqual(importlib.metadata.version("atria"), VERSION)

    def test_stubs_have_all_names_and_methods(self):
        stub = ast.parse(pathlib.Path(atria.__file__).with_suffix(".pyi").read_text())
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        imported = {alias.asname for node in stub.body if isinstance(node, ast.ImportFrom) for alias in node.names}
        for name in atria.__all__:
            self.assertIn(name, imported | set(classes))
        for name, node in classes.items():
            methods = {child.name for child in node.body if isinstance(child, ast.FunctionDef)}
            wrapped = getattr(atria, name, None)
            if wrapped is None or inspect.ismodule(wrapped):
                continue
            wrapped = next(base for base in wrapped.__mro__ if base.__module__ != "atria")
            own = {method for method in vars(wrapped) if method.startswith(("Set", "Get", "Add"))}
            self.assertEqual(own - methods, set(), name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
