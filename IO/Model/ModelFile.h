// SPDX-License-Identifier: GPL-3.0-or-later
/// Readers of the formats. Each function throws Error with a text that names the file and a remedy.
#pragma once

#include "ModelParts.h"

#include <string>

namespace atria {
class ProgressRange;
}

namespace atria::model {

/// Wavefront: a part for each object, group and material. In double precision.
Model readObj(const std::string& file);
/// ASCII or binary: a part for each name of a solid. ASCII in double precision.
Model readStl(const std::string& file);
/// ASCII or binary: one part.
Model readPly(const std::string& file);
/// glTF 2.0 or GLB: a part for each primitive of each node of the scene, Y up.
Model readGltf(const std::string& file);
/// DXF in text form: a part for each layer. In double precision.
Model readDxf(const std::string& file);
/// COLLADA, 3DS or FBX, by assimp: a part for each material of each node. An abort ends it.
Model readAssimp(const std::string& file, const ProgressRange& progress);
/// IFC, by assimp: a part for each material of each element. An abort ends it.
Model readIfc(const std::string& file, const ProgressRange& progress);
/// CityJSON, or CityJSON text sequences: a part for each semantic class of each city object.
Model readCityJson(const std::string& file);
/// VTK's XML polydata, multiblock datasets and partitioned dataset collections.
Model readXml(const std::string& file);

} // namespace atria::model
