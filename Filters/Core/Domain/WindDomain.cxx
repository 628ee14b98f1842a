// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/WindDomain.h"

#include "Support/Error.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

struct Span
{
  double low;
  double high;
};

/// Projected triangle with its range along y.
struct Shadow
{
  std::array<Eigen::Vector2d, 3> points;
  double left;
  double right;
};

std::vector<Shadow> shadowsOf(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes)
{
  std::vector<Shadow> shadows;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    if (isGround[surface.surfaceIds[t]])
    {
      continue;
    }
    Shadow shadow;
    for (int i = 0; i < 3; ++i)
    {
      shadow.points[i] = axes.fromModel(surface.points[surface.triangles[t][i]]).tail<2>();
    }
    const auto [left, right] = std::minmax({shadow.points[0][0], shadow.points[1][0], shadow.points[2][0]});
    shadow.left = left;
    shadow.right = right;
    if (right > left)
    {
      shadows.push_back(shadow);
    }
  }
  std::sort(shadows.begin(), shadows.end(), [](const Shadow& l, const Shadow& r) { return l.left < r.left; });
  return shadows;
}

/// Returns the span in which the upright line at y meets the triangle. They must meet: y is within the triangle's
/// range.
Span spanAt(const Shadow& shadow, double y)
{
  Span span{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (int i = 0; i < 3; ++i)
  {
    const auto& p = shadow.points[i];
    const auto& q = shadow.points[(i + 1) % 3];
    if (std::min(p[0], q[0]) <= y && y <= std::max(p[0], q[0]) && p[0] != q[0])
    {
      const double z = p[1] + (y - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
      span = {std::min(span.low, z), std::max(span.high, z)};
    }
  }
  return span;
}

/// Returns the length of the union of the spans above `floor`.
double covered(std::vector<Span>& spans, double floor)
{
  std::sort(spans.begin(), spans.end(), [](const Span& l, const Span& r) { return l.low < r.low; });
  double length = 0.0;
  double reached = floor;
  for (const Span& span : spans)
  {
    length += std::max(0.0, span.high - std::max(span.low, reached));
    reached = std::max(reached, span.high);
  }
  return length;
}

/// Returns the ends of the strips to integrate over: equal ones, and the projected points if they are not many.
std::vector<double> stripsOf(const std::vector<Shadow>& shadows)
{
  constexpr std::size_t equalStrips = 2048;
  std::vector<double> stops;
  for (const Shadow& shadow : shadows)
  {
    for (const auto& p : shadow.points)
    {
      stops.push_back(p[0]);
    }
  }
  sortUnique(stops);
  const double low = stops.front();
  const double high = stops.back();
  if (stops.size() > equalStrips)
  {
    stops = {low, high};
  }
  for (std::size_t i = 1; i < equalStrips; ++i)
  {
    stops.push_back(low + static_cast<double>(i) * (high - low) / equalStrips);
  }
  sortUnique(stops);
  return stops;
}

} // namespace

Box3 boundsOfBuildings(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes)
{
  Box3 box;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      if (!isGround[surface.surfaceIds[t]])
      {
        box.extend(axes.fromModel(surface.points[p]));
      }
    }
  }
  return box;
}

double lowestGround(const TriangleSurface& surface, const WindGround& wind)
{
  const Box3 buildings = boundsOfBuildings(surface, wind.isGround, {});
  const Ground ground(surface, wind.isGround, 0.0);
  return wind.floor           ? *wind.floor
         : !ground.empty()    ? ground.bounds().min[2]
         : !buildings.empty() ? buildings.min[2]
                              : 0.0;
}

double heightOfBuildings(const TriangleSurface& surface, const WindGround& wind)
{
  const SurfaceFlags& isGround = wind.isGround;
  const Box3 box = boundsOfBuildings(surface, isGround, {});
  if (box.empty())
  {
    return 0.0;
  }
  const Ground ground(surface, isGround, wind.floor.value_or(box.min[2]));
  std::vector<char> seen(surface.points.size(), 0);
  double height = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      if (!isGround[surface.surfaceIds[t]] && !seen[p])
      {
        seen[p] = 1;
        const Vec3& q = surface.points[p];
        height = std::max(height, q[2] - ground.heightAt(q[0], q[1]));
      }
    }
  }
  return height;
}

