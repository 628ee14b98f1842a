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

/// Thrown on all ranks if one of them has to make the whole mesh, because a result is not found in parts.
class WholeNeeded : public Error
{
  using Error::Error;
};

/// The exchange of a process that makes the whole mesh.
class SoleRank final : public RankExchange
{
public:
  int rank() const override { return 0; }
  int ranks() const override { return 1; }
  std::vector<Bytes> exchange(std::vector<Bytes> toRanks) override { return toRanks; }
  bool agreeOn(const std::function<void()>& work) override
  {
    work();
    return true;
  }
};

/// Returns the exchange of a process that makes the whole mesh. Threads may share it.
inline RankExchange& alone()
{
  static SoleRank sole;
  return sole;
}

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
  if (ranks.ranks() == 1)
  {
    return {own};
  }
  std::vector<T> out;
  for (const Bytes& bytes : ranks.gather(bytesOf(own)))
  {
    readBytes(bytes, out.emplace_back());
  }
  return out;
}

/// Gathers the lists of all ranks, in the order of ranks, as one list on all ranks.
template <typename T> std::vector<T> joinAll(RankExchange& ranks, std::vector<T> own)
{
  if (ranks.ranks() == 1)
  {
    return own;
  }
  std::vector<T> all;
  for (const std::vector<T>& some : gatherAll(ranks, own))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// Adds up the lists of all ranks, entry by entry, by `add(more, sum)`. The lists must be equally long.
template <typename List, typename Add> List addAll(RankExchange& ranks, List own, Add&& add)
{
  if (ranks.ranks() == 1)
  {
    return own;
  }
  List sums = own;
  std::ranges::fill(sums, typename List::value_type{});
  for (const List& some : gatherAll(ranks, own))
  {
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
      add(some[i], sums[i]);
    }
  }
  return sums;
}

/// Returns the sums over all ranks, entry by entry. The lists must be equally long.
template <typename List> List sumAll(RankExchange& ranks, List own)
{
  return addAll(ranks, std::move(own), [](const auto& more, auto& sum) { sum += more; });
}

/// Returns for each entry whether it is set on any rank. The lists must be equally long.
inline std::vector<char> anyOfAll(RankExchange& ranks, std::vector<char> own)
{
  return addAll(ranks, std::move(own), [](char more, char& any) { any = static_cast<char>(any | more); });
}

/// True if `here` is true on any rank.
inline bool isAnywhere(bool here, RankExchange& ranks)
{
  return sumAll(ranks, std::array{here ? std::size_t{1} : 0})[0] > 0;
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
