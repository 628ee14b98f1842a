// SPDX-License-Identifier: GPL-3.0-or-later
#include "DxfGeometry.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria::model::dxf {

Eigen::Affine3d objectSystem(const Entity& entity)
{
  constexpr double nearZ = 1.0 / 64.0;
  Eigen::Affine3d system = Eigen::Affine3d::Identity();
  const Vec3 stated = entity.has(210) ? entity.point(210).value_or(Vec3::UnitZ()) : Vec3::UnitZ();
  if (stated.norm() > 0.0)
  {
    const Vec3 z = stated.normalized();
    const bool isUp = std::abs(z.x()) < nearZ && std::abs(z.y()) < nearZ;
    const Vec3 x = (isUp ? Vec3::UnitY() : Vec3::UnitZ()).cross(z).normalized();
    system.linear() << x, z.cross(x), z;
  }
  return system;
}

std::vector<Vec3> withArcs(const std::vector<Corner>& corners, bool isClosed)
{
  constexpr double step = 10.0 * radians;
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Corner& corner = corners[i];
    out.push_back(corner.at);
    const bool isLast = i + 1 == corners.size();
    if (corner.bulge == 0.0 || (isLast && !isClosed))
    {
      continue;
    }
    const Vec3 end = corners[isLast ? 0 : i + 1].at;
    const double angle = 4.0 * std::atan(corner.bulge);
    const Vec3 chord = end - corner.at;
    const Vec3 left(-chord.y(), chord.x(), 0.0);
    const Vec3 center = 0.5 * (corner.at + end) + left * (0.25 * (1.0 / corner.bulge - corner.bulge));
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / step - 1e-9)));
    for (int k = 1; k < pieces; ++k)
    {
      out.emplace_back(center + Eigen::AngleAxisd(angle * k / pieces, Vec3::UnitZ()) * (corner.at - center));
    }
  }
  return out;
}

double metersOf(std::string_view unit)
{
  static const std::map<std::string_view, double> units{{"1", 0.0254},  {"2", 0.3048}, {"4", 0.001},
                                                        {"5", 0.01},    {"6", 1.0},    {"7", 1000.0},
                                                        {"10", 0.9144}, {"14", 0.1},   {"21", 1200.0 / 3937.0}};
  const auto found = units.find(unit);
  return found == units.end() ? 0.0 : found->second;
}

} // namespace atria::model::dxf
