// SPDX-License-Identifier: GPL-3.0-or-later
/// Models as dirty as those that come, with what is known about their spaces.
#pragma once

#include "Grid/GridFrame.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

namespace atria::testing {

struct DirtySoup
{
  struct Seed
  {
    Vec3 point; ///< at least two octants away from all surfaces, but for furniture
    int space;  ///< equal where a way leads from one to the other; 0 is the open
  };

  TriangleSurface surface;
  GridOptions grid;
  std::vector<Seed> seeds;
  /// Surfaces so large and alone that the mesh must have faces of theirs.
  std::vector<Index> large;
  /// What it is made of, for messages.
  std::string description;
};

/// Rooms of at least five octants, sealed or with openings of three octants and more; next to each other with doubled
/// walls; divided by partitions that stop short of the walls, touch them or reach through; with gaps far below the
/// octants' size, which are closed, or well above, which are open; with free sheets through walls and within rooms,
/// slivers, repeated and reversed triangles. No triangle shares points with another by index, walls are cut into
/// triangles without regard to each other. All of it turned (not, about the vertical, or at will) and far from the
/// origin or near. The same for the same seed.
DirtySoup dirtySoup(unsigned seed);

} // namespace atria::testing
