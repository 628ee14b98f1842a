// SPDX-License-Identifier: GPL-3.0-or-later
#include "ForeignFormats.h"

#include "Support/Text.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace atria::model {

namespace {

struct Program
{
  std::string_view ending;
  std::string_view name;
  std::string_view exports; ///< formats that keep names best
};

constexpr Program programs[] = {
    {".skp", "SketchUp", "COLLADA (.dae) or VRML (.wrl)"},
    {".rvt", "Revit", "IFC"},
    {".pln", "Archicad", "IFC"},
    {".vwx", "Vectorworks", "IFC"},
    {".dwg", "AutoCAD", "DXF, with its faces"},
    {".3dm", "Rhino", "OBJ or COLLADA (.dae)"},
    {".blend", "Blender", "OBJ or glTF (.glb)"},
    {".max", "3ds Max", "FBX or OBJ"},
    {".c4d", "Cinema 4D", "FBX or OBJ"},
};
/// Formats of curved surfaces without facets.
constexpr std::string_view solids[] = {".step", ".stp", ".iges", ".igs", ".brep", ".sat"};
constexpr std::string_view archives[] = {".zip", ".7z", ".rar", ".tar", ".gz", ".kmz", ".ifczip"};

} // namespace

std::string adviceOnForeignFile(const std::string& file)
{
  const std::string ending = lowered(std::filesystem::path(file).extension().string());
  for (const Program& program : programs)
  {
    if (ending == program.ending)
    {
      return "is " + std::string(program.name) + "'s own format, which is not read; export it there as " +
             std::string(program.exports);
    }
  }
  if (std::ranges::find(solids, ending) != std::end(solids))
  {
    return "has curved surfaces without facets, which are not read; export it as OBJ or STL";
  }
  return std::ranges::find(archives, ending) != std::end(archives) ? "is an archive; unpack it first" : "";
}

} // namespace atria::model
