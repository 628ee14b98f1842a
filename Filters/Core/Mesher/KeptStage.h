// SPDX-License-Identifier: GPL-3.0-or-later
/// Results of stages that later runs may take again.
#pragma once

#include <memory>
#include <optional>

namespace atria {

/// The result of a stage, and the options it was made with. A stage reads no other options: `Options` is the list.
template <typename Options, typename Result> struct KeptStage
{
  std::optional<Options> options;
  std::unique_ptr<Result> result;

  bool isOf(const Options& asked) const { return result && options && isSame(*options, asked); }
};

} // namespace atria
