// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace atria::testing {

void addSurface(TriangleSurface& to, const std::string& name, const std::vector<Vec3>& points,
                const std::vector<std::array<Index, 3>>& triangles)
{
  const auto base = static_cast<Index>(to.points.size());
  const auto id = static_cast<Index>(to.names.size());
  to.names.push_back(name);
  to.points.insert(to.points.end(), points.begin(), points.end());
  for (const auto& t : triangles)
  {
    to.triangles.push_back({base + t[0], base + t[1], base + t[2]});
    to.surfaceIds.push_back(id);
  }
}

TriangleSurface inOrder(const TriangleSurface& surface, const std::vector<Index>& order)
{
  TriangleSurface out;
  for (const Index id : order)
  {
    std::vector<std::array<Index, 3>> triangles;
    for (Index t = 0; t < surface.triangles.size(); ++t)
    {
      if (surface.surfaceIds[t] == id)
      {
        triangles.push_back(surface.triangles[t]);
      }
    }
    addSurface(out, surface.names[id], surface.points, triangles);
  }
  return out;
}

void addSheet(TriangleSurface& to, const std::string& name, const Vec3& corner, const Vec3& u, const Vec3& v)
{
  addSurface(to, name, {corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}});
}

void addBox(TriangleSurface& to, const std::string& name, const Box3& box)
{
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i)
  {
    points.emplace_back(i & 1 ? box.max[0] : box.min[0], i & 2 ? box.max[1] : box.min[1],
                        i & 4 ? box.max[2] : box.min[2]);
  }
  std::vector<std::array<Index, 3>> triangles;
  const std::array<Index, 4> quads[6] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (const auto& q : quads)
  {
    triangles.push_back({q[0], q[1], q[2]});
    triangles.push_back({q[0], q[2], q[3]});
  }
  addSurface(to, name, points, triangles);
}

void addPrism(TriangleSurface& to, const std::string& name, const std::vector<Eigen::Vector2d>& polygon, double bottom,
              double top)
{
  const auto n = static_cast<Index>(polygon.size());
  std::vector<Vec3> points;
  for (const double z : {bottom, top})
  {
    for (const Eigen::Vector2d& p : polygon)
    {
      points.emplace_back(p[0], p[1], z);
    }
  }
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < n; ++i)
  {
    const Index next = (i + 1) % n;
    triangles.push_back({i, next, n + next});
    triangles.push_back({i, n + next, n + i});
    if (i > 0 && next > 0)
    {
      triangles.push_back({0, next, i});
      triangles.push_back({n, n + i, n + next});
    }
  }
  addSurface(to, name, points, triangles);
}

std::vector<Eigen::Vector2d> regularPolygon(int corners, double radius)
{
  std::vector<Eigen::Vector2d> out;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    out.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return out;
}

void addTube(TriangleSurface& to, const std::string& name, const Vec3& begin, const Vec3& end, double radius,
             Index facets)
{
  const Vec3 along = (end - begin).normalized();
  const Vec3 u = along.unitOrthogonal();
  const Vec3 v = along.cross(u);
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i < facets; ++i)
  {
    const double angle = 2.0 * std::numbers::pi * i / facets;
    const Vec3 out = radius * (std::cos(angle) * u + std::sin(angle) * v);
    points.insert(points.end(), {begin + out, end + out});
    const Index next = (i + 1) % facets;
    triangles.insert(triangles.end(), {{2 * i, 2 * next, 2 * next + 1}, {2 * i, 2 * next + 1, 2 * i + 1}});
  }
  addSurface(to, name, points, triangles);
}

void addSphere(TriangleSurface& to, const std::string& name, const Vec3& center, double radius, int subdivisions)
{
  const double g = std::numbers::phi;
  std::vector<Vec3> p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<Index, 3>> t{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < subdivisions; ++level)
  {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [found, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<Index>(p.size()));
      if (isNew)
      {
        p.push_back(0.5 * (p[a] + p[b]));
      }
      return found->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : t)
    {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    t = std::move(finer);
  }
  for (Vec3& q : p)
  {
    q = center + radius * q.normalized();
  }
  addSurface(to, name, p, t);
}

void turn(TriangleSurface& surface, double degrees)
{
  const Eigen::AngleAxisd rotation(degrees * std::numbers::pi / 180.0, Vec3::UnitZ());
  for (Vec3& p : surface.points)
  {
    p = rotation * p;
  }
}

TriangleSurface sphereInCube(int subdivisions)
{
  TriangleSurface surface;
  addBox(surface, "Cube", {Vec3::Constant(-5.0), Vec3::Constant(5.0)});
  addSphere(surface, "Sphere", Vec3::Zero(), 2.0, subdivisions);
  return surface;
}

/// Sheets along one axis have none.
bool hasArea(const TriangleSurface& surface)
{
  return std::ranges::any_of(surface.triangles, [&](const std::array<Index, 3>& t) {
    const Vec3& a = surface.points[t[0]];
    return !(surface.points[t[1]] - a).cross(surface.points[t[2]] - a).isZero();
  });
}

TriangleSurface randomSoup(unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> length(0.5, 3.0);
  const bool round = random() % 2 == 0;
  const auto value = [&](auto& distribution) {
    const double x = distribution(random);
    return round ? std::round(2.0 * x) / 2.0 : x;
  };
  const auto point = [&] { return Vec3(value(place), value(place), value(place)); };
  TriangleSurface soup;
  const int count = 1 + static_cast<int>(random() % 6);
  for (int i = 0; i < count; ++i)
  {
    const std::string name = std::string("S").append(std::to_string(i));
    const Vec3 at = point();
    switch (random() % 4)
    {
      case 0:
        addBox(soup, name, {at, at + Vec3(value(length), value(length), value(length)) + Vec3::Constant(0.01)});
        break;
      case 1:
        addSphere(soup, name, at, 0.3 + 0.3 * length(random), 1 + static_cast<int>(random() % 3));
        break;
      case 2:
        addSheet(soup, name, at, value(length) * Vec3::Unit(random() % 3), value(length) * Vec3::Unit(random() % 3));
        break;
      default:
        addSheet(soup, name, at, point() - at, point() - at);
    }
  }
  if (random() % 3 == 0)
  {
    turn(soup, random() % 2 ? 90.0 : 17.0);
  }
  if (!hasArea(soup))
  {
    addBox(soup, "Solid", {Vec3::Constant(-1.0), Vec3::Constant(1.0)});
  }
  return soup;
}

} // namespace atria::testing
