// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcPlacement.h"

#include <Eigen/Geometry>

#include <cstdio>
#include <vector>

namespace atria::model::ifc {

namespace {

using namespace step;

using Arguments = std::vector<std::string_view>;

} // namespace

std::optional<Vec3> coordinatesIn(const Instance* instance)
{
  const Arguments list = instance ? argumentsOf(insideOf(argumentsOf(instance->arguments).front())) : Arguments();
  Vec3 out = Vec3::Zero();
  for (std::size_t i = 0; i < list.size() && i < 3; ++i)
  {
    const auto number = step::numberIn(list[i]);
    if (!number)
    {
      return std::nullopt;
    }
    out[static_cast<Eigen::Index>(i)] = *number;
  }
  return list.size() < 2 || list.size() > 3 ? std::nullopt : std::optional(out);
}

std::optional<Vec3> directionAt(const step::File& file, std::string_view at, const Vec3& fallback)
{
  if (at == "$" || at.empty())
  {
    return fallback;
  }
  const auto found = coordinatesIn(file.find(at));
  return found && found->norm() > 0.0 ? std::optional<Vec3>(found->normalized()) : std::nullopt;
}

std::optional<Frame> frameAt(const step::File& file, std::string_view at)
{
  const Instance* placement = file.find(at);
  if (!placement)
  {
    return at == "$" ? std::optional(Frame{}) : std::nullopt;
  }
  const Arguments arguments = argumentsOf(placement->arguments);
  const bool isPlane = placement->type == "IFCAXIS2PLACEMENT2D";
  if (arguments.size() != (isPlane ? 2 : 3))
  {
    return std::nullopt;
  }
  const auto origin = coordinatesIn(file.find(arguments[0]));
  const auto up = directionAt(file, isPlane ? "$" : arguments[1], Vec3::UnitZ());
  const auto across = directionAt(file, arguments.back(), Vec3::UnitX());
  if (!origin || !up || !across || up->cross(*across).norm() < 1e-6)
  {
    return std::nullopt;
  }
  const Vec3 x = (*across - across->dot(*up) * *up).normalized();
  return Frame{*origin, {x, up->cross(x), *up}};
}

std::string textOf(double value)
{
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), "%.15E", value);
  return {text.data(), static_cast<std::size_t>(length)};
}

} // namespace atria::model::ifc
