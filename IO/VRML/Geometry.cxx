// SPDX-License-Identifier: GPL-3.0-or-later
#include "Geometry.h"

#include "Input.h"
#include "NodeTypes.h"
#include "Sweeps.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace atria::vrml {

using scene::Diagnostics;

namespace {

/// The faces of an IndexedFaceSet, with the points they use.
class FaceSet
{
public:
  FaceSet(const Numbers& coordinates, const Integers& index, bool turned, Geometry::Memory& memory)
      : points(coordinates), count(coordinates.size() / 3), builder(turned, std::move(memory.surface)),
        newIds(memory.newIds), ids(memory.ids)
  {
    newIds.assign(count, noIndex);
    const auto ends = static_cast<std::size_t>(std::count_if(index.begin(), index.end(), [](int i) { return i < 0; }));
    const std::size_t corners = index.size() - ends;
    builder.reserve(std::min(count, corners), corners - std::min(corners, 2 * ends));
  }

  void add(std::span<const int> face)
  {
    ids.clear();
    bool repeats = face.size() > 1 && face.front() == face.back();
    for (std::size_t i = 0; i < face.size(); ++i)
    {
      if (static_cast<std::size_t>(face[i]) >= count)
      {
        ++outOfRange;
        return;
      }
      if (!isSomewhere(static_cast<std::size_t>(face[i])))
      {
        ++nowhere;
        return;
      }
      repeats = repeats || (i > 0 && face[i] == face[i - 1]);
    }
    for (const int i : face)
    {
      ids.push_back(idOf(static_cast<std::size_t>(i)));
    }
    const std::size_t flatBefore = builder.withoutArea();
    builder.polygon(ids);
    repeated += repeats && builder.withoutArea() == flatBefore ? 1 : 0;
  }

  std::string complaints() const
  {
    std::string text;
    const auto say = [&](std::size_t faces, const char* what) {
      if (faces > 0)
      {
        text += (text.empty() ? "" : "; ") + std::to_string(faces) + (faces == 1 ? " face " : " faces ") + what;
      }
    };
    say(outOfRange, "with points that do not exist, skipped");
    say(nowhere, "with points whose coordinates are no numbers, skipped");
    say(repeated, "with a point repeated in a row, taken once");
    say(builder.withoutArea(), "without area, skipped");
    say(builder.selfCrossing(), "whose outline crosses itself");
    return text;
  }

  LocalSurface take() { return builder.take(); }

private:
  bool isSomewhere(std::size_t i) const
  {
    const double* p = points.data() + 3 * i;
    return newIds[i] != noIndex || (std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]));
  }

  Index idOf(std::size_t i)
  {
    if (newIds[i] == noIndex)
    {
      newIds[i] = builder.point({points[3 * i], points[3 * i + 1], points[3 * i + 2]});
    }
    return newIds[i];
  }

  const Numbers& points;
  std::size_t count;
  SurfaceBuilder builder;
  std::vector<Index>& newIds;
  std::vector<Index>& ids;
  std::size_t outOfRange = 0;
  std::size_t nowhere = 0;
  std::size_t repeated = 0;
};

std::vector<Eigen::Vector2d> pairs(const Numbers& numbers)
{
  std::vector<Eigen::Vector2d> out;
  for (std::size_t i = 0; i + 1 < numbers.size(); i += 2)
  {
    out.emplace_back(numbers[i], numbers[i + 1]);
  }
  return out;
}

} // namespace

Geometry::Geometry(Instances& access, Diagnostics& messages, const Tessellation& tessellation)
    : instances(access), diagnostics(messages), wanted(tessellation)
{
}

bool Geometry::isRound(const NodeRef& node)
{
  const std::string_view type = node.node->type->name;
  return type == "Sphere" || type == "Cylinder" || type == "Cone";
}

