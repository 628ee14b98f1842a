// SPDX-License-Identifier: GPL-3.0-or-later
/// Exact predicates on lattice points, without ties.
///
/// All grid points are thought to be shifted by one and the same symbolic (e, e^2, e^3), e infinitesimal and positive
/// (simulation of simplicity, Edelsbrunner and Mücke 1990). No grid point then lies on a surface and no grid edge meets
/// a triangle's edge, and every decision is that of one real, generic configuration: a closed surface is crossed an
/// even number of times by every closed path of grid edges, whatever coincides.
#pragma once

#include "Grid/GridFrame.h"

#ifndef __SIZEOF_INT128__
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace atria {

#ifdef __SIZEOF_INT128__
__extension__ using Wide = __int128;
#else
using Wide = boost::multiprecision::int128_t;
#endif

inline int signOf(Wide value) { return value > 0 ? 1 : (value < 0 ? -1 : 0); }

/// Returns twice the area of (a, b, c) projected along `axis`, positive if counterclockwise seen from its positive end.
inline Wide projectedArea(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, int axis)
{
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return Wide(b[u] - a[u]) * (c[v] - a[v]) - Wide(b[v] - a[v]) * (c[u] - a[u]);
}

/// Returns the side of the line a-b, projected along `axis`, on which the shifted grid point p lies. Zero only where a
/// and b project to one point.
inline int sideOfLine(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p, int axis)
{
  const int sign = signOf(projectedArea(a, b, p, axis));
  if (sign != 0)
  {
    return sign;
  }
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  const int byU = signOf(a[v] - b[v]);
  const int byV = signOf(b[u] - a[u]);
  const int first = u < v ? byU : byV;
  return first != 0 ? first : (u < v ? byV : byU);
}

/// The normal of a triangle, exact.
struct LatticeNormal
{
  std::array<Wide, 3> n;

  LatticeNormal(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
      : n{projectedArea(a, b, c, 0), projectedArea(a, b, c, 1), projectedArea(a, b, c, 2)}
  {
  }

  /// Returns the side of the plane through `a` on which the shifted grid point p lies. Zero only where the triangle has
  /// no area.
  int sideOf(const LatticePoint& a, const LatticePoint& p) const
  {
    const int sign = signOf(n[0] * (p[0] - a[0]) + n[1] * (p[1] - a[1]) + n[2] * (p[2] - a[2]));
    for (int axis = 0; sign == 0 && axis < 3; ++axis)
    {
      if (n[axis] != 0)
      {
        return signOf(n[axis]);
      }
    }
    return sign;
  }
};

/// True if the line through the shifted grid point p along `axis` passes through the triangle.
inline bool lineMeetsTriangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                              const LatticePoint& p, int axis)
{
  const int winding = signOf(projectedArea(a, b, c, axis));
  return winding != 0 && sideOfLine(a, b, p, axis) == winding && sideOfLine(b, c, p, axis) == winding &&
         sideOfLine(c, a, p, axis) == winding;
}

/// Returns the side of the line a-b on which the line from p to q passes, both shifted alike. Zero only where they are
/// parallel.
inline int sideOfSegment(const LatticePoint& p, const LatticePoint& q, const LatticePoint& a, const LatticePoint& b)
{
  const auto minus = [](const LatticePoint& l, const LatticePoint& r) {
    return LatticePoint{l[0] - r[0], l[1] - r[1], l[2] - r[2]};
  };
  const auto cross = [](const LatticePoint& l, const LatticePoint& r) {
    return std::array<Wide, 3>{Wide(l[1]) * r[2] - Wide(l[2]) * r[1], Wide(l[2]) * r[0] - Wide(l[0]) * r[2],
                               Wide(l[0]) * r[1] - Wide(l[1]) * r[0]};
  };
  const LatticePoint along = minus(q, p);
  const std::array<Wide, 3> n = cross(minus(a, p), minus(b, p));
  int sign = signOf(n[0] * along[0] + n[1] * along[1] + n[2] * along[2]);
  const std::array<Wide, 3> shift = cross(minus(a, b), along);
  for (int axis = 0; sign == 0 && axis < 3; ++axis)
  {
    sign = signOf(shift[axis]);
  }
  return sign;
}

/// True if the line through the shifted grid points p and q passes through the triangle.
inline bool lineMeetsTriangle(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                              const LatticePoint& p, const LatticePoint& q)
{
  const int first = sideOfSegment(p, q, a, b);
  return first != 0 && sideOfSegment(p, q, b, c) == first && sideOfSegment(p, q, c, a) == first;
}

} // namespace atria
