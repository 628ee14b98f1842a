// SPDX-License-Identifier: GPL-3.0-or-later
/// Result of meshing a model: the mesh, and what there is to report.
#pragma once

#include "Audit/AuditResult.h"
#include "Domain/GroundReport.h"
#include "Dual/Mesh/DualMesh.h"
#include "Dual/Mesh/MetSides.h"
#include "Dual/Zones/ZoneReport.h"
#include "Layer/LayerReport.h"
#include "Mesher/Diagnostic.h"
#include "Mesher/RoomReport.h"
#include "Surface/Repair/RepairReport.h"
#include "Surface/Triangles/SurfaceKind.h"

#include <string>
#include <utility>
#include <vector>

namespace atria {

/// The mesh of an octree.
struct DualMeshResult
{
  DualMesh mesh;
  /// One entry per tag of boundary faces; see findMetSides.
  std::vector<MetSides> metSides;
  std::vector<Diagnostic> diagnostics;
  /// One entry per zone found: a flag for those that the mesh keeps, and a summary. `zones` of the mesh are indices
  /// into these.
  std::vector<char> keptZones;
  std::vector<ZoneSummary> zones;
  /// In the order of the diagnostics of their kind.
  std::vector<Leak> leaks;
  /// Empty without rules for layers.
  LayerReport layers = {};
  /// Empty if no surface is a face zone. `rooms` of the mesh are indices into its rooms.
  RoomReport rooms = {};
  /// Lacks what was drawn until it is completed: see Mesher/AuditReport.h.
  MeshAudit audit = {};
};

/// The mesh of a model.
struct MeshedModel : DualMeshResult
{
  /// Names of the surfaces. Tags of boundary faces from their count on are bare sides of the domain, by number.
  std::vector<std::string> names;
  /// One entry per surface; empty if all are walls.
  std::vector<SurfaceKind> kinds;
  SurfaceRepairReport repair;
  /// Warnings about the domain and cell zones, a sentence each; see checkDomain.
  std::vector<std::string> inputWarnings;
  /// Differences between the mesh and the model, a sentence each; see warningsOf() in Mesher/AuditReport.h.
  std::vector<std::string> auditWarnings;
  /// Says which sizes were left out to keep to the limit of elements; empty if none.
  std::string sizingWarning;
  /// Describes how bodies stand on the ground. Its warnings and notes are among `inputWarnings` and `notes`.
  GroundReport ground;
  /// Notes on what was done with the model, or stays as it was drawn, a sentence each.
  std::vector<std::string> notes;
  /// The level of the finest octants.
  int maximumLevel = 0;
  /// Names of the stages and the seconds that each took.
  std::vector<std::pair<std::string, double>> stages;
};

} // namespace atria
