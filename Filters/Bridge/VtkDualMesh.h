// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes from the core to VTK; docs/arrays.md lists the arrays.
#pragma once

#include "Mesher/MeshModel.h"
#include "Surface/Repair/SurfaceRepair.h"

#include <optional>

class vtkFieldData;
class vtkPartitionedDataSetCollection;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria {

/// Hexahedra, wedges, pyramids, tetrahedra where corners coincide so, polyhedra otherwise. Cell i is element i.
void volumeToVtk(const DualMesh& mesh, vtkUnstructuredGrid* out, const Executor& executor);

/// The field array RoomName, by RoomId; nothing without rooms.
void roomsToVtk(const RoomReport& report, vtkUnstructuredGrid* out);

/// The cell array CellZoneId and the field array CellZoneName; nothing where no surface is a cell zone.
void cellZonesToVtk(const DualMesh& mesh, const std::vector<std::string>& surfaceNames,
                    const std::vector<SurfaceKind>& kinds, vtkUnstructuredGrid* out, const Executor& executor);

/// Numbers of a piece's elements and points in the mesh that it is of.
struct NumbersOfAll
{
  const std::vector<std::uint64_t>& elements;
  const std::vector<std::uint64_t>& points;
};

/// One polydata a patch: surfaces in order of their ids, then bare domain sides. A surface that has elements of the
/// mesh on its front and on its back, somewhere on both at once, is two patches, `<name>_front` and `<name>_back`.
/// Faces are seen counter-clockwise from outside of the mesh. LayerCount and LayerThickness are from the report; zero
/// where that is empty. Then one for each face zone, whose faces are within the mesh, between OwnerCellId, at the back
/// of the surface, and NeighborCellId.
/// `met` is of the whole mesh, where this is a piece, and the piece has a patch, maybe without faces, for all that the
/// whole has.
void patchesToVtk(const DualMesh& mesh, const std::vector<MetSides>& met, const std::vector<std::string>& surfaceNames,
                  const std::vector<SurfaceKind>& kinds, const LayerReport& layers,
                  vtkPartitionedDataSetCollection* out, const std::optional<NumbersOfAll>& numbers = {});

/// What became of the layers on each surface, as field arrays Layer…, an entry for each.
void layersToVtk(const LayerReport& layers, vtkPolyData* out);

/// Adds the comparison of mesh and model as field arrays Audit…: an entry for each surface, `AuditVolumeName` with
/// `AuditVolume`, bodies that are not plain solids on the ground, and `AuditWarning`.
void auditToVtk(const MeshedModel& result, vtkFieldData* out);

/// What the repair of the surfaces changed, as field arrays `RepairName` and `RepairValue`: a name and a number each.
void repairToVtk(const SurfaceRepairReport& report, vtkPolyData* out);

/// What of which surfaces is too fine for the mesh, as field arrays with an entry a surface that has any:
/// `HiddenDetailSurface`, `LeftOutTriangles`, `LeftOutArea`, `ClusteredTriangles` and `ClusteredArea`.
void hiddenDetailToVtk(const std::vector<HiddenDetail>& hidden, const std::vector<std::string>& surfaceNames,
                       vtkFieldData* out);

/// A line or point for each diagnostic; surfaces that got no face are listed in the field array SurfaceWithoutFaces.
/// Zones and leaks are field arrays too.
void diagnosticsToVtk(const DualMeshResult& result, const std::vector<std::string>& surfaceNames, vtkPolyData* out);

/// Rooms and openings as the field arrays Room… and Opening…, an entry for each.
void roomsToVtk(const RoomReport& report, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

/// The field arrays Zone…, an entry for each zone.
void zonesToVtk(const std::vector<ZoneSummary>& zones, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

/// The field arrays Leak…, an entry for each leak.
void leaksToVtk(const std::vector<Leak>& leaks, const std::vector<std::string>& surfaceNames, vtkFieldData* out);

} // namespace atria
