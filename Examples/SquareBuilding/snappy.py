# SPDX-License-Identifier: GPL-3.0-or-later
"""The same building for OpenFOAM's snappyHexMesh, with the same sizes in the same places."""

import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_building  # noqa: E402
from snappy_dictionaries import begin, block_mesh, controls, fans, stl, words, write, write_feature_extraction  # noqa: E402

SNAPPY = """
castellatedMesh true; snap true; addLayers false;
geometry
{{
  Building.stl {{ type triSurfaceMesh; name Building; }}
  near {{ type searchableBox; min ({near_low}); max ({near_high}); }}
  ground {{ type searchableBox; min ({ground_low}); max ({ground_high}); }}
}}
castellatedMeshControls
{{
  maxLocalCells 200000000; maxGlobalCells 200000000; minRefinementCells 0; maxLoadUnbalance 0.1; nCellsBetweenLevels 1;
  features ({{ file "Building.eMesh"; level {level}; }});
  refinementSurfaces {{ Building {{ level ({level} {level}); patchInfo {{ type wall; }} }} }}
  resolveFeatureAngle 30;
  refinementRegions
  {{
    near {{ mode inside; levels ((1e15 {level})); }}
    ground {{ mode inside; levels ((1e15 {ground_level})); }}
  }}
  locationInMesh ({inside}); allowFreeStandingZoneFaces true;
}}
"""
SIDES = """
Ground { type wall; faces ((0 3 2 1)); }
zMax { type patch; faces ((4 5 6 7)); }
yMin { type patch; faces ((0 1 5 4)); }
yMax { type patch; faces ((3 7 6 2)); }
xMin { type patch; faces ((0 4 7 3)); }
xMax { type patch; faces ((1 2 6 5)); }
"""


def write_case(folder, finest, ground, far):
    """Returns the commands by their names."""
    begin(folder)
    level, ground_level = round(math.log2(far / finest)), round(math.log2(far / ground))
    low, high = zip(*make_building.DOMAIN)
    near_low, near_high = zip(*make_building.NEAR)
    (folder / "constant" / "triSurface" / "Building.stl").write_text(stl("Building", fans(make_building.building())))
    cells = [max(1, round((b - a) / far)) for a, b in make_building.DOMAIN]
    write(folder, "blockMeshDict", block_mesh(make_building.DOMAIN, cells, SIDES))
    write_feature_extraction(folder, ["Building"])
    write(folder, "snappyHexMeshDict", SNAPPY.format(
        near_low=words(near_low), near_high=words(near_high), ground_low=words(low),
        ground_high=words((high[0], high[1], low[2] + 0.51 * far)), level=level, ground_level=ground_level,
        inside=words([b - 0.31 * finest for b in high])) + controls(snap=True))
    return {name: [name, "-case", folder, *(["-overwrite"] if name == "snappyHexMesh" else [])]
            for name in ("blockMesh", "surfaceFeatureExtract", "snappyHexMesh")}
