// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs assimp on a file in a process of its own (AssimpProgram.cxx), and makes a model of its output.
#pragma once

#include "ModelParts.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <vector>

namespace atria {
class ProgressRange;
}

namespace atria::model::assimp {

using Json = nlohmann::json;

/// End and output of the process, as documented in AssimpProgram.cxx.
struct Run
{
  int status = 0;
  Json tree;

  bool failed() const { return status != 0 || !tree.is_object() || tree.contains("error"); }
  bool tookTooLong() const { return status == 3; }
};

/// Runs assimp. Throws Error if the program does not exist, or Aborted. `file` is the model in messages, `path` the
/// file that is read.
Run run(const std::string& file, const std::string& path, const ProgressRange& progress);

/// Throws Error with the reason for a failed run.
[[noreturn]] void throwFailed(const std::string& file, const Run& run);

/// Unit and axis by assimp or the file. assimp turns models whose format says that z is up.
struct Placing
{
  double scale = 1.0; ///< to meters, where assimp has not converted lengths itself
  bool unitKnown = true;
  int upAxis = 1;
  bool axisKnown = true;
};

/// Makes a model. Meshes of one node and material are one part.
Model modelOf(const Json& tree, const std::string& file, const Placing& placing);

/// Returns the numbers of a binary entry.
template <typename T> std::vector<T> numbersIn(const Json& value)
{
  const auto& bytes = value.get_binary();
  std::vector<T> numbers(bytes.size() / sizeof(T));
  if (!numbers.empty())
  {
    std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(T));
  }
  return numbers;
}

} // namespace atria::model::assimp
