// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of the JSON reports.
#pragma once

#include <nlohmann/json.hpp>

class vtkAtriaDualMesher;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkTable;
class vtkUnstructuredGrid;

namespace atria::tool {

/// Keeps the order in which keys are added.
using Json = nlohmann::ordered_json;

/// vertices, elements, and elements by shape.
Json countsOf(vtkUnstructuredGrid* mesh);

/// [{id, elements, volume}] from the cell arrays ZoneId and Volume; one zone 0 where ZoneId is absent.
Json zonesOf(vtkUnstructuredGrid* meshWithQuality);

/// [{name, faces, area}], area in square model units.
Json patchesOf(vtkPartitionedDataSetCollection* patches);

/// {metric: {min, max, mean, std}} from the summary table of vtkAtriaMeshQuality.
Json qualityOf(vtkTable* summary);

/// {stage: seconds} of the mesher's last run.
Json stageSecondsOf(vtkAtriaDualMesher* mesher);

/// {name: cells} from the cell array Diagnostic and the field array DiagnosticName, and the names in the field array
/// SurfaceWithoutFaces.
Json diagnosticsOf(vtkPolyData* diagnostics);

/// {name: number} from the field arrays RepairName and RepairValue: what of the surfaces was changed.
Json repairOf(vtkPolyData* diagnostics);

/// The field array MaxLevel; null where it is absent.
Json maxLevelOf(vtkUnstructuredGrid* mesh);

/// Largest resident memory of this process so far.
long long peakMemoryBytes();

} // namespace atria::tool
