# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the meshes of docs/gallery.md and draws its pictures.

Usage: xvfb-run pvpython gallery.py ATRIA SOURCE OUTPUT [NAME...]    ATRIA is the command line, SOURCE the repository
"""

import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from paraview import simple

from draw import behind, color_by, new_view, patches_in, save, show

ATRIA, SOURCE, OUTPUT = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), pathlib.Path(sys.argv[3])
PALE = [0.90, 0.93, 0.96]
SIDES = ("xMin", "xMax", "yMin", "yMax", "zMax")
COLORS = {"Floor": [0.87, 0.72, 0.53], "Site": [0.80, 0.86, 0.72], "Wall": [0.95, 0.92, 0.87], "Roof": [0.80, 0.50, 0.42],
          "Gable": [0.85, 0.70, 0.55], "Partition": [0.69, 0.77, 0.87], "Neighbor": [0.86, 0.86, 0.86], "zMin": [0.80, 0.86, 0.72]}


def mesh(model, *options):
    """Mesh and patches of a model, in files."""
    folder = pathlib.Path(tempfile.mkdtemp())
    file = SOURCE / "Examples" / "Data" / model
    run = subprocess.run([ATRIA, "mesh", file, "-o", folder / "mesh.vtu", "--patches", folder / "patches.vtpc", "--report",
                          folder / "report.json", *options], capture_output=True, text=True, check=False)
    if run.returncode:
        sys.exit(f"{model}: {run.stderr}")
    counts = json.loads((folder / "report.json").read_text())["counts"]
    print(f"{model}: {counts['elements']} elements")
    return simple.XMLUnstructuredGridReader(FileName=[str(folder / "mesh.vtu")]), folder


def draw_patches(folder, view, without=()):
    """Patches in colors that go by the beginning of their names; the ground, too, but without its edges."""
    for name, patch in patches_in(folder / "patches.vtpc"):
        color = next((color for start, color in COLORS.items() if name.startswith(start)), [0.9, 0.88, 0.84])
        if not name.startswith((*SIDES, *without)):
            show(patch, view, color, edges=name not in ("Site", "zMin"))


def box_of(source):
    """Middle and width."""
    source.UpdatePipeline()
    bounds = source.GetDataInformation().GetBounds()
    return [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)], bounds[1] - bounds[0]


def patches():
    """Every surface of the model is a patch by its name."""
    _, folder = mesh("house.wrl", "--size-min", "0.5", "--size-mid", "0.5", "--size-max", "4", "--layers", "0")
    view = new_view((-20.0, -42.0, 24.0), (18.0, 7.0, 3.0))
    draw_patches(folder, view)
    return view


def slice_through():
    """Indoors and outdoors in one mesh, seen from above: both are connected by doors and windows."""
    grid, _ = mesh("house.wrl", "--size-min", "0.5", "--size-mid", "0.5", "--size-max", "4")
    view = new_view((14.0, 2.0, 52.0), (14.0, 7.0, 1.6))
    cut = simple.Slice(Input=grid, Crinkleslice=1)
    cut.SliceType.Origin, cut.SliceType.Normal = [14.0, 7.0, 1.6], [0.0, 0.0, 1.0]
    color_by(show(cut, view, edges=True), view, "CELLS", "Volume", "volume, m³", limits=(0.01, 10.0), preset="Viridis (matplotlib)")
    colors = simple.GetColorTransferFunction("Volume")
    colors.MapControlPointsToLogSpace()
    colors.UseLogScale = 1
    return view


def turned():
    """Walls that stand across the grid are kept sharp."""
    _, folder = mesh("house_turned17.wrl", "--size-min", "0.5", "--size-mid", "0.5", "--size-max", "4", "--layers", "0")
    view = new_view((-12.0, -30.0, 20.0), (12.0, 7.0, 3.0))
    draw_patches(folder, view, without=["RoofSouth", "WallSouth"])
    return view


def layers():
    """Five layers on a curved surface."""
    grid, _ = mesh("sphere_in_cube.wrl", "--model-bounds", "--size-min", "0.1", "--size-mid", "0.1", "--size-max", "0.8",
                   "--layers", "Sphere=5:0.01:1.3")
    middle, size = box_of(grid)
    top = middle[2] + 0.21 * size
    view = new_view((middle[0] - 0.02 * size, middle[1] - 0.2 * size, top + 0.02 * size), (middle[0], middle[1], top))
    show(behind(grid, middle, (0.0, -1.0, 0.0)), view, PALE, edges=True)
    return view


def sphere():
    """A curved surface: refined where it turns by more than 10 degrees in an element."""
    grid, _ = mesh("sphere_in_cube.wrl", "--model-bounds", "--size-min", "0.05", "--size-mid", "0.1", "--size-max", "0.4",
                   "--curvature-angle", "10")
    middle, size = box_of(grid)
    view = new_view((middle[0] - 0.5 * size, middle[1] - 1.8 * size, middle[2] + 0.3 * size), middle)
    show(behind(grid, middle, (0.0, -1.0, 0.0)), view, PALE, edges=True)
    return view


def building():
    """Floors, rooms and windows of a building."""
    _, folder = mesh("building.wrl", "--size-min", "0.5", "--size-mid", "1", "--size-max", "8", "--layers", "0")
    view = new_view((-18.0, -38.0, 22.0), (16.0, 8.0, 3.0))
    draw_patches(folder, view)
    return view


def worst():
    """The hundred worst elements of a house, found and shown by their non-orthogonality."""
    _, folder = mesh("house.wrl", "--size-min", "0.5", "--size-mid", "1", "--size-max", "8")
    subprocess.run([ATRIA, "quality", folder / "mesh.vtu", "--worst", "100", "--metric", "NonOrthogonality", "-o",
                    folder / "worst.vtu"], stdout=subprocess.DEVNULL, check=False)
    view = new_view((-14.0, -34.0, 23.0), (15.0, 7.0, 4.0))
    for name, patch in patches_in(folder / "patches.vtpc"):
        if name.startswith(("Wall", "Roof", "Gable", "Partition")) and not name.endswith("_back"):
            show(patch, view, [0.75, 0.75, 0.78], opacity=0.25)
    grid = simple.XMLUnstructuredGridReader(FileName=[str(folder / "worst.vtu")])
    color_by(show(grid, view, edges=True), view, "CELLS", "NonOrthogonality", "degrees", preset="Inferno (matplotlib)")
    return view


def audit():
    """Where each surface is farthest from its faces, in elements."""
    _, folder = mesh("house.wrl", "--size-min", "0.5", "--size-mid", "1", "--size-max", "8")
    view = new_view((-14.0, -34.0, 23.0), (15.0, 7.0, 4.0))
    for name, patch in patches_in(folder / "patches.vtpc"):
        if name.startswith(("Wall", "Roof", "Gable", "Partition")) and not name.endswith("_back"):
            show(patch, view, [0.75, 0.75, 0.78], opacity=0.25)
    surfaces = json.loads((folder / "report.json").read_text())["audit"]["surfaces"]
    places = [max((surface["faces_from_model"], surface["model_from_faces"]), key=lambda place: place["in_elements"])
              for surface in surfaces]
    places = [place for place in places if place["in_elements"] > 1e-3]
    table = folder / "places.csv"
    table.write_text("x,y,z,elements\n" + "".join(
        ",".join(map(repr, (*place["place"], place["in_elements"]))) + "\n" for place in places))
    points = simple.TableToPoints(Input=simple.CSVReader(FileName=[str(table)]), XColumn="x", YColumn="y", ZColumn="z")
    balls = simple.Glyph(Input=points, GlyphType="Sphere", GlyphMode="All Points", ScaleArray=["POINTS", "No scale array"],
                         ScaleFactor=0.6)
    color_by(show(balls, view), view, "POINTS", "elements", "elements", (0.0, 0.5), preset="Viridis (matplotlib)")
    return view


PICTURES = {"patches": patches, "indoors": slice_through, "turned": turned, "layers": layers, "sphere": sphere,
            "building": building, "worst": worst, "audit": audit}


def main():
    OUTPUT.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[4:] or PICTURES:
        save(PICTURES[name](), OUTPUT / f"gallery-{name}.png")


main()
