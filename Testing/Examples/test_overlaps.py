# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that lie upon each other: who keeps its faces, and who says so.

Usage: test_overlaps.py ATRIA FOLDER_OF_MODELS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

ATRIA = pathlib.Path(sys.argv[1])
MODELS = pathlib.Path(sys.argv[2])


def reordered(text):
    """The objects of an OBJ file from the last to the first; corners are numbered anew."""
    parts, points = [], 0
    for part in text.split("o ")[1:]:
        name, *lines = part.splitlines()
        vertices = [line for line in lines if line.startswith("v ")]
        faces = [[int(corner) - points for corner in line.split()[1:]] for line in lines if line.startswith("f ")]
        points += len(vertices)
        parts.append((name, vertices, faces))
    out, points = [], 0
    for name, vertices, faces in reversed(parts):
        out += [f"o {name}", *vertices, *("f " + " ".join(str(corner + points) for corner in face) for face in faces)]
        points += len(vertices)
    return "\n".join(out) + "\n"


class Overlaps(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def both_orders(self, name):
        text = (MODELS / name).read_text()
        for label, content in (("as_drawn", text), ("reversed", reordered(text))):
            model = self.folder / f"{label}.obj"
            model.write_text(content)
            yield model

    def mesh(self, model, *options):
        report = self.folder / "report.json"
        run = subprocess.run([ATRIA, "mesh", model, "-o", self.folder / "mesh.vtu", "--report", report, *options],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads(report.read_text()), run

    def inspect(self, model):
        run = subprocess.run([ATRIA, "inspect", model, "--json"], capture_output=True, text=True, check=True)
        return json.loads(run.stdout)

    def check_areas(self, report, wanted):
        found = {patch["name"]: patch["area"] for patch in report["patches"]}
        for name, area in wanted.items():
            self.assertIn(name, found)
            self.assertAlmostEqual(found[name] / area, 1, delta=0.005, msg=name)

    def test_openings_on_an_uncut_wall(self):
        for model in self.both_orders("window_on_uncut_wall.obj"):
            report, _ = self.mesh(model, "--model-bounds", "--size-min", "0.25")
            self.check_areas(report, {"Room": 92, "Inlet": 1, "Outlet": 1})
            overlaps = [p for p in self.inspect(model)["problems"] if p["kind"] == "overlaps"]
            self.assertEqual({tuple(p["surfaces"]): round(p["size"], 6) for p in overlaps},
                             {("Inlet", "Room"): 1, ("Outlet", "Room"): 1})

    def test_a_pane_as_large_as_the_wall_it_covers(self):
        for model in self.both_orders("glass_on_building.obj"):
            report, _ = self.mesh(model)
            self.check_areas(report, {"Glass": 60})
            found = self.inspect(model)
            self.assertEqual({s["name"]: round(s["area"], 6) for s in found["surfaces"]}, {"Building": 316, "Glass": 60})
            self.assertTrue(any("'Building' coincide" in note and "60 square meters with 'Glass'" in note
                                for note in found["notes"]), found["notes"])

    def test_a_face_zone_that_is_as_large_as_its_wall_leaves_it_closed(self):
        for model in self.both_orders("glass_on_building.obj"):
            report, run = self.mesh(model, "--face-zone", "Glass")
            self.assertNotIn("Glass", {patch["name"] for patch in report["patches"]})
            self.assertIn("the face zone 'Glass' lies on the wall 'Building' in 60 square meters", run.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
