// SPDX-License-Identifier: GPL-3.0-or-later
#include "AddArray.h"
#include "VtkDualMesh.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <utility>

namespace atria {

namespace {

/// Names of three arrays: a distance, the same in elements, and its position.
struct DistanceNames
{
  const char* distance;
  const char* inElements;
  const char* place;
};

void farthestToVtk(const std::vector<SurfaceAudit>& surfaces, FarthestPlace SurfaceDistances::*which,
                   const DistanceNames& names, vtkFieldData* out)
{
  const auto add = [&](const char* name, double FarthestPlace::*value) {
    addArrayOf<vtkDoubleArray>(out, name, surfaces,
                               [&](const SurfaceAudit& surface) { return (surface.distances.*which).*value; });
  };
  add(names.distance, &FarthestPlace::distance);
  add(names.inElements, &FarthestPlace::inElements);
  auto* places = addArray<vtkDoubleArray>(out, names.place, 3);
  for (const SurfaceAudit& surface : surfaces)
  {
    places->InsertNextTuple((surface.distances.*which).at.data());
  }
}

/// Values reported for a body.
struct BodyRow
{
  const char* state;
  std::string name;
  double distance;
  double volume;
  Vec3 place;
};

std::vector<BodyRow> rowsOf(const MeshedModel& result)
{
  std::vector<BodyRow> rows;
  const GroundReport& ground = result.ground;
  const auto addAtGround = [&](const char* state, const std::vector<BodyAtGround>& bodies) {
    for (const BodyAtGround& body : bodies)
    {
      rows.push_back({state, body.name, body.distance, body.airBelow, body.place});
    }
  };
  const auto addAired = [&](const char* state, const std::vector<AiredBody>& bodies) {
    for (const AiredBody& body : bodies)
    {
      rows.push_back({state, result.names[body.surface], 0.0, body.volume, body.place});
    }
  };
  addAtGround("let down", ground.letDown);
  addAtGround("hovering", ground.hovering);
  addAtGround("below ground", ground.belowGround);
  addAired("hollow", result.audit.bodies.hollow);
  addAired("open", result.audit.bodies.open);
  return rows;
}

void bodiesToVtk(const MeshedModel& result, vtkFieldData* out)
{
  addArrayOf<vtkIntArray>(out, "AuditClosedBodies", std::array{static_cast<int>(result.audit.bodies.closed)});
  addArrayOf<vtkIntArray>(out, "AuditStandingBodies", std::array{static_cast<int>(result.ground.standing)});
  const std::vector<BodyRow> rows = rowsOf(result);
  addArrayOf<vtkStringArray>(out, "AuditBody", rows, &BodyRow::name);
  addArrayOf<vtkStringArray>(out, "AuditBodyState", rows, &BodyRow::state);
  addArrayOf<vtkDoubleArray>(out, "AuditBodyDistance", rows, &BodyRow::distance);
  addArrayOf<vtkDoubleArray>(out, "AuditBodyVolume", rows, &BodyRow::volume);
  auto* places = addArray<vtkDoubleArray>(out, "AuditBodyPlace", 3);
  for (const BodyRow& row : rows)
  {
    places->InsertNextTuple(row.place.data());
  }
}

} // namespace

void auditToVtk(const MeshedModel& result, vtkFieldData* out)
{
  const MeshAudit& audit = result.audit;
  addArrayOf<vtkStringArray>(out, "AuditWarning", result.auditWarnings);
  const std::vector<SurfaceAudit>& surfaces = audit.surfaces;
  addArrayOf<vtkStringArray>(out, "AuditSurface", surfaces,
                             [&](const SurfaceAudit& surface) { return result.names[&surface - surfaces.data()]; });
  constexpr std::pair<const char*, double SurfaceAudit::*> columns[] = {
      {"AuditDrawnArea", &SurfaceAudit::drawnArea},
      {"AuditOutside", &SurfaceAudit::outside},
      {"AuditMeshArea", &SurfaceAudit::meshArea},
      {"AuditUnderGround", &SurfaceAudit::underGround},
      {"AuditInSolid", &SurfaceAudit::inSolid},
      {"AuditInRoom", &SurfaceAudit::inRoom},
      {"AuditShared", &SurfaceAudit::shared},
      {"AuditLeftOut", &SurfaceAudit::leftOut},
      {"AuditLost", &SurfaceAudit::lost},
      {"AuditMeanSize", &SurfaceAudit::meanSize},
      {"AuditLargestSize", &SurfaceAudit::largestSize},
      {"AuditRequestedSize", &SurfaceAudit::requestedSize}};
  for (const auto& [name, member] : columns)
  {
    addArrayOf<vtkDoubleArray>(out, name, surfaces, member);
  }
  farthestToVtk(surfaces, &SurfaceDistances::ofFaces,
                {"AuditFacesDistance", "AuditFacesDistanceInElements", "AuditFacesPlace"}, out);
  farthestToVtk(surfaces, &SurfaceDistances::ofSurface,
                {"AuditModelDistance", "AuditModelDistanceInElements", "AuditModelPlace"}, out);
  const VolumeAudit& volumes = audit.volumes;
  const std::pair<const char*, double> entries[] = {{"Domain", volumes.domain},
                                                    {"Air", volumes.air},
                                                    {"Displaced", volumes.displaced()},
                                                    {"DisplacedByModel", volumes.displacedByModel},
                                                    {"ClosedBodies", audit.bodies.volume},
                                                    {"Overlap", audit.bodies.overlap}};
  addArrayOf<vtkStringArray>(out, "AuditVolumeName", entries, &std::pair<const char*, double>::first);
  addArrayOf<vtkDoubleArray>(out, "AuditVolume", entries, &std::pair<const char*, double>::second);
  bodiesToVtk(result, out);
}

} // namespace atria
