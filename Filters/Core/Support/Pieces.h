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

/// Returns all that `collect(begin, end, out)` appends for pieces of [0, count), in order.
template <typename Collect>
std::vector<Index> collectInOrder(std::size_t count, const Executor& executor, Collect&& collect)
{
  const Pieces pieces(count);
  std::vector<std::vector<Index>> found(pieces.count);
  executor.forEach(pieces.count, 4,
                   [&](std::size_t piece) { collect(pieces.begin(piece), pieces.end(piece), found[piece]); });
  std::size_t size = 0;
  for (const std::vector<Index>& some : found)
  {
    size += some.size();
  }
  std::vector<Index> all;
  all.reserve(size);
  for (const std::vector<Index>& some : found)
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Returns the numbers below `count` for which `isChosen` is true, in order.
template <typename IsChosen>
std::vector<Index> chosenNumbers(std::size_t count, const Executor& executor, IsChosen&& isChosen)
{
  return collectInOrder(count, executor, [&](std::size_t begin, std::size_t end, std::vector<Index>& out) {
    for (std::size_t i = begin; i < end; ++i)
    {
      if (isChosen(i))
      {
        out.push_back(static_cast<Index>(i));
      }
    }
  });
}

/// Keeps the error that a single thread would meet first, out of those that several threads meet.
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
