// SPDX-License-Identifier: GPL-3.0-or-later
/// libFuzzer's entry to the readers of other formats than VRML, as VRMLFuzzer.cxx. What others' code reads is
/// left out: VTK's XML files, and assimp's formats but for the text that IFC files are turned into for it.
#include "IfcDocument.h"
#include "IfcOpenings.h"
#include "ReaderFuzzing.h"
#include "Support/Error.h"
#include "vtkAtriaModelReader.h"

#include <vtkNew.h>

#include <array>
#include <string_view>

namespace {

bool isCityJson(std::string_view bytes) { return bytes.find("CityJSON") != bytes.npos; }

bool beginsDxf(std::string_view start)
{
  const std::size_t first = start.find_first_not_of(" \t\r\n");
  return first != start.npos && (start.substr(first, 1) == "0" || start.substr(first, 3) == "999");
}

/// The ending that goes with what the bytes look like; now and then another, as files have wrong names as well.
std::string endingFor(std::string_view bytes)
{
  constexpr std::array<const char*, 7> all{".obj", ".stl", ".ply", ".gltf", ".glb", ".dxf", ".json"};
  if (bytes.size() % 32 == 0)
  {
    return all[bytes.size() / 32 % all.size()];
  }
  const std::string_view start = bytes.substr(0, 200);
  return start.starts_with("ply")                                       ? ".ply"
         : start.starts_with("glTF")                                    ? ".glb"
         : start.starts_with("{")                                       ? (isCityJson(bytes) ? ".json" : ".gltf")
         : start.starts_with("solid") || start.find('\0') != start.npos ? ".stl"
         : beginsDxf(start)                                             ? ".dxf"
                                                                        : ".obj";
}

/// Makes of an IFC file what assimp would read.
void prepareIfc(std::string_view bytes)
{
  using namespace atria::model;
  try
  {
    ifc::Document document(bytes);
    for (const auto& [element, opening] : document.openings())
    {
      ifc::extrudeAlong(document.file(), opening, ifc::BoxSide::longer);
    }
    document.textWithout({});
  }
  catch (const atria::Error&)
  {
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  if (bytes.starts_with("ISO-10303"))
  {
    prepareIfc(bytes);
    return 0;
  }
  const vtkNew<vtkAtriaModelReader> reader;
  const std::string ending = endingFor(bytes);
  atria::fuzzing::readAndJudge(reader, "model" + ending, data, size);
  return 0;
}
