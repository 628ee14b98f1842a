// SPDX-License-Identifier: GPL-3.0-or-later
#include "LeftOut.h"

#include "Console.h"

#include <Mesher/Diagnostic.h>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace atria::tool {

namespace {

std::string sizeText(std::size_t elements, double volume)
{
  std::ostringstream text;
  text.precision(3);
  text << elements << " elements, about " << volume << " m3";
  return text.str();
}

/// Returns the seed as short as it can be typed: to a hundredth of an element.
std::string seedText(const Json& zone)
{
  const double size = std::cbrt(zone["rough_volume"].get<double>() / zone["elements"].get<double>());
  const double step = std::pow(10.0, std::floor(std::log10(size / 100.0)));
  std::ostringstream text;
  text << "--seed" << std::setprecision(12);
  for (const Json& coordinate : zone["inside"])
  {
    text << ' ' << std::round(coordinate.get<double>() / step) * step;
  }
  return text.str();
}

/// Returns the first few names, of the surfaces with most faces.
std::string surfacesText(const Json& names)
{
  constexpr std::size_t most = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
  {
    text += (i == 0 ? "" : ", ") + names[i].get<std::string>();
  }
  return text + (names.size() > most ? " and others" : "");
}

/// Zones of a kind that are not in the mesh, largest first, with volumes from `begin` to less than `end`, cubic meters.
struct LeftOut
{
  LeftOut(const Json& zones, const char* kind, double begin = 0.0, double end = std::numeric_limits<double>::infinity())
  {
    for (const Json& zone : zones)
    {
      const double volume = zone["rough_volume"].get<double>();
      if (!zone["kept"].get<bool>() && zone["kind"] == kind && volume >= begin && volume < end)
      {
        list.push_back(&zone);
      }
    }
  }

  std::string sizeFrom(std::size_t first) const
  {
    std::size_t elements = 0;
    double volume = 0.0;
    for (std::size_t i = first; i < list.size(); ++i)
    {
      elements += (*list[i])["elements"].get<std::size_t>();
      volume += (*list[i])["rough_volume"].get<double>();
    }
    return sizeText(elements, volume);
  }

  std::vector<const Json*> list;
};

constexpr std::size_t mostLines = 10;

void tellRooms(const LeftOut& rooms, const std::string& model, Console& console)
{
  for (std::size_t i = 0; i < std::min(mostLines, rooms.list.size()); ++i)
  {
    const Json& zone = *rooms.list[i];
    console.warning(model + ": a closed space (" + sizeText(zone["elements"], zone["rough_volume"]) + ") within " +
                    surfacesText(zone["surfaces"]) +
                    " is left out, as nothing opens it; to mesh it too give --zone all, or it alone " + seedText(zone));
  }
  if (rooms.list.size() > mostLines)
  {
    console.warning(model + ": and " + std::to_string(rooms.list.size() - mostLines) + " more closed spaces (" +
                    rooms.sizeFrom(mostLines) + "); --report lists them");
  }
}

/// Warns of spaces as large as rooms without any element away from their borders.
void tellLargeNarrow(const LeftOut& spaces, const std::string& model, Console& console)
{
  if (!spaces.list.empty())
  {
    const Json& largest = *spaces.list.front();
    console.warning(model + ": closed spaces left out that are at most two elements wide, but as large as rooms: " +
                    std::to_string(spaces.list.size()) + " (" + spaces.sizeFrom(0) + "), the largest within " +
                    surfacesText(largest["surfaces"]) + "; to mesh it give " + seedText(largest) +
                    ", and a smaller --size-min to see it as it is; --report lists them");
  }
}

/// Warns of spaces that reach the sides like those under terrain, but without a ground to confirm it.
void tellLateral(const LeftOut& spaces, const std::string& model, Console& console)
{
  for (std::size_t i = 0; i < std::min(mostLines, spaces.list.size()); ++i)
  {
    const Json& zone = *spaces.list[i];
    console.warning(model + ": a space (" + sizeText(zone["elements"], zone["rough_volume"]) +
                    ") reaches lateral sides of the domain but not its top, and is left out as under terrain; name "
                    "the terrain (--terrain), or to mesh the space give " +
                    seedText(zone));
  }
}

} // namespace

void tellLeftOut(const Json& zones, const std::string& model, Console& console)
{
  tellLateral(LeftOut(zones, "open"), model, console);
  tellRooms(LeftOut(zones, "room"), model, console);
  if (const LeftOut solids(zones, "solid"); !solids.list.empty())
  {
    console.note(model + ": insides of solids left out: " + std::to_string(solids.list.size()) + " (" +
                 solids.sizeFrom(0) + "), the largest of " + surfacesText((*solids.list.front())["surfaces"]) +
                 "; if that is a room, " + seedText(*solids.list.front()) + " means it");
  }
  constexpr double smallRoom = 10.0; // cubic meters
  tellLargeNarrow(LeftOut(zones, "narrow", smallRoom), model, console);
  if (const LeftOut narrow(zones, "narrow", 0.0, smallRoom); !narrow.list.empty())
  {
    console.note(model + ": closed spaces left out that are at most two elements wide: " +
                 std::to_string(narrow.list.size()) + " (" + narrow.sizeFrom(0) + "); --report lists them");
  }
}

Json leftOutElementsOf(vtkPolyData* diagnostics)
{
  vtkDataArray* kinds = diagnostics->GetCellData()->GetArray("Diagnostic");
  vtkDataArray* widths = diagnostics->GetCellData()->GetArray("Width");
  std::vector<std::pair<double, Vec3>> found;
  for (vtkIdType i = 0; kinds && widths && i < diagnostics->GetNumberOfCells(); ++i)
  {
    if (static_cast<int>(kinds->GetTuple1(i)) == Diagnostic::leftOutElement)
    {
      found.emplace_back(widths->GetTuple1(i), Vec3(diagnostics->GetCell(i)->GetPoints()->GetPoint(0)));
    }
  }
  std::ranges::stable_sort(found, std::ranges::greater(), &std::pair<double, Vec3>::first);
  Json list = Json::array();
  for (const auto& [size, place] : found)
  {
    list.push_back({{"place", {place[0], place[1], place[2]}}, {"size", size}});
  }
  return list;
}

void tellLeftOutElements(const Json& elements, const std::string& mesh, Console& console)
{
  constexpr std::size_t most = 3;
  if (elements.empty())
  {
    return;
  }
  std::ostringstream text;
  text.precision(6);
  text << mesh << ": elements left out, as they could not be made valid: " << elements.size() << ", at ";
  for (std::size_t i = 0; i < std::min(most, elements.size()); ++i)
  {
    const Json& place = elements[i]["place"];
    text << (i == 0 ? "(" : ", (") << place[0].get<double>() << ", " << place[1].get<double>() << ", "
         << place[2].get<double>() << ")";
  }
  text << (elements.size() > most ? " and elsewhere" : "") << ", the largest " << elements.front()["size"].get<double>()
       << " m wide; smaller elements there (--refine-box) or fewer layers may keep "
       << "them; --report lists them";
  console.note(text.str());
}

} // namespace atria::tool
