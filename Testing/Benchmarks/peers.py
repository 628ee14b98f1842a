# SPDX-License-Identifier: GPL-3.0-or-later
"""The same work for other meshers: cases for OpenFOAM's snappyHexMesh, and gmsh's scripts.

Where a peer cannot be given exactly what Atria gets, it is given what takes it less time: snappyHexMesh's layer may end
where it does not fit and is not grown on the ground, and the exact sphere, not the faceted one, is gmsh's.
"""

import os
import pathlib
import shutil
import subprocess

from snappy_dictionaries import begin, block_mesh, controls, fans, stl, words, write, write_feature_extraction

FOAM = {
    "WM_PROJECT_DIR": os.environ.get("WM_PROJECT_DIR", "/usr/share/openfoam"),
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}

SIDES = "sides { type patch; faces ((0 3 2 1) (4 5 6 7) (0 1 5 4) (3 7 6 2) (0 4 7 3) (1 2 6 5)); }"
SNAPPY = """
castellatedMesh true; snap true; addLayers {layered};
geometry {{ model.stl {{ type triSurfaceMesh; name model; }} near {{ type searchableBox; min ({low}); max ({high}); }} }}
castellatedMeshControls
{{
  maxLocalCells 200000000; maxGlobalCells 200000000; minRefinementCells 0; maxLoadUnbalance 0.1;
  nCellsBetweenLevels 1; features ({features});
  refinementSurfaces {{ model {{ level ({surface} {fine}); }} }}
  resolveFeatureAngle 30; refinementRegions {{ {regions} }}
  locationInMesh ({inside}); allowFreeStandingZoneFaces false;
}}
"""


def available():
    return {"snappyHexMesh": bool(shutil.which("snappyHexMesh")), "gmsh": bool(shutil.which("gmsh"))}


def checked(case):
    """Names of checkMesh's checks that a case fails."""
    run = subprocess.run(["checkMesh", "-case", case, "-allGeometry", "-allTopology", "-constant"], env=os.environ | FOAM,
                         capture_output=True, text=True)
    if "Mesh OK" in run.stdout:
        return []
    return [line.strip(" *").split(",")[0][:60] for line in run.stdout.splitlines() if line.startswith(" ***")] or ["not read"]


def snappy_case(folder: pathlib.Path, case, threads):
    """Makes the case, and returns the commands whose time counts."""
    levels = case.levels
    base = case.sizes[2] * 2 ** levels[2]
    cells = [round((high - low) / base) for low, high in case.box]
    begin(folder)
    (folder / "constant" / "triSurface" / "model.stl").write_text(stl("model", fans(case.polygons)))
    write(folder, "blockMeshDict", block_mesh(case.box, cells, SIDES))
    # A cell is refined for the sides where its center is near: in steps, each with the centers of its level.
    steps = [f"({1.05 * 0.5 * case.sizes[2] * 2 ** (levels[2] - n + 1):g} {n})" for n in range(levels[0], 0, -1)]
    near = case.near or case.box
    write(folder, "snappyHexMeshDict", SNAPPY.format(
        low=words([c[0] for c in near]), high=words([c[1] for c in near]), inside=words(case.inside),
        features='{ file "model.eMesh"; level %d; }' % levels[1] if case.creases else "",
        regions=f"near {{ mode distance; levels ({' '.join(steps)}); }}" if case.near else "",
        layered="true" if case.layers else "false", surface=levels[0], fine=levels[1])
        + controls(case.creases, case.walls, case.layers))
    if case.creases:
        write_feature_extraction(folder, ["model"])
        subprocess.run(["surfaceFeatureExtract"], cwd=folder, env=os.environ | FOAM, check=True, capture_output=True)
    parallel = []
    if threads > 1:
        write(folder, "decomposeParDict", f"numberOfSubdomains {threads}; method simple; "
              f"simpleCoeffs {{ n ({threads} 1 1); delta 0.001; }}\n")
        subprocess.run(["blockMesh"], cwd=folder, env=os.environ | FOAM, check=True, capture_output=True)
        subprocess.run(["decomposePar"], cwd=folder, env=os.environ | FOAM, check=True, capture_output=True)
        parallel = ["mpirun", "--oversubscribe", "-np", str(threads)]
    return [*parallel, "snappyHexMesh", "-overwrite", *(["-parallel"] if parallel else [])]


def gmsh_script(case, threads):
    """Meshes and writes nothing."""
    size = case.sizes[2]
    low = [c[0] for c in case.box]
    extent = [c[1] - c[0] for c in case.box]
    lines = ['SetFactory("OpenCASCADE");', f"General.NumThreads = {threads};", "Mesh.Algorithm3D = 10;",
             "Mesh.Optimize = 0;", f"Box(1) = {{{', '.join(map(repr, low + extent))}}};"]
    if case.sphere:
        lines += [f"Sphere(2) = {{0, 0, 0, {case.sphere}}};",
                  "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };"]
    else:
        lines += sheets_of(case.polygons) + ["BooleanFragments{ Volume{1}; Delete; }{ Surface{1001:%d}; Delete; }"
                                             % (1000 + len(case.polygons))]
    lines += [f"Mesh.MeshSizeMin = {size};", f"Mesh.MeshSizeMax = {case.sizes[0]};"]
    if case.sizes[0] > size:
        near = case.sizes[1]
        lines += [
            "s() = Surface{:};" if case.sphere else "s() = Surface In BoundingBox {-1e3, -1e3, -1, 1e3, 1e3, 20};",
            "Field[1] = Distance; Field[1].SurfacesList = {s()}; Field[1].NumPointsPerCurve = 50;",
            f"Field[2] = Threshold; Field[2].InField = 1; Field[2].DistMin = {near};",
            f"Field[2].SizeMin = {near}; Field[2].DistMax = {2 * case.sizes[0]}; Field[2].SizeMax = {case.sizes[0]};",
            "Background Field = 2; Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;",
        ]
    return "\n".join([*lines, "Mesh 3;", 'Printf("elements %g", Mesh.NbTetrahedra);', ""])


def sheets_of(polygons):
    """Plane surfaces 1001 and on."""
    lines, n = [], 1000
    for i, polygon in enumerate(polygons):
        first = n
        for p in polygon:
            n += 1
            lines.append(f"Point({n}) = {{{', '.join(map(repr, p))}}};")
        for j in range(len(polygon)):
            lines.append(f"Line({first + j + 1}) = {{{first + j + 1}, {first + (j + 1) % len(polygon) + 1}}};")
        lines.append(f"Curve Loop({1001 + i}) = {{{first + 1}:{n}}};\nPlane Surface({1001 + i}) = {{{1001 + i}}};")
    return lines
