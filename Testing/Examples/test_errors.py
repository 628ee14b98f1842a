# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of Atria's classes end a script: they are exceptions, and no value of a property is taken for another.

Usage: test_errors.py MODEL.wrl [INTERPRETER]
"""

import inspect
import math
import pathlib
import subprocess
import sys
import tempfile
import textwrap
import unittest

from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkIOGeometry import vtkSTLWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridWriter

import atria
from weather_year import epw

MODEL = sys.argv[1]
INTERPRETER = sys.argv[2] if len(sys.argv) > 2 else sys.executable
FOLDER = tempfile.TemporaryDirectory()


def script(text):
    """Runs a script of its own."""
    file = pathlib.Path(FOLDER.name) / "script.py"
    file.write_text(textwrap.dedent(text))
    return subprocess.run([INTERPRETER, file, MODEL], capture_output=True, text=True, check=False)


def classes():
    """Those that can be made."""
    found = [cls for name, cls in vars(atria).items() if name.startswith("vtkAtria") and not inspect.ismodule(cls)]
    return [cls for cls in found if not any(other is not cls and issubclass(other, cls) for other in found)]


def of_a_sphere(cls):
    """The mesher, or what takes the same."""
    sphere = vtkSphereSource()
    grid = cls()
    grid.SetInputConnection(sphere.GetOutputPort())
    grid.SetDomainMode(cls.Explicit)
    grid.SetDomainBounds(-5, 5, -5, 5, -5, 5)
    for setter in (grid.SetSizeMax, grid.SetSizeMid, grid.SetSizeMin):
        setter(1.0)
    return grid


def mesher_of_a_sphere():
    return of_a_sphere(atria.vtkAtriaDualMesher)


def runnable(cls):
    """An instance with a sound input."""
    if issubclass(cls, atria.vtkAtriaGridAlgorithm):
        return of_a_sphere(cls)
    instance = cls()
    if cls is atria.vtkAtriaModelReader:
        instance.SetFileName(str(pathlib.Path(FOLDER.name) / "model.stl"))
        return instance
    if cls is atria.vtkAtriaWeatherReader:
        instance.SetFileName(str(pathlib.Path(FOLDER.name) / "year.epw"))
        return instance
    if issubclass(cls, atria.vtkAtriaMeshWriter):
        set_target = instance.SetCaseDirectory if hasattr(instance, "SetCaseDirectory") else instance.SetFileName
        set_target(str(pathlib.Path(FOLDER.name) / cls.__name__))
    elif hasattr(instance, "SetFileName"):
        instance.SetFileName(MODEL)
        return instance
    worst = cls is atria.vtkAtriaWorstElements
    source = runnable(atria.vtkAtriaMeshQuality) if worst else mesher_of_a_sphere()
    instance.SetInputConnection(source.GetOutputPort())
    return instance


class Scripts(unittest.TestCase):
    """A user's script that does not look for errors."""

    def fails(self, text, *messages):
        run = script(text)
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertIn("Traceback", run.stderr)
        self.assertIn("atria.Error: ", run.stderr)
        self.assertNotIn("went on", run.stdout)
        for message in messages:
            self.assertEqual(run.stderr.count(message), 1, run.stderr)
        self.assertNotIn("ERR|", run.stderr)

    def test_a_bad_size(self):
        self.fails("""
            import sys, atria
            reader = atria.vtkAtriaVRMLReader()
            reader.SetFileName(sys.argv[1])
            mesher = atria.vtkAtriaDualMesher()
            mesher.SetInputConnection(reader.GetOutputPort())
            mesher.SetSizeMin(-5)
            mesher.Update()
            print("went on")
            """, "vtkAtriaDualMesher: SizeMin is -5; it must be a number of at least 0")

    def test_a_missing_file(self):
        for run in ("reader.Update()", "mesher.Update()", "mesher.UpdateWholeExtent()", "writer.Write()"):
            self.fails(f"""
                import atria
                reader = atria.vtkAtriaVRMLReader()
                reader.SetFileName("absent.wrl")
                mesher = atria.vtkAtriaDualMesher()
                mesher.SetInputConnection(reader.GetOutputPort())
                writer = atria.vtkAtriaOpenFOAMWriter()
                writer.SetInputConnection(mesher.GetOutputPort())
                writer.SetCaseDirectory("absent")
                {run}
                print("went on")
                """, "'absent.wrl' does not exist")

    def test_a_missing_file_behind_a_writer_of_vtk(self):
        self.fails("""
            import atria
            from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
            reader = atria.vtkAtriaVRMLReader()
            reader.SetFileName("absent.wrl")
            writer = vtkXMLPolyDataWriter()
            writer.SetInputConnection(reader.GetOutputPort())
            writer.SetFileName("/dev/null")
            with atria.raising(writer):
                writer.Write()
            print("went on")
            """, "'absent.wrl' does not exist")

    def test_no_input(self):
        self.fails("""
            import atria
            atria.vtkAtriaMeshQuality().Update()
            """, "Input port 0")

    def test_a_sound_script_says_nothing(self):
        run = script("""
            import sys, atria
            reader = atria.vtkAtriaVRMLReader()
            reader.SetFileName(sys.argv[1])
            reader.Update()
            print(reader.GetOutput().GetNumberOfCells())
            """)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertGreater(int(run.stdout), 50)


