// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which the core exchanges data with the other ranks that make one mesh.
#pragma once

#include "Support/Bytes.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <functional>

namespace atria {

/// Thrown if ranks found different results where their shares of a mesh meet. One of them has to make the whole mesh
/// then.
class RanksDisagree : public Error
{
  using Error::Error;
};

/// Every rank makes the same calls, in the same order.
class RankExchange
{
public:
  virtual ~RankExchange() = default;
  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  /// Sends each rank its entry of `toRanks`, itself included, and returns one entry from each rank. Throws if another
  /// rank failed: Aborted if that was aborted, RanksDisagree if it threw that, else Error with its message.
  virtual std::vector<Bytes> exchange(std::vector<Bytes> toRanks) = 0;
  /// The same, with the same bytes for all ranks.
  virtual std::vector<Bytes> gather(const Bytes& own)
  {
    return exchange(std::vector<Bytes>(static_cast<std::size_t>(ranks()), own));
  }
  /// Runs `work` on all ranks together. Returns false on all of them if any throws RanksDisagree; they may try
  /// something else then. Any other exception is thrown on all ranks, as exchange() says.
  virtual bool agreeOn(const std::function<void()>& work) = 0;
};

/// Returns the values as bytes; see ByteWriter.
template <typename... T> Bytes bytesOf(const T&... values)
{
  ByteWriter writer;
  (writer(values), ...);
  return writer.take();
}
template <typename... T> void readBytes(const Bytes& bytes, T&... values)
{
  ByteReader reader(bytes);
  (reader(values), ...);
}

/// Gathers the value of each rank on all ranks. One entry per rank.
template <typename T> std::vector<T> gatherAll(RankExchange& ranks, const T& own)
{
  std::vector<T> out;
  for (const Bytes& bytes : ranks.gather(bytesOf(own)))
  {
    readBytes(bytes, out.emplace_back());
  }
  return out;
}

/// Returns the sums over all ranks, entry by entry. The lists must be equally long.
template <typename List> List sumOverRanks(RankExchange& ranks, const List& own)
{
  List sums = own;
  std::ranges::fill(sums, typename List::value_type{});
  for (const List& some : gatherAll(ranks, own))
  {
    std::ranges::transform(some, sums, sums.begin(), std::plus<>());
  }
  return sums;
}

/// True if `here` is true on any rank.
inline bool isAnywhere(bool here, RankExchange& ranks)
{
  return sumOverRanks(ranks, std::array{here ? std::size_t{1} : 0})[0] > 0;
}

/// Sends one list to each rank. Returns the lists that the ranks sent to this one.
template <typename T>
std::vector<std::vector<T>> exchangeLists(RankExchange& ranks, const std::vector<std::vector<T>>& toRanks)
{
  std::vector<Bytes> bytes(toRanks.size());
  std::ranges::transform(toRanks, bytes.begin(), [](const std::vector<T>& list) { return bytesOf(list); });
  std::vector<std::vector<T>> out;
  for (const Bytes& received : ranks.exchange(std::move(bytes)))
  {
    readBytes(received, out.emplace_back());
  }
  return out;
}

} // namespace atria
