// SPDX-License-Identifier: GPL-3.0-or-later
/// COLLADA, 3DS and FBX by assimp.
#include "AssimpTree.h"
#include "ColladaHoles.h"
#include "ModelFile.h"
#include "TemporaryFile.h"

#include <vtkPolyData.h>

#include <regex>

namespace atria::model {

namespace {

using assimp::Json;
using assimp::Placing;

/// Returns the first group of the first match of `pattern`; empty if there is none.
std::string foundIn(const std::string& head, const char* pattern)
{
  std::smatch match;
  return std::regex_search(head, match, std::regex(pattern)) ? match[1].str() : std::string();
}

Placing placingOf(const std::string& ending, const std::string& head, const Json& metadata)
{
  if (ending == ".dae") // assimp converts lengths
  {
    const std::string up = foundIn(head, "<up_axis>\\s*([XYZ])_UP");
    return {1.0, true, up == "Z" ? 2 : 1, up != "X"};
  }
  if (ending == ".fbx") // in centimeters times a factor
  {
    return {0.01 * metadata.value("UnitScaleFactor", 1.0), true, metadata.value("UpAxis", 1) == 2 ? 2 : 1, true};
  }
  return {1.0, false}; // 3DS has no unit
}

} // namespace

Model readAssimp(const std::string& file, const ProgressRange& progress)
{
  const std::string ending = lowerEnding(file);
  const std::string bytes = readBytes(file);
  const std::string mended = ending == ".dae" ? withoutHoles(bytes) : std::string();
  assimp::Run run;
  if (mended.empty())
  {
    run = assimp::run(file, file, progress);
  }
  else
  {
    const TemporaryFile other(mended, ending);
    run = assimp::run(file, other.path(), progress);
  }
  if (run.failed())
  {
    assimp::throwFailed(file, run);
  }
  constexpr std::size_t headLength = 1 << 16; // as much as stands before the geometry
  const Placing placing = placingOf(ending, bytes.substr(0, headLength), run.tree.at("metadata"));
  Model model = assimp::modelOf(run.tree, file, placing);
  model.head = headOf(bytes);
  return model;
}

} // namespace atria::model
