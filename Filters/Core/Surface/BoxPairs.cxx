// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/BoxPairs.h"

#include <CGAL/box_intersection_d.h>

namespace atria {

namespace {

/// What CGAL asks of a box; coordinates of the lattice are exact in double.
struct BoxTraits
{
  using Box_parameter = const LatticeBox&;
  using NT = double;
  using ID = std::size_t;

  static NT min_coord(Box_parameter b, int axis) { return static_cast<NT>(b.low[axis]); }
  static NT max_coord(Box_parameter b, int axis) { return static_cast<NT>(b.high[axis]); }
  static ID id(Box_parameter b) { return b.id; }
  static int dimension() { return 3; }
};

} // namespace

LatticeBox boxOf(const TriangleSoup& soup, Index triangle, std::int64_t margin)
{
  LatticeBox box{soup.corner(triangle, 0), soup.corner(triangle, 0), triangle};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 1; i < 3; ++i)
    {
      box.low[axis] = std::min(box.low[axis], soup.corner(triangle, i)[axis]);
      box.high[axis] = std::max(box.high[axis], soup.corner(triangle, i)[axis]);
    }
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
  return box;
}

void forBoxPairs(std::vector<LatticeBox>& first, std::vector<LatticeBox>& second,
                 const std::function<void(Index, Index)>& visit)
{
  CGAL::box_intersection_custom_predicates_d(
      first.begin(), first.end(), second.begin(), second.end(),
      [&](const LatticeBox& a, const LatticeBox& b) { visit(a.id, b.id); },
      CGAL::Box_intersection_d::Predicate_traits_d<BoxTraits, true>(), std::ptrdiff_t{10},
      CGAL::Box_intersection_d::BIPARTITE);
}

} // namespace atria
