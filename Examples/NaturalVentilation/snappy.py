# SPDX-License-Identifier: GPL-3.0-or-later
"""The same building for OpenFOAM's snappyHexMesh: sheets as baffles, openings as face zones, the same sizes."""

import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parent.parent / "Study"))

import make_building  # noqa: E402
from snappy_dictionaries import begin, block_mesh, controls, fans, stl, words, write, write_feature_extraction  # noqa: E402

SNAPPY = """
castellatedMesh true; snap true; addLayers {layered};
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
"""


def sides():
    """The patches of the block."""
    faces = {"Site": "(0 3 2 1)", "zMax": "(4 5 6 7)", "yMin": "(0 1 5 4)", "yMax": "(3 7 6 2)", "xMin": "(0 4 7 3)",
             "xMax": "(1 2 6 5)"}
    return "\n" + "".join(
        f"{name} {{ type {'wall' if name == 'Site' else 'patch'}; faces ({face}); }}\n" for name, face in faces.items()
    )


def write_case(folder, finest, far, site, layers=0):
    """Returns the commands by their names. Layers are on the ground and both sides of every sheet."""
    begin(folder)
    (x0, y0, _), _, (x1, y1, _), _ = make_building.site(*site)[0]
    box = ((x0, x1), (y0, y1), (0.0, 0.3 * max(site)))
    level = round(math.log2(far / finest))
    walls = {name: polygons for name, (polygons, _) in make_building.sheets().items()}
    walls["Neighbor"] = make_building.neighbor()
    openings = make_building.openings()
    for name, polygons in (walls | openings).items():
        (folder / "constant" / "triSurface" / f"{name}.stl").write_text(stl(name, fans(polygons)))
    write(folder, "blockMeshDict", block_mesh(box, [max(1, round((high - low) / far)) for low, high in box], sides()))
    write_feature_extraction(folder, walls)
    zones = {name: f"faceZone {name}; faceType internal;" for name in openings}
    layered = f"({'|'.join(['Site', *walls])})"
    write(folder, "snappyHexMeshDict", SNAPPY.format(
        layered="true" if layers else "false",
        geometry="\n".join(f"  {name}.stl {{ type triSurfaceMesh; name {name}; }}" for name in walls | openings),
        features=" ".join(f'{{ file "{name}.eMesh"; level {level}; }}' for name in walls),
        surfaces="\n".join(f"    {name} {{ level ({level} {level}); {zones.get(name, 'patchInfo { type wall; }')} }}"
                           for name in walls | openings),
        ground_low=words((x0, y0, 0.0)), ground_high=words((x1, y1, finest)), level=level,
        inside=words((x0 + 1.1, y0 + 1.3, box[2][1] - 1.7))) + controls(True, layered, layers))
    return {name: [name, "-case", folder, *(["-overwrite"] if name == "snappyHexMesh" else [])]
            for name in ("blockMesh", "surfaceFeatureExtract", "snappyHexMesh")}
