// SPDX-License-Identifier: GPL-3.0-or-later
/// The quantities of a mesh that a flow case depends on.
#pragma once

#include "PolyMesh.h"
#include "Support/RunContext.h"

#include <array>
#include <string>
#include <vector>

namespace atria {

/// Distances of the centers of a patch's cells from its faces, meters.
struct CenterDistances
{
  double low = 0.0;    ///< 95 % of the area has larger ones
  double median = 0.0; ///< half of the area has larger ones
};

struct CasePatch
{
  std::string name;
  std::string type;
  Vec3 areaVector = Vec3::Zero(); ///< sum over its faces, out of the mesh, square meters
  double area = 0.0;              ///< square meters
  Box3 bounds = {};
  bool meetsSides = false; ///< shares points with an upright, plane patch that is no wall
  CenterDistances centers = {};

  /// Returns the share of the patch that faces one way, 0 to 1: 1 for a plane, 0 for a closed surface.
  double flatness() const { return area > 0.0 ? areaVector.norm() / area : 0.0; }
};

/// A face zone; its normal points from the first of its rooms to the second.
struct CaseOpening
{
  std::string name;
  double area = 0.0; ///< square meters; for a nearly plane opening, the area of its outline
  std::array<std::string, 2> rooms;
};

/// A cell zone.
struct CaseRoom
{
  std::string name;
  double volume = 0.0; ///< cubic meters
};

/// Air that is in no cell zone, or in the one of this name, is outdoors.
inline constexpr const char* outdoors = "outside";

struct CaseMesh
{
  std::size_t cells = 0;
  std::size_t faces = 0;
  Box3 bounds;
  double volume = 0.0;                ///< cubic meters
  double worstNonOrthogonality = 0.0; ///< degrees
  double meanNonOrthogonality = 0.0;  ///< degrees
  double worstSkewness = 0.0;
  int failedChecks = 0; ///< as checkMesh -allGeometry counts them
  std::vector<CasePatch> patches;
  std::vector<CaseOpening> openings;
  std::vector<CaseRoom> rooms; ///< without the outdoors
  bool hasOutdoors = false;    ///< there is a cell zone of the outdoors
};

CaseMesh describeMesh(const PolyMesh& poly, const RunContext& context);

/// Returns at most `most` places, spread over `over`, `height` above faces of the named patches. Lengths in meters.
std::vector<Vec3> probePlaces(const PolyMesh& poly, const std::vector<std::string>& ground, const Box3& over,
                              double height, std::size_t most);

} // namespace atria