double frontalArea(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes, double floor)
{
  const std::vector<Shadow> shadows = shadowsOf(surface, isGround, axes);
  if (shadows.empty())
  {
    return 0.0;
  }
  const std::vector<double> strips = stripsOf(shadows);
  std::vector<Index> active;
  std::vector<Span> spans;
  std::size_t next = 0;
  double area = 0.0;
  for (std::size_t i = 0; i + 1 < strips.size(); ++i)
  {
    const double y = 0.5 * (strips[i] + strips[i + 1]);
    for (; next < shadows.size() && shadows[next].left <= y; ++next)
    {
      active.push_back(static_cast<Index>(next));
    }
    std::erase_if(active, [&](Index s) { return shadows[s].right < y; });
    spans.clear();
    for (const Index s : active)
    {
      spans.push_back(spanAt(shadows[s], y));
    }
    area += covered(spans, floor) * (strips[i + 1] - strips[i]);
  }
  return area;
}

namespace {

/// Returns the factor f with (width + 2 side f)(rise + top f) = needed; 1 if the section is large enough.
double widening(double width, double side, double rise, double top, double needed)
{
  if ((width + 2.0 * side) * (rise + top) >= needed)
  {
    return 1.0;
  }
  const double square = 2.0 * side * top;
  const double linear = width * top + 2.0 * side * rise;
  const double constant = width * rise - needed;
  return (-linear + std::sqrt(linear * linear - 4.0 * square * constant)) / (2.0 * square);
}

/// Returns the largest frontal area for wind square to a side of a prism.
double frontalAreaAround(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes,
                         double floor, int sideCount)
{
  double area = 0.0;
  const bool pairs = sideCount % 2 == 0; // opposite sides see the same
  for (int i = 0; i < (pairs ? sideCount / 2 : sideCount); ++i)
  {
    area = std::max(area, frontalArea(surface, isGround, Placement(axes.angle() + 360.0 * i / sideCount), floor));
  }
  return area;
}

double radiusAbout(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes,
                   const Vec2& middle)
{
  double radius = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      const double away = (axes.fromModel(surface.points[p]).head<2>() - middle).norm();
      radius = isGround[surface.surfaceIds[t]] ? radius : std::max(radius, away);
    }
  }
  return radius;
}

/// Returns the largest height of the buildings. Throws Error if there are none.
double neededHeight(const TriangleSurface& surface, const WindGround& ground)
{
  const double height = heightOfBuildings(surface, ground);
  if (!(height > 0.0))
  {
    throw Error("there are no buildings to take the domain from: every surface is ground or lies flat; connect the "
                "buildings, correct SiteName and TerrainName, or choose another domain: above the site "
                "(DomainMode Site), the model's bounds (DomainMode FromSurfaces) or a given box "
                "(DomainMode Explicit)");
  }
  return height;
}

} // namespace

std::array<double, 2> windHeights(const TriangleSurface& surface, const WindGround& ground, const WindRules& rules)
{
  const double height = neededHeight(surface, ground);
  const Box3 buildings = boundsOfBuildings(surface, ground.isGround, {});
  return {lowestGround(surface, ground), buildings.max[2] + rules.topHeights * height};
}

WindDomain windDomain(const TriangleSurface& surface, const WindGround& ground, double windAngle, int sideCount,
                      const WindRules& rules)
{
  const SurfaceFlags& isGround = ground.isGround;
  WindDomain out;
  out.box.axes = Placement(windAngle);
  out.buildings = boundsOfBuildings(surface, isGround, out.box.axes);
  out.height = neededHeight(surface, ground);
  const double floor = lowestGround(surface, ground);
  const Box3& b = out.buildings;
  const double rise = b.max[2] - floor;
  if (sideCount != 4)
  {
    const Vec2 middle = b.center().head<2>();
    const double radius = radiusAbout(surface, isGround, out.box.axes, middle);
    const double needed = frontalAreaAround(surface, isGround, out.box.axes, floor, sideCount) / rules.mostBlockage;
    const double away = rules.outletHeights * out.height;
    const double top = rules.topHeights * out.height;
    out.widened = widening(2.0 * radius, away, rise, top, needed);
    out.box.bounds =
        boundsAboutCircle(middle, radius + out.widened * away, sideCount, floor, b.max[2] + out.widened * top);
    return out;
  }
  const double needed = frontalArea(surface, isGround, out.box.axes, floor) / rules.mostBlockage;
  double side = rules.sideHeights * out.height;
  double top = rules.topHeights * out.height;
  out.widened = widening(b.size()[1], side, rise, top, needed);
  side *= out.widened;
  top *= out.widened;
  out.box.bounds.min = {b.min[0] - rules.inletHeights * out.height, b.min[1] - side, floor};
  out.box.bounds.max = {b.max[0] + rules.outletHeights * out.height, b.max[1] + side, b.max[2] + top};
  return out;
}

} // namespace atria
