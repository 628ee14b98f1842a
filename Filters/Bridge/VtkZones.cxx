// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones, rooms and leaks of VtkDualMesh.h.
#include "AddArray.h"
#include "Support/Text.h"
#include "VtkDualMesh.h"

#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

namespace atria {

namespace {

/// One name per ZoneKind.
constexpr std::array<const char*, 6> zoneKindNames{"open", "room", "solid", "narrow", "beyond", "ground"};

std::string nameOf(Index surface, const std::vector<std::string>& names)
{
  return surface < names.size() ? names[surface] : sideNames[zMin];
}

std::vector<std::string> namesOf(const std::vector<Index>& surfaces, const std::vector<std::string>& names)
{
  std::vector<std::string> out(surfaces.size());
  std::ranges::transform(surfaces, out.begin(), [&](Index surface) { return nameOf(surface, names); });
  return out;
}

/// Returns the text of a point, without digits left by rounding.
std::string at(const Vec3& p)
{
  const auto plain = [](double x) { return std::abs(x) < 1e-9 ? 0.0 : x; };
  return (std::ostringstream() << "(" << plain(p[0]) << ", " << plain(p[1]) << ", " << plain(p[2]) << ")").str();
}

std::string messageOf(const Leak& leak, const std::vector<std::string>& beside)
{
  std::ostringstream text;
  text << "the zone at " << at(leak.seed) << " should be sealed but reaches the side " << sideName(leak.side)
       << "; the narrowest place on the widest way is at " << at(leak.place);
  text << ", " << leak.width << " wide";
  if (!beside.empty())
  {
    text << ", beside " << joined(beside);
  }
  return text.str();
}

} // namespace

void zonesToVtk(const std::vector<ZoneSummary>& zones, const std::vector<std::string>& surfaceNames, vtkFieldData* out)
{
  auto* elements = addArray<vtkIdTypeArray>(out, "ZoneElements");
  auto* kept = addArray<vtkUnsignedCharArray>(out, "ZoneKept");
  auto* places = addArray<vtkDoubleArray>(out, "ZonePoint", 3);
  auto* volumes = addArray<vtkDoubleArray>(out, "ZoneVolume");
  auto* kinds = addArray<vtkStringArray>(out, "ZoneKind");
  auto* sides = addArray<vtkStringArray>(out, "ZoneSides");
  auto* surfaces = addArray<vtkStringArray>(out, "ZoneSurfaces");
  for (const ZoneSummary& zone : zones)
  {
    elements->InsertNextValue(static_cast<vtkIdType>(zone.elements));
    kept->InsertNextValue(zone.kept ? 1 : 0);
    places->InsertNextTuple(zone.inside.data());
    volumes->InsertNextValue(zone.volume);
    kinds->InsertNextValue(zoneKindNames[static_cast<std::size_t>(zone.kind)]);
    std::vector<std::string> reached;
    for (Index side = 0; side < sideNumbers; ++side)
    {
      if ((zone.sides >> side & 1) != 0)
      {
        reached.push_back(sideName(side));
      }
    }
    sides->InsertNextValue(joined(reached, "\n"));
    surfaces->InsertNextValue(joined(namesOf(zone.surfaces, surfaceNames), "\n"));
  }
}

void roomsToVtk(const RoomReport& report, const std::vector<std::string>& surfaceNames, vtkFieldData* out)
{
  if (report.rooms.empty())
  {
    return;
  }
  auto* rooms = addArray<vtkStringArray>(out, "RoomName");
  auto* volumes = addArray<vtkDoubleArray>(out, "RoomVolume");
  auto* floors = addArray<vtkDoubleArray>(out, "RoomFloorArea");
  auto* openingsOf = addArray<vtkStringArray>(out, "RoomOpenings");
  for (const Room& room : report.rooms)
  {
    rooms->InsertNextValue(room.name);
    volumes->InsertNextValue(room.volume);
    floors->InsertNextValue(room.floorArea);
    std::vector<Index> openings;
    std::ranges::transform(room.openings, std::back_inserter(openings),
                           [&](Index opening) { return report.openings[opening].surface; });
    openingsOf->InsertNextValue(joined(namesOf(openings, surfaceNames), "\n"));
  }
  auto* names = addArray<vtkStringArray>(out, "OpeningName");
  auto* walls = addArray<vtkStringArray>(out, "OpeningSurface");
  auto* areas = addArray<vtkDoubleArray>(out, "OpeningArea");
  auto* between = addArray<vtkIntArray>(out, "OpeningRooms", 2);
  for (const RoomOpening& opening : report.openings)
  {
    names->InsertNextValue(surfaceNames[opening.surface]);
    walls->InsertNextValue(surfaceNames[opening.wall]);
    areas->InsertNextValue(opening.area);
    between->InsertNextTuple2(opening.rooms[0], opening.rooms[1]);
  }
}

void leaksToVtk(const std::vector<Leak>& leaks, const std::vector<std::string>& surfaceNames, vtkFieldData* out)
{
  auto* seeds = addArray<vtkDoubleArray>(out, "LeakSeed", 3);
  auto* places = addArray<vtkDoubleArray>(out, "LeakPlace", 3);
  auto* surfaces = addArray<vtkStringArray>(out, "LeakSurfaces");
  auto* sides = addArray<vtkStringArray>(out, "LeakSide");
  auto* messages = addArray<vtkStringArray>(out, "LeakMessage");
  for (const Leak& leak : leaks)
  {
    const std::vector<std::string> beside = namesOf(leak.surfaces, surfaceNames);
    seeds->InsertNextTuple(leak.seed.data());
    places->InsertNextTuple(leak.place.data());
    surfaces->InsertNextValue(joined(beside, "\n"));
    sides->InsertNextValue(sideName(leak.side));
    messages->InsertNextValue(messageOf(leak, beside));
  }
}

} // namespace atria
