# SPDX-License-Identifier: GPL-3.0-or-later
"""The same building for OpenFOAM's snappyHexMesh: sheets as baffles, openings as face zones, the same sizes."""

import itertools
import math
import os

import make_building

HEADER = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"

SNAPPY = """
castellatedMesh true; snap true; addLayers false;
geometry
{{
{geometry}
  ground {{ type searchableBox; min ({ground_low}); max ({ground_high}); }}
}}
castellatedMeshControls
{{
  maxLocalCells 200000000; maxGlobalCells 200000000; minRefinementCells 0; maxLoadUnbalance 0.1;
  nCellsBetweenLevels 1; features ({features});
  refinementSurfaces
  {{
{surfaces}
  }}
  resolveFeatureAngle 30; refinementRegions {{ ground {{ mode inside; levels ((1e15 {level})); }} }}
  locationInMesh ({inside}); allowFreeStandingZoneFaces true;
}}
snapControls
{{
  nSmoothPatch 3; tolerance 2.0; nSolveIter 30; nRelaxIter 5;
  nFeatureSnapIter 10; implicitFeatureSnap false; explicitFeatureSnap true; multiRegionFeatureSnap true;
}}
addLayersControls
{{
  relativeSizes true; layers {{}} expansionRatio 1; finalLayerThickness 0.3; minThickness 0.1; nGrow 0;
  featureAngle 60; nRelaxIter 3; nSmoothSurfaceNormals 1; nSmoothNormals 3; nSmoothThickness 10;
  maxFaceThicknessRatio 0.5; maxThicknessToMedialRatio 0.3; minMedianAxisAngle 90; nBufferCellsNoExtrude 0; nLayerIter 50;
}}
meshQualityControls
{{
  maxNonOrtho 65; maxBoundarySkewness 20; maxInternalSkewness 4; maxConcave 80; minVol 1e-13; minTetQuality 1e-15;
  minArea -1; minTwist 0.02; minDeterminant 0.001; minFaceWeight 0.05; minVolRatio 0.01; minTriangleTwist -1;
  nSmoothScale 4; errorReduction 0.75;
}}
writeFlags (); mergeTolerance 1e-6;
"""


def words(point):
    return " ".join(f"{c:.17g}" for c in point)


def stl(name, polygons):
    triangles = [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]
    facets = "\n".join(
        "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {words(p)}\n" for p in t) + "endloop\nendfacet"
        for t in triangles
    )
    return f"solid {name}\n{facets}\nendsolid {name}\n"


def block_mesh(box, cells):
    corners = [(box[0][i], box[1][j], box[2][k]) for k, j, i in itertools.product((0, 1), (0, 1), (0, 1))]
    order = [corners[i] for i in (0, 1, 3, 2, 4, 5, 7, 6)]
    sides = {"Site": "(0 3 2 1)", "zMax": "(4 5 6 7)", "yMin": "(0 1 5 4)", "yMax": "(3 7 6 2)", "xMin": "(0 4 7 3)",
             "xMax": "(1 2 6 5)"}
    patches = "".join(
        f"{name} {{ type {'wall' if name == 'Site' else 'patch'}; faces ({face}); }}\n" for name, face in sides.items()
    )
    return (
        f"vertices ({' '.join(f'({words(p)})' for p in order)});\n"
        f"blocks (hex (0 1 2 3 4 5 6 7) ({words(cells)}) simpleGrading (1 1 1));\nboundary (\n{patches});\n"
    )


def write_case(folder, finest, far, site):
    """Returns the commands by their names."""
    (folder / "system").mkdir(parents=True)
    (folder / "constant" / "triSurface").mkdir(parents=True)
    (x0, y0, _), _, (x1, y1, _), _ = make_building.site(*site)[0]
    box = ((x0, x1), (y0, y1), (0.0, 0.3 * max(site)))
    level = round(math.log2(far / finest))
    walls = {name: polygons for name, (polygons, _) in make_building.sheets().items()}
    walls["Neighbor"] = make_building.neighbor()
    openings = make_building.openings()
    for name, polygons in (walls | openings).items():
        (folder / "constant" / "triSurface" / f"{name}.stl").write_text(stl(name, polygons))

    def write(name, text):
        (folder / "system" / name).write_text(HEADER.format(name) + text)

    write("controlDict", "application x; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;\n"
          "writeControl timeStep; writeInterval 1; writeFormat binary; writePrecision 8;\n")
    write("fvSchemes", "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {}\n")
    write("fvSolution", "solvers {}\n")
    write("blockMeshDict", block_mesh(box, [max(1, round((high - low) / far)) for low, high in box]))
    write("surfaceFeatureExtractDict", "".join(
        f"{name}.stl {{ extractionMethod extractFromSurface; writeObj no; extractFromSurfaceCoeffs {{ includedAngle 150; }} "
        "subsetFeatures { nonManifoldEdges yes; openEdges yes; } }\n" for name in walls))
    zones = {name: f"faceZone {name}; faceType internal;" for name in openings}
    write("snappyHexMeshDict", SNAPPY.format(
        geometry="\n".join(f"  {name}.stl {{ type triSurfaceMesh; name {name}; }}" for name in walls | openings),
        features=" ".join(f'{{ file "{name}.eMesh"; level {level}; }}' for name in walls),
        surfaces="\n".join(f"    {name} {{ level ({level} {level}); {zones.get(name, 'patchInfo { type wall; }')} }}"
                           for name in walls | openings),
        ground_low=words((x0, y0, 0.0)), ground_high=words((x1, y1, finest)), level=level,
        inside=words((x0 + 1.1, y0 + 1.3, box[2][1] - 1.7))))
    os.environ.setdefault("WM_PROJECT_DIR", "/usr/share/openfoam")
    return {name: [name, "-case", folder, *(["-overwrite"] if name == "snappyHexMesh" else [])]
            for name in ("blockMesh", "surfaceFeatureExtract", "snappyHexMesh")}
