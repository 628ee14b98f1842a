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
  /// By tag of boundary faces; see findMetSides.
  std::vector<MetSides> metSides;
  std::vector<Diagnostic> diagnostics;
  /// Zones found, and which of them the mesh keeps; `zones` of the mesh are indices into these.
  std::vector<char> keptZones;
  std::vector<ZoneSummary> zones;
  /// In the order of the diagnostics of their kind.
  std::vector<Leak> leaks;
  /// Empty without rules for layers.
  LayerReport layers = {};
  /// Empty where no surface is a face zone. `rooms` of the mesh are indices into its rooms.
  RoomReport rooms = {};
  /// Without what was drawn, until it is completed: see Mesher/AuditReport.h.
  MeshAudit audit = {};
};

/// The mesh of a model.
struct MeshedModel : DualMeshResult
{
  /// Names of the surfaces; tags of boundary faces from their number on are bare sides of the domain, by number.
  std::vector<std::string> names;
  /// Of each surface; empty where all are walls.
  std::vector<SurfaceKind> kinds;
  SurfaceRepairReport repair;
  /// What a user should know of the domain and of cell zones, a sentence each; see checkDomain.
  std::vector<std::string> inputWarnings;
  /// How the mesh differs from the model, a sentence each; see warningsOf() in Mesher/AuditReport.h.
  std::vector<std::string> auditWarnings;
  /// What sizes had to be left out to keep to the limit of elements; empty if nothing.
  std::string sizingWarning;
  /// How bodies stand on the ground; what there is to say of it is among `inputWarnings` and `notes`.
  GroundReport ground;
  /// What was done with the model, or is as it was drawn, a sentence each.
  std::vector<std::string> notes;
  /// The level of the finest octants.
  int maximumLevel = 0;
  /// Names of the stages and the seconds that each took.
  std::vector<std::pair<std::string, double>> stages;
};

} // namespace atria
