// SPDX-License-Identifier: GPL-3.0-or-later
/// Converts meshes, patches and reports from the core to VTK; docs/arrays.md lists the arrays.
#pragma once

#include "Mesher/MeshModel.h"
#include "Surface/Repair/SurfaceRepair.h"

#include <optional>

class vtkFieldData;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria {

/// Converts the elements. They become hexahedra, or wedges, pyramids and tetrahedra if their corners coincide that way,
/// else polyhedra. Cell i is element i.
void volumeToVtk(const DualMesh& mesh, vtkUnstructuredGrid* out, const Executor& executor);

/// Adds the field array RoomName, one entry per RoomId; nothing without rooms.
void roomsToVtk(const RoomReport& report, vtkUnstructuredGrid* out);

/// Adds the cell array CellZoneId and the field array CellZoneName; nothing if no surface is a cell zone.
void cellZonesToVtk(const DualMesh& mesh, const std::vector<std::string>& surfaceNames,
                    const std::vector<SurfaceKind>& kinds, vtkUnstructuredGrid* out, const Executor& executor);

/// Numbers of a piece's elements and points in the whole mesh.
struct NumbersOfAll
{
  const std::vector<std::uint64_t>& elements;
  const std::vector<std::uint64_t>& points;
};

/// Makes one polydata per patch: surfaces in order of their ids, then bare domain sides. A surface that has elements of
/// the mesh on its front and on its back, somewhere on both at once, becomes two patches, `<name>_front` and
/// `<name>_back`. Faces are counter-clockwise seen from outside the mesh. LayerCount and LayerThickness are from the
/// report; zero if that is empty. Face zones follow, one polydata each; their faces are inside the mesh, between
/// OwnerCellId, at the back of the surface, and NeighborCellId. For a piece, `met` is that of the whole mesh; the piece
/// then has all patches of the whole mesh, some maybe without faces.
void patchesToVtk(const DualMesh& mesh, const std::vector<MetSides>& met, const std::vector<std::string>& surfaceNames,
                  const std::vector<SurfaceKind>& kinds, const LayerReport& layers,
                  vtkPartitionedDataSetCollection* out, const std::optional<NumbersOfAll>& numbers = {});

/// Adds the layer report as field arrays Layer…, an entry for each surface.
void layersToVtk(const LayerReport& layers, vtkPolyData* out);

/// Adds the comparison of mesh and model as field arrays Audit…: an entry for each surface, `AuditVolumeName` with
/// `AuditVolume`, bodies that are not plain solids on the ground, and `AuditWarning`.
void auditToVtk(const MeshedModel& result, vtkFieldData* out);

/// Adds the changes by surface repair as field arrays `RepairName` and `RepairValue`: a name and a number each.
void repairToVtk(const SurfaceRepairReport& report, vtkPolyData* out);

/// Adds details too fine for the mesh as field arrays, with an entry for each surface that has any:
/// `HiddenDetailSurface`, `LeftOutTriangles`, `LeftOutArea`, `ClusteredTriangles` and `ClusteredArea`.
void hiddenDetailToVtk(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames,
                       vtkFieldData* out);

/// Makes a line or point for each diagnostic. The field array SurfaceWithoutFaces lists surfaces that got no face.
/// Zones and leaks become field arrays too.
void diagnosticsToVtk(const DualMeshResult& result, const std::vector<std::string>& surfaceNames, vtkPolyData* out);

/// Adds rooms and openings as the field arrays Room… and Opening…, an entry for each.
void roomsToVtk(const RoomReport& report, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

/// Adds the field arrays Zone…, an entry for each zone.
void zonesToVtk(const std::vector<ZoneSummary>& zones, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

/// Adds the field arrays Leak…, an entry for each leak.
void leaksToVtk(const std::vector<Leak>& leaks, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

} // namespace atria
