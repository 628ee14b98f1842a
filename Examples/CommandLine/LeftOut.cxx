// SPDX-License-Identifier: GPL-3.0-or-later
#include "LeftOut.h"

#include "Console.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
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

/// The point as short as it can be typed: to a hundredth of an element.
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

/// The first few, which have most faces.
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

/// Zones of a kind that are not in the mesh, largest first.
struct LeftOut
{
  LeftOut(const Json& zones, const char* kind)
  {
    for (const Json& zone : zones)
    {
      if (!zone["kept"].get<bool>() && zone["kind"] == kind)
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

/// They are left out as what is under terrain; they may be under a roof.
void tellLateral(const LeftOut& spaces, const std::string& model, Console& console)
{
  for (std::size_t i = 0; i < std::min(mostLines, spaces.list.size()); ++i)
  {
    const Json& zone = *spaces.list[i];
    console.warning(model + ": a space (" + sizeText(zone["elements"], zone["rough_volume"]) +
                    ") reaches lateral sides of the domain but not its top, and is left out as under terrain; if it "
                    "is not, give " +
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
  if (const LeftOut narrow(zones, "narrow"); !narrow.list.empty())
  {
    console.note(model + ": closed spaces left out that are at most two elements wide: " +
                 std::to_string(narrow.list.size()) + " (" + narrow.sizeFrom(0) + "); --report lists them");
  }
}

} // namespace atria::tool
