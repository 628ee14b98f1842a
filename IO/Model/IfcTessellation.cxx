// SPDX-License-Identifier: GPL-3.0-or-later
#include "IfcTessellation.h"

#include "Support/Types.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <unordered_map>

namespace atria::model::ifc {

namespace {

using namespace step;

using Indices = std::vector<std::size_t>;

/// Returns indices, which count from 1 in the file, and from 0 here; empty if one is no number.
Indices indicesIn(std::string_view list)
{
  Indices out;
  for (const std::string_view word : argumentsOf(insideOf(list)))
  {
    const auto value = step::numberIn(word);
    if (!value || *value < 1.0)
    {
      return {};
    }
    out.push_back(static_cast<std::size_t>(*value) - 1);
  }
  return out;
}

std::string listOf(const std::vector<std::string>& members)
{
  std::string out = "(";
  for (const std::string& member : members)
  {
    out.append(out.size() == 1 ? "" : ",").append(member);
  }
  return out + ")";
}

class Writer
{
public:
  explicit Writer(step::File& file) : content(file) {}

  void run()
  {
    const std::size_t count = content.instances().size(); // without those it adds
    for (std::size_t i = 0; i < count; ++i)
    {
      const Instance instance = content.instances()[i];
      if (instance.type == "IFCTRIANGULATEDFACESET")
      {
        triangles(instance);
      }
      else if (instance.type == "IFCPOLYGONALFACESET")
      {
        polygons(instance);
      }
      else if (instance.type == "IFCINDEXEDPOLYCURVE")
      {
        curve(instance);
      }
    }
  }

private:
  using Rings = std::vector<Indices>; ///< the outline, then holes

  void triangles(const Instance& set)
  {
    std::vector<Rings> faces;
    for (const std::string_view face : argumentsOf(insideOf(argument(set, 3))))
    {
      faces.push_back({indicesIn(face)});
    }
    write(set, argument(set, 2) == ".T.", faces, {});
  }

  void polygons(const Instance& set)
  {
    std::vector<Rings> faces;
    for (const std::string_view member : argumentsOf(insideOf(argument(set, 2))))
    {
      const Instance* face = content.find(member);
      Rings rings{face ? indicesIn(argument(*face, 0)) : Indices()};
      const bool hasHoles = face && face->type == "IFCINDEXEDPOLYGONALFACEWITHVOIDS";
      for (const std::string_view hole : argumentsOf(insideOf(hasHoles ? argument(*face, 1) : "")))
      {
        rings.push_back(indicesIn(hole));
      }
      faces.push_back(rings);
    }
    write(set, argument(set, 1) == ".T.", faces, indicesIn(argument(set, 3)));
  }

  /// Writes a shape in the place of the set. `detour` leads from the indices to those of points, if the file has that.
  void write(const Instance& set, bool isClosed, const std::vector<Rings>& faces, const Indices& detour)
  {
    const std::vector<std::string>& points = pointsOf(argument(set, 0));
    std::vector<std::string> written;
    for (const Rings& rings : faces)
    {
      std::vector<std::string> bounds;
      for (const Indices& ring : rings)
      {
        std::vector<std::string> corners;
        for (const std::size_t i : ring)
        {
          const std::size_t place = detour.empty() ? i : i < detour.size() ? detour[i] : points.size();
          if (place >= points.size())
          {
            return;
          }
          corners.push_back(points[place]);
        }
        const std::string loop = add("IFCPOLYLOOP", listOf(corners));
        bounds.push_back(add(bounds.empty() ? "IFCFACEOUTERBOUND" : "IFCFACEBOUND", loop + ",.T."));
      }
      written.push_back(add("IFCFACE", listOf(bounds)));
    }
    if (written.empty())
    {
      return;
    }
    const std::string shell = add(isClosed ? "IFCCLOSEDSHELL" : "IFCOPENSHELL", listOf(written));
    Instance& own = *content.find(set.id);
    own.type = isClosed ? "IFCFACETEDBREP" : "IFCSHELLBASEDSURFACEMODEL";
    own.arguments = isClosed ? shell : "(" + shell + ")";
  }

