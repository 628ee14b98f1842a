// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/RoomMeasures.h"

#include "Dual/Mesh/FaceFlux.h"
#include "Support/ExactSum.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

namespace atria {

namespace {

/// Quantities that are summed up.
enum class Measure : std::int32_t
{
  volume,     ///< volume of a room
  floorArea,  ///< floor area of a room
  groupArea,  ///< area of a group's surfaces in a room
  openings,   ///< area of a surface between two rooms
  openingAxis ///< one component of a surface's area vector
};
using MeasureKey = std::array<std::int32_t, 4>;

class Measurer
{
public:
  Measurer(const DualMesh& m, const SurfaceModel& s, const Box3& domain, const OwnElements& owned)
      : mesh(m), model(s), part(owned), origin(domain.center()), areas(std::pow(domain.size().maxCoeff(), 2)),
        volumes(std::pow(domain.size().maxCoeff(), 3))
  {
    std::ranges::transform(model.names, std::back_inserter(groups), &Measurer::groupOf);
    sortUnique(groups);
  }

  void run()
  {
    measureElements();
    measureOpenings();
    sumUp();
  }

  static std::string groupOf(const std::string& surface)
  {
    const std::size_t slash = surface.rfind('/');
    return slash == std::string::npos ? std::string() : surface.substr(0, slash);
  }

  std::vector<std::string> groups;
  std::map<MeasureKey, ExactSum> sums;

private:
  static MeasureKey keyOf(Measure what, std::int32_t a, std::int32_t b = 0, std::int32_t c = 0)
  {
    return {static_cast<std::int32_t>(what), a, b, c};
  }

  void measureElements()
  {
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      for (int direction = 0; direction < 6 && mesh.rooms[e] >= 0; ++direction)
      {
        const std::int32_t code = mesh.neighbors[e][direction];
        if ((DualMesh::isBoundary(code) || (code >= 0 && mesh.rooms[code] != mesh.rooms[e])) && part.owns(e))
        {
          add(mesh.rooms[e], fluxOf(mesh, e, direction, origin), code);
        }
      }
    }
  }

  /// Adds a face at the border of a room.
  void add(std::int32_t room, const FaceFlux& flux, std::int32_t code)
  {
    sums[keyOf(Measure::volume, room)].add(flux.volume, volumes);
    if (!DualMesh::isBoundary(code))
    {
      return;
    }
    const double area = flux.area.norm();
    if (-flux.area[2] * std::numbers::sqrt2 > area)
    {
      sums[keyOf(Measure::floorArea, room)].add(-flux.area[2], areas);
    }
    const Index tag = mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].tag;
    if (tag < model.names.size())
    {
      const auto group = std::ranges::lower_bound(groups, groupOf(model.names[tag])) - groups.begin();
      sums[keyOf(Measure::groupArea, room, static_cast<std::int32_t>(group))].add(area, areas);
    }
  }

  void measureOpenings()
  {
    for (const ZoneFace& face : mesh.zoneFaces)
    {
      if (model.kinds[face.tag] != SurfaceKind::faceZone || !part.owns(face.element))
      {
        continue;
      }
      std::array between{mesh.rooms[face.element], mesh.rooms[mesh.neighbors[face.element][face.direction]]};
      if (face.side == SheetSide::front)
      {
        std::swap(between[0], between[1]);
      }
      const auto tag = static_cast<std::int32_t>(face.tag);
      const Vec3 area = fluxOf(mesh, face.element, face.direction, origin).area;
      sums[keyOf(Measure::openings, tag, between[0], between[1])].add(area.norm(), areas);
      for (int axis = 0; axis < 3; ++axis)
      {
        sums[keyOf(Measure::openingAxis, tag, axis)].add(face.side == SheetSide::back ? area[axis] : -area[axis],
                                                         areas);
      }
    }
  }

  void sumUp()
  {
    struct Entry
    {
      MeasureKey key;
      ExactSum sum;
    };
    std::vector<Entry> own;
    for (const auto& [key, sum] : sums)
    {
      own.push_back({key, sum});
    }
    sums.clear();
    for (const Entry& entry : joinAll(part.exchange, std::move(own)))
    {
      sums[entry.key].add(entry.sum);
    }
  }

  const DualMesh& mesh;
  const SurfaceModel& model;
  const OwnElements& part;
  Vec3 origin;
  SumUnits areas;
  SumUnits volumes;
};

class Reporter
{
public:
  Reporter(const Measurer& m, const SurfaceModel& s, RoomReport& r)
      : measured(m), model(s), groupAreas(r.rooms.size()), report(r)
  {
  }

  void run()
  {
    std::map<Index, std::map<std::array<std::int32_t, 2>, double>> openings;
    std::map<Index, Vec3> vectors;
    for (const auto& [key, sum] : measured.sums)
    {
      const auto& [what, of, b, c] = key;
      const double value = sum.value();
      switch (static_cast<Measure>(what))
      {
        case Measure::volume:
          report.rooms[of].volume = value;
          break;
        case Measure::floorArea:
          report.rooms[of].floorArea = value;
          break;
        case Measure::groupArea:
          groupAreas[of][measured.groups[b]] = value;
          break;
        case Measure::openings:
          openings[static_cast<Index>(of)][{b, c}] = value;
          break;
        case Measure::openingAxis:
          vectors[static_cast<Index>(of)][b] = value;
          break;
      }
    }
    for (const auto& [surface, between] : openings)
    {
      addOpening(surface, between, vectors.at(surface));
    }
    nameRooms();
  }

private:
  void addOpening(Index surface, const std::map<std::array<std::int32_t, 2>, double>& between, const Vec3& vector)
  {
    RoomOpening opening{surface, model.wallOf(surface)};
    double most = 0.0;
    for (const auto& [rooms, area] : between)
    {
      opening.area += area;
      opening.rooms = area > most ? rooms : opening.rooms;
      most = std::max(most, area);
    }
    // Openings found by rule are plane, though layers may bend the faces at their border.
    opening.area = opening.wall != surface ? vector.norm() : opening.area;
    for (const std::int32_t room : std::set(opening.rooms.begin(), opening.rooms.end()))
    {
      if (room >= 0)
      {
        report.rooms[room].openings.push_back(static_cast<Index>(report.openings.size()));
      }
    }
    report.openings.push_back(opening);
  }

  /// Returns the group that has more than half of a room's surfaces, by area; empty if there is none.
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

  const Measurer& measured;
  const SurfaceModel& model;
  /// One entry per room: areas by group.
  std::vector<std::map<std::string, double>> groupAreas;
  RoomReport& report;
};

} // namespace

RoomReport reportOf(const Rooms& rooms, const SurfaceModel& model)
{
  RoomReport report;
  report.rooms.resize(rooms.count);
  report.hasOutside = rooms.hasOutside;
  report.found = model.walls.size();
  return report;
}

void measureRooms(const DualMesh& mesh, const SurfaceModel& model, const Box3& domain, const OwnElements& part,
                  RoomReport& report)
{
  if (!hasRooms(model))
  {
    return;
  }
  Measurer measurer(mesh, model, domain, part);
  measurer.run();
  Reporter(measurer, model, report).run();
}

} // namespace atria
