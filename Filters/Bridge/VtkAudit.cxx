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

/// The names of three arrays: a distance, the same in elements, and where it is.
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
  farthestToVtk(surfaces, &SurfaceDistances::ofFaces,
                {"AuditFacesDistance", "AuditFacesDistanceInElements", "AuditFacesPlace"}, out);
  farthestToVtk(surfaces, &SurfaceDistances::ofSurface,
                {"AuditModelDistance", "AuditModelDistanceInElements", "AuditModelPlace"}, out);
  const VolumeAudit& volumes = audit.volumes;
  const std::pair<const char*, double> entries[] = {{"Domain", volumes.domain},
                                                    {"Air", volumes.air},
                                                    {"Displaced", volumes.displaced()},
                                                    {"DisplacedByModel", volumes.displacedByModel}};
  addArrayOf<vtkStringArray>(out, "AuditVolumeName", entries, &std::pair<const char*, double>::first);
  addArrayOf<vtkDoubleArray>(out, "AuditVolume", entries, &std::pair<const char*, double>::second);
}

} // namespace atria
