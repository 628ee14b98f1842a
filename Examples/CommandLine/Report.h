// SPDX-License-Identifier: GPL-3.0-or-later
/// The parts of the JSON reports.
#pragma once

#include <Surface/Repair/SurfaceRepair.h>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

class vtkDataObject;
class vtkAtriaDualMesher;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkTable;
class vtkUnstructuredGrid;

namespace atria::tool {

/// Keeps the order in which keys are added.
using Json = nlohmann::ordered_json;

/// [{id, elements, kept, kind, volume, rough_volume, inside, sides, surfaces}]: all zones there are, from the mesher's
/// diagnostics. `volumes` are those of sumsOf(); the volume is null for zones that are not in the mesh.
Json zonesOf(const Json& volumes, vtkPolyData* diagnostics);

/// [{name, volume, floor_area, openings}] and [{name, surface, area, rooms}] from the field arrays Room… and Opening…
/// of the mesher's diagnostics; empty without face zones.
Json roomsOf(vtkPolyData* diagnostics);
Json openingsOf(vtkPolyData* diagnostics);

/// [{seed, side, place, width, surfaces, message}] from the field arrays Leak… of the mesher's diagnostics.
Json leaksOf(vtkPolyData* diagnostics);

/// {metric: {min, max, mean, std}} from the summary table of vtkAtriaMeshQuality.
Json qualityOf(vtkTable* summary);

/// {check: {of, limit, worst, mean, failing, is_error, set, advice}} from the table of checks of vtkAtriaMeshQuality or
/// vtkAtriaOpenFOAMWriter.
Json checksOf(vtkTable* checks);

/// The names of those that count as failed.
std::vector<std::string> failedIn(const Json& checks);

/// {stage: seconds} of the mesher's last run.
Json stageSecondsOf(vtkAtriaDualMesher* mesher);

/// {name: cells} from the cell array Diagnostic and the field array DiagnosticName, and the names in the field arrays
/// SurfaceWithoutFaces, InputWarning, SizingWarning and InputNote.
Json diagnosticsOf(vtkPolyData* diagnostics);

/// {name: number} from the field arrays RepairName and RepairValue: what of the surfaces was changed.
Json repairOf(vtkPolyData* diagnostics);

/// [{surface, left_out: {triangles, area}, clustered: {triangles, area}}]: what of the surfaces is too fine for the
/// mesh, from the field arrays of diagnostics or preflight.
Json hiddenDetailOf(vtkDataObject* data);
Json hiddenDetailOf(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames);

/// The same as lines of text, each with what is put before it; the surfaces with most triangles, and how many more.
std::string hiddenDetailText(const Json& hidden, const std::string& before);

/// [{surface, layers, area, covered, covered_in_full, thickness}] from the field arrays Layer… of the mesher's
/// diagnostics: shares of the area, and the thickness got relative to that asked for.
Json layersOf(vtkPolyData* diagnostics);
/// The comparison of mesh and model: `surfaces`, `volumes` and `warnings`.
Json auditOf(vtkPolyData* diagnostics);
/// As a table; nothing where no layers were asked for.
void printLayers(vtkPolyData* diagnostics);

/// The field array MaxLevel; null where it is absent.
Json maxLevelOf(vtkUnstructuredGrid* mesh);

/// {quantity: value} of vtkAtriaPreflight's table, what the narrowest places lie between, and warnings.
Json preflightOf(vtkTable* table);
void printPreflight(vtkTable* table);

} // namespace atria::tool
