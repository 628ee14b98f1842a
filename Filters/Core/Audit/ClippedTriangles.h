// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures the part of triangles that lies in a domain.
#pragma once

#include "Grid/Prism.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// A convex region between planes.
class ConvexRegion
{
public:
  /// Points beyond a plane by no more than `tolerance` count as within, such as a base on the domain's bottom.
  ConvexRegion(const Box3& box, double tolerance);
  /// Coordinates are along the prism's axes.
  ConvexRegion(const PlacedPrism& prism, double tolerance);

  /// The part of a triangle within the region: its area, and the integral over it of the height above `level`. Both are
  /// 0 if no part lies within.
  struct Part
  {
    double area = 0.0;
    double heightTimesArea = 0.0;
  };
  Part within(const Vec3& a, const Vec3& b, const Vec3& c, double level) const;

private:
  struct Plane
  {
    Vec3 normal; ///< outwards, a unit vector
    double offset;
    double beyond(const Vec3& p) const { return normal.dot(p) - offset; }
  };
  Box3 bounds_; ///< all of this box lies in the region; empty if no such box is known
  std::vector<Plane> planes_;
};

/// The surfaces as drawn, with one entry per surface in each list.
struct DrawnSurfaces
{
  /// Within the domain, in square model units. Duplicate faces count twice.
  std::vector<double> areas;
  /// Beyond the domain's sides or below its bottom, in square model units.
  std::vector<double> outside;
  /// The diagonals of the surfaces' bounds, in model units.
  std::vector<double> extents;
};

/// Measures the surfaces of a model. `tolerance` is that of ConvexRegion. O(triangles).
DrawnSurfaces measureDrawn(const TriangleSurface& surface, const PlacedPrism& domain, double tolerance);

} // namespace atria
