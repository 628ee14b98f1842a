// SPDX-License-Identifier: GPL-3.0-or-later
/// Answers how high the ground is below a place.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// One flag per surface: nonzero if it is ground, that is terrain or the site.
using SurfaceFlags = std::vector<char>;

/// Height of the ground below a place. It is that of the highest ground triangle over the place. Beside the ground it
/// is that of the nearest point of the ground, and without ground that of a level plane.
class Ground
{
public:
  /// `level` is the height if there are no triangles of ground. Keeps a reference to the surface.
  Ground(const TriangleSurface& surface, const SurfaceFlags& isGround, double level);

  double heightAt(double x, double y) const;
  bool empty() const { return triangles.empty(); }
  /// Returns the bounds of the ground's triangles; empty without any.
  const Box3& bounds() const { return box; }

private:
  std::size_t binOf(double value, int axis) const;

  const TriangleSurface& surface;
  double level;
  Box3 box;
  std::vector<Index> triangles;
  std::size_t bins = 1; ///< number along each side
  std::vector<std::vector<Index>> inBin;
};

} // namespace atria
