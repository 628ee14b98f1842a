// SPDX-License-Identifier: GPL-3.0-or-later
/// Canopies of a flow case: cell zones whose leaves slow the air, and trees that become such zones.
#pragma once

#include "CaseMesh.h"
#include "Support/RunContext.h"

#include <filesystem>
#include <string>
#include <vector>

namespace atria {

/// Leaves in cell zones. The last of several matching rules holds.
struct CanopyRule
{
  std::string pattern;          ///< see matchesPattern
  double leafAreaDensity = 0.0; ///< one side of the leaves, m2 in each m3 of the canopy
  double dragCoefficient = 0.0;
};

/// Parses `PATTERN LAD CD`. Throws Error if a part is missing or not positive.
CanopyRule canopyRuleFrom(const std::string& text);

/// A cell zone with leaves. They take Cd LAD |U| U from the air, per unit of mass.
struct CaseCanopy
{
  std::string zone;
  double leafAreaDensity = 0.0; ///< 1/m
  double dragCoefficient = 0.0;
  double volume = 0.0; ///< m3
  /// Centers of the cells, and a length far below their sizes, meters. Empty and 0 until addCenters().
  std::vector<Vec3> centers = {};
  double smallLength = 0.0;
};

/// Sets the cells' centers of canopies from the mesh that has their zones.
void addCenters(const PolyMesh& poly, std::vector<CaseCanopy>& canopies, const RunContext& context);

/// Returns the file of a canopy's surface. OpenFOAM's sources of turbulence by leaves take the cells below a surface.
std::string surfaceFileOf(const CaseCanopy& canopy);
/// Returns a surface, as an OBJ file, of one small triangle right above the center of each cell, so that the cells
/// below it are exactly those of the canopy.
std::string surfaceOf(const CaseCanopy& canopy);

/// Returns the canopies that rules make of the mesh's cell zones. Throws Error if a rule matches no zone.
std::vector<CaseCanopy> canopiesOf(const CaseMesh& mesh, const std::vector<CanopyRule>& rules);

/// A tree. Its crown is an ellipsoid from a third of its height up to its top. Lengths in meters.
struct Tree
{
  double x = 0.0;
  double y = 0.0;
  double height = 0.0;
  double crownRadius = 0.0;
  double leafAreaDensity = 0.0;
  double dragCoefficient = 0.0;
};

/// Reads a table `x, y, height, crown radius, LAD, Cd` with a line for each tree; the first line may name the columns.
/// Throws Error naming a line with other than six numbers, or with sizes that are not positive.
std::vector<Tree> readTrees(const std::filesystem::path& file);

/// Trees as cell zones of a mesh: `trees`, or `trees_1` and so on if they differ in LAD or Cd.
struct PlantedTrees
{
  std::vector<CellZone> zones;
  std::vector<CaseCanopy> canopies; ///< one per zone
  std::size_t count = 0;            ///< number of trees, with those missed
  std::vector<Tree> missed;         ///< trees with no center of a cell in their crowns
};

/// Plants trees on the named patches; where there is none below, on the lowest point of the mesh. A cell whose center
/// is in several crowns belongs to the first. Throws Error if the mesh has a zone of these names already.
PlantedTrees plantTrees(const PolyMesh& poly, const std::vector<Tree>& trees, const std::vector<std::string>& ground,
                        const RunContext& context);

/// Returns a sentence on the number of trees, their cells and volume.
std::string summaryOf(const PlantedTrees& planted);
/// Returns warnings of trees that no cell is in; empty without any.
std::vector<std::string> warnOfMissed(const PlantedTrees& planted);

} // namespace atria
