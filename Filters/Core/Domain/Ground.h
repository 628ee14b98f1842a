// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Which surfaces, by id, are ground: terrain, or the site.
using SurfaceFlags = std::vector<char>;

/// Height of the ground below a place: of the highest of its triangles over that place, and beside the ground of its
/// nearest point. Without ground, a level plane.
class Ground
{
public:
  /// `level` is the height where there are no triangles of ground. Keeps a reference to the surface.
  Ground(const TriangleSurface& surface, const SurfaceFlags& isGround, double level);

  double heightAt(double x, double y) const;
  bool empty() const { return triangles.empty(); }
  /// Of the ground's triangles; empty without.
  const Box3& bounds() const { return box; }

private:
  std::size_t binOf(double value, int axis) const;

  const TriangleSurface& surface;
  double level;
  Box3 box;
  std::vector<Index> triangles;
  std::size_t bins = 1; ///< a side
  std::vector<std::vector<Index>> inBin;
};

} // namespace atria
