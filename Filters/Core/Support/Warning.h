// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings in the order in which a reader needs them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace atria {

/// How much of a result a warning puts in doubt.
enum class Gravity : std::uint8_t
{
  detail, ///< one thing among many
  usual,
  grave ///< all of it, such as a wrong unit
};

struct Warning
{
  std::string text; ///< a sentence that says what to do
  Gravity gravity = Gravity::usual;
  std::size_t count = 1; ///< how many it stands for
};

/// Returns the gravest first. Those of one gravity keep their order.
std::vector<Warning> byGravity(std::vector<Warning> warnings);

/// Makes one of those whose texts differ only in names in quotes and in numbers: the first text, how many more there
/// are, and the first names of these. Keeps the order of the first ones. O(length of all texts).
std::vector<Warning> counted(const std::vector<Warning>& warnings);

} // namespace atria
