// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings, sorted by gravity and merged if they are alike.
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
  std::size_t count = 1; ///< number of warnings it stands for
};

/// Returns the gravest first. Warnings of equal gravity keep their order.
std::vector<Warning> byGravity(std::vector<Warning> warnings);

/// Merges warnings whose texts differ only in quoted names and in numbers. The merged text is the first one, with the
/// number of others and the first names that differ. Keeps the order of the first ones. O(length of all texts).
std::vector<Warning> counted(const std::vector<Warning>& warnings);

} // namespace atria
