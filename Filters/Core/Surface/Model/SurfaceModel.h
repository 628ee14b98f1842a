// SPDX-License-Identifier: GPL-3.0-or-later
/// The model as the mesher sees it: on the lattice, welded, with its feature graph.
#pragma once

#include "Grid/GridFrame.h"
#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/SurfaceKind.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

namespace atria {

/// Why an edge of the model must be kept.
enum class CurveKind : std::uint8_t
{
  boundary, ///< one triangle ends there
  crease,   ///< two triangles meet at more than the feature angle
  junction, ///< three or more triangles meet
  border    ///< two named surfaces meet
};

/// An edge of the model on a feature curve.
struct FeatureEdge
{
  Index a;
  Index b;
  /// Index into `curves`.
  Index curve;
};

/// A feature curve: edges joined at points that are no corners, where the same charts meet all along.
struct FeatureCurve
{
  CurveKind kind;
  /// The charts that meet there, sorted, one entry for each triangle: a chart that goes on across the curve is listed
  /// twice.
  std::vector<Index> charts;
  /// The charts that end there, which have an odd number of entries. Empty for a fold within a chart.
  std::vector<Index> ending;
};

struct SurfaceModel
{
  static constexpr std::int8_t noSide = -1;

  std::vector<LatticePoint> points;
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: index into `names`; or the number of names plus a Direction on the sides of a turned domain.
  std::vector<Index> surfaceIds;
  /// Per triangle: the smooth piece between feature curves it belongs to.
  std::vector<Index> charts;
  /// Per triangle: the Direction of the domain side it lies on, or noSide. Such triangles refine and name the side;
  /// they are no obstacle.
  std::vector<std::int8_t> domainSides;
  std::vector<FeatureEdge> featureEdges;
  std::vector<FeatureCurve> curves;
  /// Points where curves end, meet or turn sharply.
  std::vector<Index> corners;
  std::vector<std::string> names;
  /// One entry per surface; empty if all are walls.
  std::vector<SurfaceKind> kinds;
  /// One entry for each surface that is an opening found by rule: the surface it is an opening of. These surfaces are
  /// the last of `names`.
  std::vector<Index> walls;

  /// Report on the changes to the model.
  SurfaceRepairReport repair;
  /// Same as FeatureOptions::featureAngle.
  double featureAngle = 30.0;

  /// True if a triangle is a side of a domain that stands turned in the grid (see TurnedSides.h).
  bool isTurnedSide(Index triangle) const { return surfaceIds[triangle] >= names.size(); }
  /// Returns the kind of a triangle's surface. A triangle on a side of the domain names it, whatever its kind.
  SurfaceKind kindOf(Index triangle) const
  {
    return kinds.empty() || isTurnedSide(triangle) ? SurfaceKind::wall : kinds[surfaceIds[triangle]];
  }
  /// Returns the surface that an opening belongs to; the surface itself if it was drawn.
  Index wallOf(Index surface) const
  {
    const std::size_t drawn = names.size() - walls.size();
    return surface < drawn ? surface : walls[surface - drawn];
  }
  bool isPermeable(Index triangle) const { return kindOf(triangle) != SurfaceKind::wall; }
  CurveKind kindOf(const FeatureEdge& edge) const { return curves[edge.curve].kind; }
  const LatticePoint& corner(Index triangle, int i) const { return points[triangles[triangle][i]]; }
  /// Returns the bounds of a triangle, in lattice units.
  Box3 bounds(Index triangle) const
  {
    Box3 box;
    for (int i = 0; i < 3; ++i)
    {
      box.extend(toVector(corner(triangle, i)));
    }
    return box;
  }
  /// Returns twice the triangle's area vector, in lattice units.
  Vec3 normal(Index triangle) const;
};

struct FeatureOptions
{
  /// Degrees between normals (creases) or tangents (corners) above which they are kept.
  double featureAngle = 30.0;
  /// Points closer than this (model units) are merged.
  double weldDistance = 1e-5;
  /// Triangles with all points closer than this to a domain plane lie on that side.
  double sideDistance = 1e-4;
  /// Gaps narrower than this (model units) are closed.
  double gapTolerance = 0.05;
  /// Parts of the model with a bounding box of a shorter diagonal, in octants at features, are left out; 0 leaves out
  /// none. See findSmallParts.
  double smallPartSize = 0.0;
  /// One flag per surface: nonzero if none of its parts is left out. Surfaces beyond the end may lose parts.
  std::vector<char> keptSurfaces;
  /// Same as SurfaceModel::kinds.
  std::vector<SurfaceKind> kinds;
  /// Places where octants are finer than those at features.
  std::vector<FinerPlace> finerPlaces;
};

/// Returns a surface on the lattice. Welds points, drops triangles without area and repeated ones (whatever their
/// winding; FacePrecedence says which stays), leaves out small parts and makes the model sound (repairSurface). Then
/// finds triangles on the domain's sides, charts, curves and corners. Edges of the domain box are not features: the
/// mesh has them anyway. The result does not depend on threads. Throws Aborted on demand.
SurfaceModel makeSurfaceModel(const TriangleSurface& surface, const GridFrame& frame, const FeatureOptions& options,
                              const RunContext& context);

} // namespace atria