LocalSurface Geometry::makeCoarse(const NodeRef& node)
{
  constexpr double angle = 360.0 / fewestSegments;
  const Tessellation kept = std::exchange(wanted, Tessellation{std::max(wanted.angle, angle)});
  LocalSurface surface = make(node);
  wanted = kept;
  return surface;
}

LocalSurface Geometry::make(const NodeRef& node)
{
  using Maker = LocalSurface (Geometry::*)(const NodeRef&);
  static const std::unordered_map<std::string_view, Maker> makers{{"Box", &Geometry::box},
                                                                  {"Cube", &Geometry::cube},
                                                                  {"Sphere", &Geometry::sphere},
                                                                  {"Cylinder", &Geometry::cylinder},
                                                                  {"Cone", &Geometry::cone},
                                                                  {"ElevationGrid", &Geometry::elevationGrid},
                                                                  {"Extrusion", &Geometry::extrusion},
                                                                  {"IndexedFaceSet", &Geometry::faceSet}};
  return (this->*makers.at(node.node->type->name))(node);
}

void Geometry::warn(const NodeRef& node, const std::string& text)
{
  diagnostics.warn(placeOf(*node.node, name) + ": " + text);
}

bool Geometry::positive(const NodeRef& node, std::initializer_list<double> sizes)
{
  const bool all = std::all_of(sizes.begin(), sizes.end(), [](double size) { return size > 0.0; });
  if (!all)
  {
    warn(node, "a size is not positive; skipped");
  }
  return all;
}

LocalSurface Geometry::box(const NodeRef& node)
{
  const std::vector<double> size = instances.numbers(node, "size", {2, 2, 2});
  return size.size() < 3 ? LocalSurface{} : boxOf(node, {size[0], size[1], size[2]});
}

/// Programs write floors and walls without thickness as boxes, too, which the standard does not allow.
LocalSurface Geometry::boxOf(const NodeRef& node, const Vec3& size)
{
  if (size.minCoeff() == 0.0 && (size.array() > 0.0).count() == 2)
  {
    warn(node, "a size is zero; taken as a sheet");
    return makeBox(size);
  }
  return positive(node, {size.x(), size.y(), size.z()}) ? makeBox(size) : LocalSurface{};
}

LocalSurface Geometry::sphere(const NodeRef& node)
{
  const double radius = instances.number(node, "radius", 1.0);
  return positive(node, {radius}) ? makeSphere(radius, segmentsOfBall(radius)) : LocalSurface{};
}

LocalSurface Geometry::cylinder(const NodeRef& node)
{
  Cylinder in;
  in.radius = instances.number(node, "radius", in.radius);
  in.height = instances.number(node, "height", in.height);
  in.side = hasPart(node, "side", "SIDES");
  in.bottom = hasPart(node, "bottom", "BOTTOM");
  in.top = hasPart(node, "top", "TOP");
  return positive(node, {in.radius, in.height}) ? makeCylinder(in, segments(in.radius)) : LocalSurface{};
}

LocalSurface Geometry::cone(const NodeRef& node)
{
  Cone in;
  in.bottomRadius = instances.number(node, "bottomRadius", in.bottomRadius);
  in.height = instances.number(node, "height", in.height);
  in.side = hasPart(node, "side", "SIDES");
  in.bottom = hasPart(node, "bottom", "BOTTOM");
  return positive(node, {in.bottomRadius, in.height}) ? makeCone(in, segments(in.bottomRadius)) : LocalSurface{};
}

LocalSurface Geometry::elevationGrid(const NodeRef& node)
{
  ElevationGrid in;
  in.xDimension = instances.integer(node, "xDimension", 0);
  in.zDimension = instances.integer(node, "zDimension", 0);
  in.xSpacing = instances.number(node, "xSpacing", in.xSpacing);
  in.zSpacing = instances.number(node, "zSpacing", in.zSpacing);
  in.height = instances.numbers(node, "height", {});
  in.ccw = instances.flag(node, "ccw", in.ccw);
  if (in.xDimension < 2 || in.zDimension < 2)
  {
    return {}; // legal: no cells
  }
  const double needed = static_cast<double>(in.xDimension) * in.zDimension;
  if (static_cast<double>(in.height.size()) < needed)
  {
    warn(node, std::to_string(in.height.size()) + " heights for a grid of " + std::to_string(in.xDimension) + " by " +
                   std::to_string(in.zDimension) + "; skipped");
    return {};
  }
  return positive(node, {in.xSpacing, in.zSpacing}) ? makeElevationGrid(in) : LocalSurface{};
}

