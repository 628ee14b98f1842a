// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcOpenings.h"

#include "IfcPlacement.h"
#include "IfcSchema.h"

#include "Support/Types.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

namespace atria::model::ifc {

namespace {

using namespace step;

using Arguments = std::vector<std::string_view>;

/// A box: its middle, three unit vectors, and its length along each. It is extruded along the last.
struct Box
{
  Vec3 center;
  std::array<Vec3, 3> axes;
  std::array<double, 3> sizes;
};

/// Returns the one solid of an opening; null if there are others. An opening may have an axis and the like beside its
/// body.
const Instance* solidOf(const step::File& file, std::uint64_t opening)
{
  const Instance* product = file.find(opening);
  const Instance* shape = product ? file.find(step::argument(*product, 6)) : nullptr;
  const Instance* solid = nullptr;
  for (const std::string_view each : argumentsOf(insideOf(shape ? step::argument(*shape, 2) : "")))
  {
    const Instance* representation = file.find(each);
    if (!representation || !isBody(step::argument(*representation, 1)))
    {
      continue;
    }
    const Arguments items = argumentsOf(insideOf(step::argument(*representation, 3)));
    if (solid || items.size() != 1)
    {
      return nullptr;
    }
    solid = file.find(items[0]);
  }
  return solid && solid->type == "IFCEXTRUDEDAREASOLID" ? solid : nullptr;
}

/// Returns the rectangle as a box without height.
std::optional<Box> rectangleOf(const step::File& file, const Instance& profile)
{
  const Arguments arguments = argumentsOf(profile.arguments);
  if (profile.type == "IFCRECTANGLEPROFILEDEF" && arguments.size() == 5)
  {
    const auto frame = frameAt(file, arguments[2]);
    const auto x = step::numberIn(arguments[3]);
    const auto y = step::numberIn(arguments[4]);
    return frame && x && y ? std::optional(Box{frame->origin, frame->axes, {*x, *y, 0.0}}) : std::nullopt;
  }
  const Instance* curve =
      profile.type == "IFCARBITRARYCLOSEDPROFILEDEF" && arguments.size() == 3 ? file.find(arguments[2]) : nullptr;
  if (!curve || curve->type != "IFCPOLYLINE")
  {
    return std::nullopt;
  }
  std::vector<Vec3> corners;
  for (const std::string_view point : argumentsOf(insideOf(curve->arguments)))
  {
    const auto corner = coordinatesIn(file.find(point));
    if (!corner)
    {
      return std::nullopt;
    }
    corners.push_back(*corner);
  }
  if (corners.size() == 5 && (corners[4] - corners[0]).norm() == 0.0)
  {
    corners.pop_back();
  }
  if (corners.size() != 4)
  {
    return std::nullopt;
  }
  const Vec3 u = corners[1] - corners[0];
  const Vec3 v = corners[3] - corners[0];
  const double small = 1e-6 * (u.norm() + v.norm());
  const bool isRectangle = u.norm() > small && v.norm() > small && std::abs(u.dot(v)) < small * (u.norm() + v.norm()) &&
                           (corners[0] + u + v - corners[2]).norm() < small;
  if (!isRectangle)
  {
    return std::nullopt;
  }
  const Vec3 x = u.normalized();
  return Box{corners[0] + 0.5 * (u + v), {x, Vec3::UnitZ().cross(x), Vec3::UnitZ()}, {u.norm(), v.norm(), 0.0}};
}

std::optional<Box> boxOf(const step::File& file, const Instance& solid)
{
  const Arguments arguments = argumentsOf(solid.arguments);
  const Instance* profile = arguments.size() == 4 ? file.find(arguments[0]) : nullptr;
  const auto frame = profile ? frameAt(file, arguments[1]) : std::nullopt;
  const auto direction = frame ? directionAt(file, arguments[2], Vec3::UnitZ()) : std::nullopt;
  const auto depth = direction ? step::numberIn(arguments[3]) : std::nullopt;
  auto box = depth ? rectangleOf(file, *profile) : std::nullopt;
  if (!box || std::abs(direction->z()) < 1.0 - 1e-9)
  {
    return std::nullopt;
  }
  box->center.z() += 0.5 * direction->z() * *depth;
  box->sizes[2] = *depth;
  box->center = frame->placed(box->center);
  for (Vec3& axis : box->axes)
  {
    axis = frame->placed(axis) - frame->origin;
  }
  return box;
}

std::string listOf(const Vec3& v) { return "(" + textOf(v.x()) + "," + textOf(v.y()) + "," + textOf(v.z()) + ")"; }

} // namespace

bool extrudeAlong(step::File& file, std::uint64_t opening, BoxSide side)
{
  const Instance* solid = solidOf(file, opening);
  const auto box = solid ? boxOf(file, *solid) : std::nullopt;
  if (!box)
  {
    return false;
  }
  const std::uint64_t id = solid->id;
  const bool firstIsLonger = box->sizes[0] > box->sizes[1];
  const std::size_t along = (side == BoxSide::longer) == firstIsLonger ? 0 : 1;
  const std::size_t across = 1 - along;
  const auto add = [&](const char* type, const std::string& arguments) { return reference(file.add(type, arguments)); };
  const auto vector = [&](const char* type, const Vec3& v) { return add(type, listOf(v)); };
  const Vec3 start = box->center - 0.5 * box->sizes[along] * box->axes[along];
  const std::string placement =
      add("IFCAXIS2PLACEMENT3D", vector("IFCCARTESIANPOINT", start) + "," + vector("IFCDIRECTION", box->axes[along]) +
                                     "," + vector("IFCDIRECTION", box->axes[across]));
  const std::string middle = add("IFCAXIS2PLACEMENT2D", add("IFCCARTESIANPOINT", "(0.,0.)") + ",$");
  const std::string profile = add("IFCRECTANGLEPROFILEDEF", ".AREA.,$," + middle + "," + textOf(box->sizes[across]) +
                                                                "," + textOf(box->sizes[2]));
  const std::string up = add("IFCDIRECTION", "(0.,0.,1.)");
  file.find(id)->arguments = profile + "," + placement + "," + up + "," + textOf(box->sizes[along]);
  return true;
}

} // namespace atria::model::ifc
