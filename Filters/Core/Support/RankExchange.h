// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which the core talks with the other ranks that make one mesh.
#pragma once

#include "Support/Bytes.h"
#include "Support/Error.h"

#include <algorithm>
#include <array>
#include <functional>

namespace atria {

/// Ranks have found something else where their shares of a mesh meet: one of them has to make the whole.
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
  /// Sends each rank what is for it, itself included, and returns what came from each. Throws where another rank has
  /// failed instead: Aborted if it was aborted, RanksDisagree if that is what it threw, else Error with its message.
  virtual std::vector<Bytes> exchange(std::vector<Bytes> toRanks) = 0;
  /// The same with one thing for all ranks.
  virtual std::vector<Bytes> gather(const Bytes& own)
  {
    return exchange(std::vector<Bytes>(static_cast<std::size_t>(ranks()), own));
  }
  /// Does what all ranks do together. False, on all of them, where any throws RanksDisagree: they may try something
  /// else then. Throws on all what else any throws, as exchange() says.
  virtual bool agreeOn(const std::function<void()>& work) = 0;
};

/// The values that an archive takes of something, as bytes; see ByteWriter.
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

/// What each rank has, on all ranks, by rank.
template <typename T> std::vector<T> gatherAll(RankExchange& ranks, const T& own)
{
  std::vector<T> out;
  for (const Bytes& bytes : ranks.gather(bytesOf(own)))
  {
    readBytes(bytes, out.emplace_back());
  }
  return out;
}

/// The sums over all ranks of lists that are equally long.
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

/// Whether something is so on any rank.
inline bool isAnywhere(bool here, RankExchange& ranks)
{
  return sumOverRanks(ranks, std::array{here ? std::size_t{1} : 0})[0] > 0;
}

/// Lists of values, one for each rank, for those lists that are for this one.
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
