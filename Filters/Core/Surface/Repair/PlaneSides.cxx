// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/PlaneSides.h"

#include <Eigen/Geometry>

namespace atria {

namespace {

/// Largest error of distances in double precision, in lattice units. If more is possible, the distance is found
/// exactly.
constexpr double accuracy = 0.01;
constexpr double rounding = 1e-15;

double lengthOf(const LatticeNormal& normal)
{
  return std::hypot(static_cast<double>(normal.n[0]), static_cast<double>(normal.n[1]),
                    static_cast<double>(normal.n[2]));
}

} // namespace

PlaneSides::PlaneSides(const TriangleSoup& of, Index seen, Index from, double reach)
    : soup(of), triangle(seen), plane(from)
{
  const Vec3 a = between(soup.corner(from, 0), soup.corner(from, 1));
  const Vec3 b = between(soup.corner(from, 0), soup.corner(from, 2));
  const Vec3 rough = a.cross(b);
  const double length = rough.norm();
  const double error = rounding * a.lpNorm<1>() * b.lpNorm<1>();
  int above = 0;
  int below = 0;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    if (contains(soup.triangles[from], soup.triangles[triangle][i]))
    {
      ++shared;
      continue;
    }
    const Vec3 way = between(soup.corner(from, 0), soup.corner(triangle, i));
    if (error * way.lpNorm<1>() < accuracy * length)
    {
      distances[i] = rough.dot(way) / length;
    }
    else if (const double exactLength = lengthOf(normal()); exactLength > 0.0)
    {
      distances[i] = static_cast<double>(exact(i)) / exactLength;
    }
    above += distances[i] > reach ? 1 : 0;
    below += distances[i] < -reach ? 1 : 0;
  }
  isApart = above + below > 0 && (above + shared == 3 || below + shared == 3);
}

int PlaneSides::sign(int corner) const
{
  return std::abs(distances[corner]) > accuracy ? (distances[corner] > 0.0 ? 1 : -1) : signOf(exact(corner));
}

Wide PlaneSides::exact(int corner) const
{
  const LatticeNormal of = normal();
  const LatticePoint& origin = soup.corner(plane, 0);
  const LatticePoint& p = soup.corner(triangle, corner);
  Wide sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += of.n[axis] * (p[axis] - origin[axis]);
  }
  return sum;
}

PlaneSides::Passage PlaneSides::passage(int corner, int next) const
{
  const Vec3 edge = between(soup.corner(triangle, corner), soup.corner(triangle, next));
  const double rise = distances[corner] - distances[next];
  return {toVector(soup.corner(triangle, corner)) + distances[corner] / rise * edge,
          2.0 * accuracy / std::abs(rise) * edge.norm()};
}

LatticeNormal PlaneSides::normal() const
{
  return {soup.corner(plane, 0), soup.corner(plane, 1), soup.corner(plane, 2)};
}

} // namespace atria