LocalSurface Geometry::extrusion(const NodeRef& node)
{
  Extrusion in;
  if (const auto* section = instances.get<Numbers>(node, "crossSection"))
  {
    in.crossSection = pairs(*section);
  }
  if (const auto* spine = instances.get<Numbers>(node, "spine"))
  {
    in.spine.clear();
    for (std::size_t i = 0; i + 2 < spine->size(); i += 3)
    {
      in.spine.emplace_back((*spine)[i], (*spine)[i + 1], (*spine)[i + 2]);
    }
  }
  const auto* scale = instances.get<Numbers>(node, "scale");
  if (scale && scale->size() > 1)
  {
    in.scale = pairs(*scale);
  }
  const auto* orientation = instances.get<Numbers>(node, "orientation");
  if (orientation && orientation->size() > 3)
  {
    in.orientation.clear();
    for (std::size_t i = 0; i + 3 < orientation->size(); i += 4)
    {
      in.orientation.push_back(rotationOf(orientation->data() + i));
    }
  }
  in.beginCap = instances.flag(node, "beginCap", in.beginCap);
  in.endCap = instances.flag(node, "endCap", in.endCap);
  in.ccw = instances.flag(node, "ccw", in.ccw);
  if (in.crossSection.size() < 2 || in.spine.size() < 2)
  {
    warn(node, "needs two points of cross-section and spine at least; skipped");
    return {};
  }
  return makeExtrusion(in);
}

LocalSurface Geometry::faceSet(const NodeRef& node)
{
  const NodeRef coord = instances.expand(instances.node(node, "coord"));
  const auto* points = coord && !coord.node->damaged ? instances.get<Numbers>(coord, "point") : nullptr;
  const auto* index = instances.get<Integers>(node, "coordIndex");
  return points && index ? faces(node, *points, *index, !instances.flag(node, "ccw", true)) : LocalSurface{};
}

LocalSurface Geometry::faces(const NodeRef& node, const Numbers& points, const Integers& index, bool turned)
{
  FaceSet set(points, index, turned, memory);
  for (auto start = index.begin(); start != index.end();)
  {
    const auto stop = std::find_if(start, index.end(), [](int i) { return i < 0; });
    if (stop != start)
    {
      set.add({start, stop});
    }
    start = stop == index.end() ? stop : stop + 1;
  }
  const std::string complaints = set.complaints();
  if (!complaints.empty())
  {
    warn(node, complaints);
  }
  return set.take();
}

LocalSurface Geometry::make(const NodeRef& node, const State& state)
{
  if (node.node->type->name != "IndexedFaceSet")
  {
    return make(node);
  }
  const auto* index = instances.get<Integers>(node, "coordIndex");
  return state.points && index ? faces(node, *state.points, *index, state.clockwise) : LocalSurface{};
}

LocalSurface Geometry::cube(const NodeRef& node)
{
  const Vec3 size(instances.number(node, "width", 2.0), instances.number(node, "height", 2.0),
                  instances.number(node, "depth", 2.0));
  return boxOf(node, size);
}

bool Geometry::hasPart(const NodeRef& node, std::string_view flag, std::string_view part) const
{
  const auto* words = instances.get<Strings>(node, "parts");
  return instances.flag(node, flag, true) &&
         (!words || std::any_of(words->begin(), words->end(),
                                [&](std::string_view word) { return word == part || word == "ALL"; }));
}

} // namespace atria::vrml
