// SPDX-License-Identifier: GPL-3.0-or-later
/// libFuzzer's entry to the readers of other formats than VRML, as VRMLFuzzer.cxx. VTK's XML files are left out: VTK
/// reads them.
#include "ReaderFuzzing.h"
#include "vtkAtriaModelReader.h"

#include <vtkNew.h>

#include <array>
#include <string_view>

namespace {

/// The ending that goes with what the bytes look like; now and then another, as files have wrong names as well.
std::string endingFor(std::string_view bytes)
{
  constexpr std::array<const char*, 5> all{".obj", ".stl", ".ply", ".gltf", ".glb"};
  if (bytes.size() % 32 == 0)
  {
    return all[bytes.size() / 32 % all.size()];
  }
  const std::string_view start = bytes.substr(0, 80);
  return start.substr(0, 3) == "ply"                                                      ? ".ply"
         : start.substr(0, 4) == "glTF"                                                   ? ".glb"
         : start.substr(0, 1) == "{"                                                      ? ".gltf"
         : start.substr(0, 5) == "solid" || bytes.substr(0, 200).find('\0') != bytes.npos ? ".stl"
                                                                                          : ".obj";
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const vtkNew<vtkAtriaModelReader> reader;
  const std::string ending = endingFor({reinterpret_cast<const char*>(data), size});
  atria::fuzzing::readAndJudge(reader, "model" + ending, data, size);
  return 0;
}
