# SPDX-License-Identifier: GPL-3.0-or-later
"""What dictionaries of OpenFOAM's snappyHexMesh have in common, whatever is meshed."""

import itertools

HEADER = "FoamFile {{ version 2.0; format ascii; class dictionary; object {}; }}\n"

CONTROLS = """snapControls
{{
  nSmoothPatch 3; tolerance 2.0; nSolveIter 30; nRelaxIter 5;
  nFeatureSnapIter 10; implicitFeatureSnap false; explicitFeatureSnap {snap}; multiRegionFeatureSnap {snap};
}}
addLayersControls
{{
  relativeSizes true; layers {{ "{walls}" {{ nSurfaceLayers {layers}; }} }} expansionRatio {growth};
  finalLayerThickness {last:g}; minThickness 0.1; nGrow 0;
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


def controls(snap, walls=".*", layers=0):
    """The end of snappyHexMeshDict: whether to snap to features, and how many layers which patches have. They are as thick
    as Atria's by default: 0.3 of a cell for one, 0.6 for more, each a fifth thicker than the one below it."""
    growth = 1.2
    last = 0.3 if layers < 2 else 0.6 * growth ** (layers - 1) / sum(growth**n for n in range(layers))
    return CONTROLS.format(snap="true" if snap else "false", walls=walls, layers=layers, growth=growth, last=last)


def words(point):
    return " ".join(f"{c:.17g}" for c in point)


def fans(polygons):
    """Triangles of convex polygons."""
    return [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


def stl(name, triangles):
    facets = "\n".join(
        "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {words(p)}\n" for p in t) + "endloop\nendfacet"
        for t in triangles
    )
    return f"solid {name}\n{facets}\nendsolid {name}\n"


def block_mesh(box, cells, boundary):
    """`boundary` holds the entries of its patches, with faces of the block's corners 0 to 7."""
    corners = [(box[0][i], box[1][j], box[2][k]) for k, j, i in itertools.product((0, 1), (0, 1), (0, 1))]
    order = [corners[i] for i in (0, 1, 3, 2, 4, 5, 7, 6)]
    return (
        f"vertices ({' '.join(f'({words(p)})' for p in order)});\n"
        f"blocks (hex (0 1 2 3 4 5 6 7) ({words(cells)}) simpleGrading (1 1 1));\n"
        f"boundary ({boundary});\n"
    )


def write(folder, name, text):
    (folder / "system" / name).write_text(HEADER.format(name) + text)


def write_feature_extraction(folder, names):
    """For surfaceFeatureExtract: edges of these surfaces at which they bend by more than 30 degrees, end, or branch."""
    write(folder, "surfaceFeatureExtractDict", "".join(
        f"{name}.stl {{ extractionMethod extractFromSurface; writeObj no; extractFromSurfaceCoeffs {{ includedAngle 150; }} "
        "subsetFeatures { nonManifoldEdges yes; openEdges yes; } }\n" for name in names))


def begin(folder):
    """Makes the case's folders, and the dictionaries that all meshers of OpenFOAM ask for."""
    (folder / "system").mkdir(parents=True)
    (folder / "constant" / "triSurface").mkdir(parents=True)
    write(folder, "controlDict", "application x; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1;\n"
          "writeControl timeStep; writeInterval 1; writeFormat binary; writePrecision 8;\n")
    write(folder, "fvSchemes", "ddtSchemes {} gradSchemes {} divSchemes {} laplacianSchemes {} interpolationSchemes {}\n")
    write(folder, "fvSolution", "solvers {}\n")
