# SPDX-License-Identifier: GPL-3.0-or-later
"""Save Data writes the mesher's mesh with the names of its patches, which nobody has to choose. Needs no display."""

import os
import pathlib
import re
import shutil

from paraview import simple
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

from house_pipeline import house

FOLDER = pathlib.Path(os.environ["ATRIA_OUTPUT"]) / "save"
LOST = "names of the patches are lost"


def save(source, name, **options):
    """Writes a case; its files, and what VTK said meanwhile."""
    target = FOLDER / f"{name}.openfoam"
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    try:
        simple.SaveData(str(target), proxy=source, **options)
    finally:
        vtkOutputWindow.SetInstance(before)
    assert (target / "constant").exists(), window.GetOutput()
    files = {file.name: file.read_bytes() for file in (target / "constant" / "polyMesh").iterdir()}
    return files, window.GetOutput()


def names(files):
    return re.findall(r"^    (\w+)\n    \{", files["boundary"].decode(), re.MULTILINE)


def faces(files):
    """The number of boundary faces."""
    return sum(int(count) for count in re.findall(r"nFaces\s+(\d+);", files["boundary"].decode()))


def check_lost(source, name):
    """Where cells were changed the boundary is one patch, and a warning says so."""
    files, said = save(source, name)
    assert names(files) == ["defaultFaces"], names(files)
    assert faces(files) > 100
    assert LOST in said, said


def check_formats(mesher):
    """Every kind of file that Save Data offers for a mesh has the patches."""
    for file, name in (("mesh.msh", b" wall WallSouth)"), ("mesh.msh", b" wall WallSouth-shadow)"),
                       ("mesh.su2", b"MARKER_TAG= WallSouth_back"), ("mesh.cgns", b"WallSouth_back"),
                       ("wind.windcase/0/U", b"zGround"), ("wind.windcase/case.json", b"WallSouth_back"),
                       ("wind.windcase/constant/polyMesh/boundary", b"WallSouth_back")):
        target = FOLDER / file.partition("/")[0]
        if not target.exists():
            simple.SaveData(str(target), proxy=mesher)
        assert name in (FOLDER / file).read_bytes(), (file, name)


def check_openings(mesher, patches):
    """Openings are seen among the patches, and are saved as face zones that part rooms."""
    mesher.FindOpenings = 1
    patches.UpdatePipeline()
    shown = mesher.GetClientSideObject().GetOutputDataObject(1)
    seen = {shown.GetMetaData(i).Get(shown.NAME()) for i in range(shown.GetNumberOfPartitionedDataSets())}
    files, said = save(mesher, "rooms")
    assert said == "", said
    for opening in ("WallSouth_opening_1", "PartitionA_opening_1"):
        assert opening in seen, seen
        assert opening.encode() in files["faceZones"], opening
    assert {b"room_1", b"outside"} <= set(files["cellZones"].split()), files["cellZones"][:400]


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    pipeline = house()
    given, said = save(pipeline.mesher, "given", Patches=pipeline.patches)
    assert said == "", said
    assert {"WallSouth_front", "WallSouth_back", "Neighbor", "xMin", "zMax"} <= set(names(given)), names(given)
    assert "defaultFaces" not in names(given)

    alone, said = save(pipeline.mesher, "alone")
    assert said == "", said
    assert alone == given, f"patches {names(alone)}, with the patches chosen {names(given)}"

    # Filters that leave the cells as they are.
    measured, said = save(pipeline.quality, "measured")
    assert (measured, said) == (given, ""), said

    file = FOLDER / "house.vtu"
    simple.SaveData(str(file), proxy=pipeline.mesher)
    read, said = save(simple.OpenDataFile(str(file)), "read")
    assert (read, said) == (given, ""), f"{said} patches {names(read)}"

    threshold = simple.Threshold(Input=pipeline.mesher, Scalars=["CELLS", "Level"], LowerThreshold=0, UpperThreshold=4)
    check_lost(threshold, "threshold")
    crinkled = simple.Clip(Input=pipeline.mesher, Crinkleclip=1)
    crinkled.ClipType.Origin, crinkled.ClipType.Normal = [12.3, 7.1, 5.0], [0.0, 1.0, 0.0]
    check_lost(crinkled, "crinkled")
    # Of hexahedra alone: where there are polyhedra, too, ParaView's clip makes wedges of four points.
    clip = simple.Clip(Input=threshold, Invert=0)
    clip.ClipType.Origin, clip.ClipType.Normal = [0.0, 0.0, 40.0], [0.0, 0.0, 1.0]
    check_lost(clip, "clip")
    check_formats(pipeline.mesher)
    check_openings(pipeline.mesher, pipeline.patches)
    print(f"{len(names(given))} patches, {faces(given)} faces")


main()
