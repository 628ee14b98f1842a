// SPDX-License-Identifier: GPL-3.0-or-later
/// Count, scan, fill: results of unknown length, collected by several threads in the order of one.
#pragma once

#include "Support/Error.h"
#include "Support/Executor.h"
#include "Support/Types.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace atria {

/// Pieces of fixed length, which do not depend on the number of threads.
struct Pieces
{
  static constexpr std::size_t length = 4096;

  explicit Pieces(std::size_t itemCount) : items(itemCount), count((itemCount + length - 1) / length) {}

  std::size_t begin(std::size_t piece) const { return piece * length; }
  std::size_t end(std::size_t piece) const { return std::min(items, begin(piece) + length); }

  std::size_t items;
  std::size_t count;
};

/// Turns counts into offsets: each becomes the sum of those before it. Returns the sum of all.
template <typename T> T scan(std::vector<T>& counts)
{
  T sum{};
  for (T& count : counts)
  {
    const T own = count;
    count = sum;
    sum = sum + own;
  }
  return sum;
}

/// The numbers below `count` that `isChosen`, in order. That is asked twice for each.
template <typename IsChosen>
std::vector<Index> chosenNumbers(std::size_t count, const Executor& executor, IsChosen&& isChosen)
{
  const Pieces pieces(count);
  std::vector<std::size_t> firsts(pieces.count, 0);
  executor.forEach(pieces.count, 4, [&](std::size_t piece) {
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      firsts[piece] += isChosen(i) ? 1 : 0;
    }
  });
  std::vector<Index> numbers(scan(firsts));
  executor.forEach(pieces.count, 4, [&](std::size_t piece) {
    std::size_t next = firsts[piece];
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      if (isChosen(i))
      {
        numbers[next++] = static_cast<Index>(i);
      }
    }
  });
  return numbers;
}

/// Of the errors several threads meet, keeps the one that a single thread would meet first.
class FirstError
{
public:
  void note(std::size_t place, const std::string& what)
  {
    const std::lock_guard lock(mutex);
    if (place < first)
    {
      first = place;
      text = what;
    }
  }

  void rethrow() const
  {
    if (!text.empty())
    {
      throw Error(text);
    }
  }

private:
  std::mutex mutex;
  std::size_t first = static_cast<std::size_t>(-1);
  std::string text;
};

} // namespace atria