  void curve(const Instance& curve)
  {
    const std::vector<std::string>& points = pointsOf(argument(curve, 0));
    std::vector<std::string> line;
    const auto append = [&](const std::string& point) {
      if (line.empty() || line.back() != point)
      {
        line.push_back(point);
      }
    };
    for (const std::string_view segment : argumentsOf(insideOf(argument(curve, 1))))
    {
      const std::size_t open = segment.find('(');
      const Indices ids = indicesIn(open == segment.npos ? "" : insideOf(segment.substr(open)));
      for (const std::size_t id : ids)
      {
        if (id >= points.size())
        {
          return;
        }
      }
      if (segment.starts_with("IFCARCINDEX") && ids.size() == 3)
      {
        append(points[ids[0]]);
        addArc(points[ids[0]], points[ids[1]], points[ids[2]], line);
      }
      for (std::size_t k = segment.starts_with("IFCARCINDEX") ? ids.size() - 1 : 0; k < ids.size(); ++k)
      {
        append(points[ids[k]]);
      }
    }
    line = argument(curve, 1) == "$" ? points : line;
    if (line.size() > 1)
    {
      Instance& own = *content.find(curve.id);
      own.type = "IFCPOLYLINE";
      own.arguments = listOf(line);
    }
  }

  /// Adds points on the way from one to another through a third.
  void addArc(const std::string& from, const std::string& through, const std::string& to,
              std::vector<std::string>& line)
  {
    constexpr double step = 10.0 / 180.0 * std::numbers::pi;
    const Vec3 a = placeOf(from);
    const Vec3 u = placeOf(through) - a;
    const Vec3 v = placeOf(to) - a;
    const Vec3 normal = u.cross(v);
    if (!(normal.norm() > 1e-9 * u.norm() * v.norm()))
    {
      line.push_back(through);
      return;
    }
    const Vec3 center =
        a + (u.squaredNorm() * v.cross(normal) + v.squaredNorm() * normal.cross(u)) / (2.0 * normal.squaredNorm());
    const Vec3 start = a - center;
    const Vec3 end = a + v - center;
    double angle = std::atan2(start.cross(end).dot(normal.normalized()), start.dot(end));
    angle += angle < 0.0 ? 2.0 * std::numbers::pi : 0.0;
    const int pieces = static_cast<int>(std::ceil(angle / step));
    const bool isPlane = isInPlane[from];
    for (int i = 1; i < pieces; ++i)
    {
      const Vec3 p = center + Eigen::AngleAxisd(angle * i / pieces, normal.normalized()) * start;
      std::array<char, 100> text{};
      const int length = isPlane ? std::snprintf(text.data(), text.size(), "(%.15E,%.15E)", p.x(), p.y())
                                 : std::snprintf(text.data(), text.size(), "(%.15E,%.15E,%.15E)", p.x(), p.y(), p.z());
      line.push_back(add("IFCCARTESIANPOINT", std::string(text.data(), static_cast<std::size_t>(length))));
    }
  }

  Vec3 placeOf(const std::string& point) const
  {
    Vec3 p = Vec3::Zero();
    const std::vector<std::string_view> words = argumentsOf(insideOf(argument(*content.find(point), 0)));
    for (std::size_t i = 0; i < words.size() && i < 3; ++i)
    {
      p[static_cast<Eigen::Index>(i)] = step::numberIn(words[i]).value_or(0.0);
    }
    return p;
  }

  /// Returns references to the points of a list, which are added at the first request.
  const std::vector<std::string>& pointsOf(std::string_view list)
  {
    const std::uint64_t id = referenceIn(list).value_or(0);
    const auto [found, isNew] = known.try_emplace(id);
    const Instance* instance = content.find(id);
    if (isNew && instance && instance->type.starts_with("IFCCARTESIANPOINTLIST"))
    {
      const bool isPlane = instance->type == "IFCCARTESIANPOINTLIST2D";
      const std::string all = std::string(argument(*instance, 0));
      for (const std::string_view point : argumentsOf(insideOf(all)))
      {
        found->second.push_back(add("IFCCARTESIANPOINT", std::string(point)));
        isInPlane[found->second.back()] = isPlane;
      }
    }
    return found->second;
  }

  std::string add(const std::string& type, const std::string& arguments)
  {
    return reference(content.add(type, arguments));
  }

  step::File& content;
  std::map<std::uint64_t, std::vector<std::string>> known;
  std::unordered_map<std::string, bool> isInPlane;
};

} // namespace

void writeTessellationsAs2x3(step::File& content) { Writer(content).run(); }

} // namespace atria::model::ifc
