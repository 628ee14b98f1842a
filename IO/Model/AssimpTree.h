// SPDX-License-Identifier: GPL-3.0-or-later
/// What assimp reads of a file, in a process of its own (AssimpProgram.cxx), and a model made of it.
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

/// How the process ended, and what it has read: both as AssimpProgram.cxx says.
struct Run
{
  int status = 0;
  Json tree;

  bool failed() const { return status != 0 || !tree.is_object() || tree.contains("error"); }
  bool tookTooLong() const { return status == 3; }
};

/// Throws Error where the program is not there, or Aborted. `file` is the model in messages, `path` what is read.
Run run(const std::string& file, const std::string& path, const ProgressRange& progress);

/// Throws Error that says why a run failed.
[[noreturn]] void throwFailed(const std::string& file, const Run& run);

/// What assimp, or the file, says of unit and axis. Models whose format says that z is up are turned by assimp.
struct Placing
{
  double scale = 1.0; ///< to meters, where assimp has not converted lengths itself
  bool unitKnown = true;
  int upAxis = 1;
  bool axisKnown = true;
};

/// Meshes of one node and material are one part.
Model modelOf(const Json& tree, const std::string& file, const Placing& placing);

/// The numbers of a binary entry.
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