class Errors(unittest.TestCase):
    def test_errors_of_what_feeds_a_filter_are_raised(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName("absent.vtp")
        mesher = atria.vtkAtriaDualMesher()
        mesher.SetInputConnection(reader.GetOutputPort())
        self.assertRaisesRegex(atria.Error, "absent.vtp", mesher.Update)

    def test_a_failed_update_fails_again_until_its_cause_is_gone(self):
        mesher = mesher_of_a_sphere()
        mesher.SetSizeMin(math.nan)
        for _ in range(2):
            self.assertRaisesRegex(atria.Error, "SizeMin is nan", mesher.Update)
        mesher.SetSizeMin(1.0)
        mesher.Update()
        self.assertGreater(mesher.GetOutputDataObject(0).GetNumberOfCells(), 500)

        reader = atria.vtkAtriaVRMLReader()
        reader.SetFileName("absent.wrl")
        mesher.SetInputConnection(reader.GetOutputPort())
        for _ in range(2):
            self.assertRaisesRegex(atria.Error, "absent.wrl", mesher.Update)
        reader.SetFileName(MODEL)
        mesher.SetDomainMode(mesher.Site)
        mesher.Update()

    def test_an_estimate_fails_as_the_run_would(self):
        source = of_a_sphere(atria.vtkAtriaOctreeSource)
        self.assertTrue(source.Estimate())
        source.SetSizeMin(-1.0)
        self.assertRaisesRegex(atria.Error, "SizeMin is -1", source.Estimate)

    def test_errors_of_setters_are_raised(self):
        self.assertRaisesRegex(atria.Error, "no seed -1", atria.vtkAtriaDualMesher().SetSeed, -1, 0, 0, 0)
        self.assertRaisesRegex(atria.Error, "no refinement box 3", atria.vtkAtriaDualMesher().GetRefinementBox, 3, [0.0] * 7)

    def test_observers_of_the_user_are_told_too(self):
        told = []
        reader = atria.vtkAtriaVRMLReader()
        reader.AddObserver("ErrorEvent", lambda caller, event: told.append(caller))
        self.assertRaises(atria.Error, reader.Update)
        self.assertEqual(told, [reader])

    def test_names_that_are_not_utf8(self):
        reader = atria.vtkAtriaVRMLReader()
        reader.SetFileName(b"absent\xe4.wrl")
        self.assertRaisesRegex(atria.Error, "vtkAtriaVRMLReader: .*UTF-8", reader.Update)

    def test_classes_are_what_they_were(self):
        for cls in classes():
            instance = cls()
            self.assertEqual(instance.GetClassName(), cls.__name__)
            self.assertIs(type(instance), cls)
        self.assertIsInstance(atria.vtkAtriaVRMLReader(), atria.vtkAtriaSurfaceReader)
        self.assertIsInstance(atria.vtkAtriaDualMesher(), atria.vtkAtriaGridAlgorithm)
        self.assertIn(".obj", atria.vtkAtriaModelReader.GetFileExtensions())
        self.assertTrue(atria.vtkAtriaVRMLReader.CanReadFile(MODEL))
        self.assertIn("SizeMin", atria.vtkAtriaDualMesher.SetSizeMin.__doc__)
        writer = vtkXMLUnstructuredGridWriter()
        mesher = mesher_of_a_sphere()
        writer.SetInputConnection(mesher.GetOutputPort())
        self.assertIs(writer.GetInputAlgorithm(0, 0), mesher)


class Ranges(unittest.TestCase):
    def test_a_value_outside_of_its_range_is_an_error_that_names_it(self):
        """Of every property of every class that has a range."""
        stl = vtkSTLWriter()
        sphere = vtkSphereSource()
        stl.SetInputConnection(sphere.GetOutputPort())
        stl.SetFileName(str(pathlib.Path(FOLDER.name) / "model.stl"))
        stl.Write()
        year = epw(lambda number: 20.0, lambda number: number % 12 * 30, lambda number: 3.0)
        (pathlib.Path(FOLDER.name) / "year.epw").write_text(year)
        checked = 0
        for cls in classes():
            runnable(cls).Update()
            for name in (method[3:-8] for method in dir(cls) if method.startswith("Get") and method.endswith("MinValue")):
                instance = runnable(cls)
                get, put = getattr(instance, "Get" + name), getattr(instance, "Set" + name)
                least, most = (getattr(instance, f"Get{name}{end}Value")() for end in ("Min", "Max"))
                sound = get()
                wrong = [math.nan, math.inf, -math.inf] if isinstance(sound, float) else []
                wrong += [least - 1] if least > -1e30 else []
                wrong += [most + 1] if most < 2**31 - 1 else []
                for value in wrong:
                    put(value)
                    with self.assertRaisesRegex(atria.Error, rf"{name} is \S+; it must be a number", msg=f"{cls} {value}"):
                        instance.Update()
                checked += 1
        self.assertGreater(checked, 60)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
