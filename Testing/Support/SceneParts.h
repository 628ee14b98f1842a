// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of random scenes: bodies and sheets with what they add to the areas and volumes of the mesh.
#pragma once

#include "Support/Scenes.h"

#include <cmath>
#include <random>
#include <string>

namespace atria::testing {

/// Scenes outdoors are within 8 m of its middle, so that they can be turned in it.
inline const Box3 openAir{Vec3(-10, -10, 0), Vec3(10, 10, 10)};

/// Draws lengths and choices. Half of the seeds give multiples of a quarter of a meter, which fall on planes of the
/// grid.
class SceneDraw
{
public:
  explicit SceneDraw(unsigned seed) : random_(seed), isRound_(seed / 2 % 2 == 0) {}

  double length(double from, double to)
  {
    const double value = std::uniform_real_distribution<double>(from, to)(random_);
    return isRound_ ? std::round(4.0 * value) / 4.0 : value;
  }
  int count(int from, int to) { return std::uniform_int_distribution<int>(from, to)(random_); }
  bool chance() { return count(0, 1) == 1; }

  /// Returns the same surfaces in another order.
  TriangleSurface shuffled(const TriangleSurface& surface);

private:
  std::mt19937 random_;
  bool isRound_;
};

/// Returns the area of the upright sides of a box.
double wallsOf(const Vec3& size);

/// Returns the area of the bottom of a box.
double floorOf(const Vec3& size);

/// Returns the box of a size that stands at height `base`, around a place.
Box3 standing(double x, double y, const Vec3& size, double base = 0.0);

/// Returns an empty scene in the open air.
Scene outdoors();

/// Returns an empty scene whose domain is the model's bounds.
Scene indoors();

/// Turns the triangles of the surface that was added last.
void flipLast(TriangleSurface& surface);

/// Adds a box whose part above `ground` is in the open.
void addStanding(Scene& scene, const std::string& name, const Box3& box, double ground = 0.0);

/// Adds a sheet that lies on a wall, of which it takes the area.
void addPane(Scene& scene, SceneDraw& draw, const std::string& name, const std::string& wall, const Vec3& corner,
             const Vec3& u, const Vec3& v);

/// Adds a closed solid over a ring of two rectangles.
void addRing(TriangleSurface& surface, const std::string& name, const Box3& outer, const Box3& inner);

} // namespace atria::testing
