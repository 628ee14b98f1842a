// SPDX-License-Identifier: GPL-3.0-or-later
#include "AddArray.h"
#include "VtkDualMesh.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <utility>

namespace atria {

namespace {

/// Distance, the same in elements, and where it is.
void farthestToVtk(const std::vector<SurfaceAudit>& surfaces, FarthestPlace SurfaceDistances::*which,
                   const std::string& name, vtkFieldData* out)
{
  const auto add = [&](const char* what, auto&& valueOf) {
    addArrayOf<vtkDoubleArray>(out, (name + what).c_str(), surfaces,
                               [&](const SurfaceAudit& surface) { return valueOf(surface.distances.*which); });
  };
  add("Distance", [](const FarthestPlace& place) { return place.distance; });
  add("DistanceInElements", [](const FarthestPlace& place) { return place.inElements; });
  auto* places = addArray<vtkDoubleArray>(out, (name + "Place").c_str(), 3);
  for (const SurfaceAudit& surface : surfaces)
  {
    places->InsertNextTuple((surface.distances.*which).at.data());
  }
}

} // namespace

void auditToVtk(const MeshAudit& audit, const std::vector<std::string>& warnings,
                const std::vector<std::string>& surfaceNames, vtkFieldData* out)
{
  addArrayOf<vtkStringArray>(out, "AuditWarning", warnings);
  const std::vector<SurfaceAudit>& surfaces = audit.surfaces;
  addArrayOf<vtkStringArray>(out, "AuditSurface", surfaces,
                             [&](const SurfaceAudit& surface) { return surfaceNames[&surface - surfaces.data()]; });
  constexpr std::pair<const char*, double SurfaceAudit::*> columns[] = {
      {"AuditDrawnArea", &SurfaceAudit::drawnArea},
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
  farthestToVtk(surfaces, &SurfaceDistances::ofFaces, "AuditFaces", out);
  farthestToVtk(surfaces, &SurfaceDistances::ofSurface, "AuditModel", out);
  const VolumeAudit& volumes = audit.volumes;
  const std::pair<const char*, double> entries[] = {{"Domain", volumes.domain},
                                                    {"Air", volumes.air},
                                                    {"Displaced", volumes.displaced()},
                                                    {"DisplacedByModel", volumes.displacedByModel}};
  addArrayOf<vtkStringArray>(out, "AuditVolumeName", entries, &std::pair<const char*, double>::first);
  addArrayOf<vtkDoubleArray>(out, "AuditVolume", entries, &std::pair<const char*, double>::second);
}

} // namespace atria
