// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the parts of the JSON reports, and prints some of them.
#pragma once

#include <Surface/Repair/RepairReport.h>

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

/// Returns [{id, elements, kept, kind, volume, rough_volume, inside, sides, surfaces}]: all zones, from the mesher's
/// diagnostics. `volumes` are those of sumsOf(); the volume is null for zones that are not in the mesh.
Json zonesOf(const Json& volumes, vtkPolyData* diagnostics);

/// Return [{name, volume, floor_area, openings}] and [{name, surface, area, rooms}] from the field arrays Room… and
/// Opening… of the mesher's diagnostics; empty without face zones.
Json roomsOf(vtkPolyData* diagnostics);
Json openingsOf(vtkPolyData* diagnostics);

/// Returns [{seed, side, place, width, surfaces, message}] from the field arrays Leak… of the mesher's diagnostics.
Json leaksOf(vtkPolyData* diagnostics);

/// Returns {metric: {min, max, mean, std}} from the summary table of vtkAtriaMeshQuality.
Json qualityOf(vtkTable* summary);

/// Returns {check: {of, limit, worst, mean, failing, is_error, set, advice}} from the table of checks of
/// vtkAtriaMeshQuality or vtkAtriaOpenFOAMWriter.
Json checksOf(vtkTable* checks);

/// Returns the texts of a field array of the diagnostics, with options in place of properties.
Json textsOf(vtkPolyData* diagnostics, const char* name);

/// Returns the names of the checks that count as failed.
std::vector<std::string> failedIn(const Json& checks);

/// Returns {stage: seconds} of the mesher's last run.
Json stageSecondsOf(vtkAtriaDualMesher* mesher);

/// Returns {name: cells} from the cell array Diagnostic and the field array DiagnosticName, and the names in the field
/// arrays SurfaceWithoutFaces, InputWarning, SizingWarning and InputNote.
Json diagnosticsOf(vtkPolyData* diagnostics);

/// Returns {name: number} from the field arrays RepairName and RepairValue: the changes made to the surfaces.
Json repairOf(vtkPolyData* diagnostics);

/// Return [{surface, left_out: {triangles, area}, clustered: {triangles, area}}]: details of the surfaces that are too
/// fine for the mesh, from the field arrays of diagnostics or preflight.
Json hiddenDetailOf(vtkDataObject* data);
Json hiddenDetailOf(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames);

/// Returns the same as lines of text, each with `before` in front: the surfaces with most triangles, and how many more.
std::string hiddenDetailText(const Json& hidden, const std::string& before);

/// Returns [{surface, layers, area, covered, covered_in_full, thickness, first_height}] from the field arrays Layer… of
/// the mesher's diagnostics: shares of the area, the thickness reached relative to the one requested, and the height of
/// the elements on the wall. With a speed in m/s, above 0, there is `y_plus` too.
Json layersOf(vtkPolyData* diagnostics, double speed);
/// Returns the comparison of mesh and model: `surfaces`, `volumes` and `warnings`.
Json auditOf(vtkPolyData* diagnostics);
/// Prints a table; nothing if no layers were requested.
void printLayers(const Json& layers);

/// Returns the field array MaxLevel; null if it is absent.
Json maxLevelOf(vtkUnstructuredGrid* mesh);

/// Returns {quantity: value} of vtkAtriaPreflight's table, the surfaces around the narrowest places, and warnings.
Json preflightOf(vtkTable* table);
void printPreflight(vtkTable* table);

} // namespace atria::tool
