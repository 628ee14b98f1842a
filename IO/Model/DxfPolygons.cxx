// SPDX-License-Identifier: GPL-3.0-or-later
#include "DxfPolygons.h"

#include "DxfGeometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace atria::model::dxf {

std::optional<Outline> outlineOfCircle(const Entity& circle)
{
  constexpr double step = 10.0;
  const auto center = circle.point(10);
  const double radius = circle.number(40, 0.0).value_or(0.0);
  const bool isWhole = circle.type == "CIRCLE";
  const double from = isWhole ? 0.0 : circle.number(50, 0.0).value_or(0.0);
  double to = isWhole ? 360.0 : circle.number(51, 360.0).value_or(360.0);
  to += to <= from ? 360.0 : 0.0;
  if (!center || !(radius > 0.0) || !(to - from <= 360.0))
  {
    return std::nullopt;
  }
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)));
  Outline outline{{}, isWhole};
  for (int i = 0; i < pieces + (isWhole ? 0 : 1); ++i)
  {
    const double angle = radians * (from + (to - from) * i / pieces);
    outline.points.emplace_back(*center + radius * Vec3(std::cos(angle), std::sin(angle), 0.0));
  }
  return outline;
}

Outline outlineOfLightPolyline(const Entity& polyline)
{
  std::vector<Corner> corners;
  std::size_t damaged = 0;
  const double elevation = polyline.number(38, 0.0).value_or(0.0);
  for (std::size_t i = 0; i < polyline.groups.size(); ++i)
  {
    const Entity rest{polyline.type, polyline.groups.subspan(i)};
    const int code = polyline.groups[i].code;
    if (code == 10)
    {
      const auto x = rest.number(10, 0.0);
      const auto y = rest.number(20, 0.0);
      damaged += x && y ? 0 : 1;
      corners.push_back({Vec3(x.value_or(0.0), y.value_or(0.0), elevation)});
    }
    else if (code == 42 && !corners.empty())
    {
      corners.back().bulge = rest.number(42, 0.0).value_or(0.0);
    }
  }
  const bool isClosed = (polyline.integer(70, 0).value_or(0) & 1) != 0;
  return {withArcs(corners, isClosed), isClosed, damaged};
}

Outline outlineOfPolyline(const Entity& polyline, std::span<const Entity> vertices)
{
  std::vector<Corner> corners;
  std::size_t damaged = 0;
  for (const Entity& vertex : vertices)
  {
    const auto point = vertex.point(10);
    damaged += point ? 0 : 1;
    corners.push_back({point.value_or(Vec3::Zero()), vertex.number(42, 0.0).value_or(0.0)});
  }
  const bool isClosed = (polyline.integer(70, 0).value_or(0) & 1) != 0;
  return {withArcs(corners, isClosed), isClosed, damaged};
}

std::optional<Polygon> cornersOfFace(const Entity& face)
{
  Polygon corners;
  for (const int code : {10, 11, 12, 13})
  {
    const auto corner = face.has(code)    ? face.point(code)
                        : corners.empty() ? std::nullopt
                                          : std::optional(corners.back());
    if (!corner)
    {
      return std::nullopt;
    }
    corners.push_back(*corner);
  }
  return corners;
}

std::optional<Polygon> cornersOfSolid(const Entity& solid)
{
  Polygon corners;
  for (const int code : {10, 11, 13, 12}) // the file has the last two in the other order
  {
    const auto corner = solid.point(solid.has(code) ? code : 12);
    if (!corner)
    {
      return std::nullopt;
    }
    corners.push_back(*corner);
  }
  return corners;
}

Faces facesOfGrid(const Entity& polyline, std::span<const Entity> vertices)
{
  constexpr int isSmooth = 4;
  constexpr int isControlPoint = 16;
  const int flags = polyline.integer(70, 0).value_or(0);
  const bool smooth = (flags & isSmooth) != 0;
  std::vector<Vec3> points;
  for (const Entity& vertex : vertices)
  {
    const bool isControl = (vertex.integer(70, 0).value_or(0) & isControlPoint) != 0;
    const auto point = vertex.point(10);
    if (point && !(smooth && isControl))
    {
      points.push_back(*point);
    }
  }
  const int rows = polyline.integer(smooth ? 73 : 71, 0).value_or(0);
  const int columns = polyline.integer(smooth ? 74 : 72, 0).value_or(0);
  if (rows < 2 || columns < 2 || points.size() != std::size_t(rows) * std::size_t(columns))
  {
    return {{}, 1};
  }
  const auto at = [&](int row, int column) { return points[std::size_t(row % rows) * columns + column % columns]; };
  const int rowEnd = (flags & 1) != 0 ? rows : rows - 1;
  const int columnEnd = (flags & 32) != 0 ? columns : columns - 1;
  Faces faces;
  for (int row = 0; row < rowEnd; ++row)
  {
    for (int column = 0; column < columnEnd; ++column)
    {
      faces.polygons.push_back({at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)});
    }
  }
  return faces;
}

Faces facesOfMesh(const Entity& mesh)
{
  // Points, then a list of faces, each behind the number of its corners.
  std::vector<Vec3> points;
  std::vector<int> list;
  std::size_t wanted = 0;
  for (std::size_t i = 0; i < mesh.groups.size(); ++i)
  {
    const Entity rest{mesh.type, mesh.groups.subspan(i)};
    const int code = mesh.groups[i].code;
    if (code == 10)
    {
      points.push_back(rest.point(10).value_or(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
    }
    else if (code == 93)
    {
      wanted = static_cast<std::size_t>(std::max(0, rest.integer(93, 0).value_or(0)));
    }
    else if (code == 90 && list.size() < wanted)
    {
      list.push_back(rest.integer(90, -1).value_or(-1));
    }
  }
  Faces faces;
  for (std::size_t at = 0; at < list.size();)
  {
    const auto size = static_cast<std::size_t>(std::max(0, list[at]));
    const std::size_t end = std::min(at + 1 + size, list.size());
    Polygon corners;
    for (std::size_t k = at + 1; k < end; ++k)
    {
      if (const int id = list[k]; id >= 0 && static_cast<std::size_t>(id) < points.size())
      {
        corners.push_back(points[static_cast<std::size_t>(id)]);
      }
    }
    at = end;
    if (corners.size() == size)
    {
      faces.polygons.push_back(std::move(corners));
    }
    else
    {
      ++faces.damaged;
    }
  }
  return faces;
}

} // namespace atria::model::dxf
