// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/RoomReport.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace atria {

namespace {

/// Of a face: its area vector, and a third of its points' product with it, integrated: volumes are sums of these.
struct Flux
{
  Vec3 area = Vec3::Zero();
  double volume = 0.0;
};

Flux fluxOf(const DualMesh& mesh, Index element, int direction)
{
  const ReducedFace face = faceOf(mesh.corners[element], direction);
  const auto at = [&](int i) -> const Vec3& { return mesh.points[face.points[i % face.count]]; };
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < face.count; ++i)
  {
    middle += at(i) / face.count;
  }
  Flux flux;
  for (int i = 0; i < face.count; ++i)
  {
    const Vec3 area = 0.5 * (at(i) - middle).cross(at(i + 1) - middle);
    flux.area += area;
    flux.volume += area.dot(middle + at(i) + at(i + 1)) / 9.0;
  }
  return flux;
}

class Reporter
{
public:
  Reporter(const DualMesh& m, const SurfaceModel& s, RoomReport& r)
      : mesh(m), model(s), groupAreas(r.rooms.size()), report(r)
  {
  }

  void run()
  {
    measureElements();
    measureOpenings();
    nameRooms();
  }

private:
  void measureElements()
  {
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      for (int direction = 0; direction < 6 && mesh.rooms[e] >= 0; ++direction)
      {
        const std::int32_t code = mesh.neighbors[e][direction];
        if (DualMesh::isBoundary(code) || (code >= 0 && mesh.rooms[code] != mesh.rooms[e]))
        {
          add(static_cast<std::size_t>(mesh.rooms[e]), fluxOf(mesh, e, direction), code);
        }
      }
    }
  }

  /// Adds a face at the border of a room.
  void add(std::size_t room, const Flux& flux, std::int32_t code)
  {
    report.rooms[room].volume += flux.volume;
    if (!DualMesh::isBoundary(code))
    {
      return;
    }
    const double area = flux.area.norm();
    report.rooms[room].floorArea += -flux.area[2] * std::numbers::sqrt2 > area ? -flux.area[2] : 0.0;
    const Index tag = mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].tag;
    if (tag < model.names.size())
    {
      const std::string& name = model.names[tag];
      const std::size_t slash = name.rfind('/');
      groupAreas[room][slash == std::string::npos ? std::string() : name.substr(0, slash)] += area;
    }
  }

  void measureOpenings()
  {
    std::map<Index, std::map<std::array<std::int32_t, 2>, double>> areas;
    std::map<Index, Vec3> vectors;
    for (const ZoneFace& face : mesh.zoneFaces)
    {
      if (model.kinds[face.tag] == SurfaceKind::faceZone)
      {
        std::array between{mesh.rooms[face.element], mesh.rooms[mesh.neighbors[face.element][face.direction]]};
        if (face.side == SheetSide::front)
        {
          std::swap(between[0], between[1]);
        }
        const Vec3 area = fluxOf(mesh, face.element, face.direction).area;
        areas[face.tag][between] += area.norm();
        vectors.try_emplace(face.tag, Vec3::Zero()).first->second += face.side == SheetSide::back ? area : -area;
      }
    }
    for (const auto& [surface, between] : areas)
    {
      RoomOpening opening{surface, model.wallOf(surface)};
      double most = 0.0;
      for (const auto& [rooms, area] : between)
      {
        opening.area += area;
        opening.rooms = area > most ? rooms : opening.rooms;
        most = std::max(most, area);
      }
      // Those found by rule are plane, though layers may bend the faces at their border.
      opening.area = opening.wall != surface ? vectors.at(surface).norm() : opening.area;
      for (const std::int32_t room : std::set(opening.rooms.begin(), opening.rooms.end()))
      {
        if (room >= 0)
        {
          report.rooms[room].openings.push_back(static_cast<Index>(report.openings.size()));
        }
      }
      report.openings.push_back(opening);
    }
  }

  /// The group that most of a room's surfaces are of by area; empty without one.
  std::string groupOf(std::size_t room) const
  {
    double all = 0.0;
    std::pair<double, std::string> most;
    for (const auto& [group, area] : groupAreas[room])
    {
      all += area;
      most = std::max(most, std::pair(area, group));
    }
    return 2.0 * most.first > all ? most.second : std::string();
  }

  void nameRooms()
  {
    std::set<std::string> taken{"outside"};
    int number = 0;
    for (std::size_t room = 0; room < report.rooms.size(); ++room)
    {
      std::string& name = report.rooms[room].name;
      if (room == 0 && report.hasOutside)
      {
        name = "outside";
        continue;
      }
      const std::string group = groupOf(room);
      name = group;
      for (int i = 2; !group.empty() && !taken.insert(name).second; ++i)
      {
        name = group + "_" + std::to_string(i);
      }
      while (group.empty() && (name.empty() || !taken.insert(name).second))
      {
        name = "room_" + std::to_string(++number);
      }
    }
  }

  const DualMesh& mesh;
  const SurfaceModel& model;
  /// Per room, by group.
  std::vector<std::map<std::string, double>> groupAreas;
  RoomReport& report;
};

} // namespace

void measureRooms(const DualMesh& mesh, const SurfaceModel& model, RoomReport& report)
{
  if (!mesh.rooms.empty())
  {
    Reporter(mesh, model, report).run();
  }
}

} // namespace atria
