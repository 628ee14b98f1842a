// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the numbers of elements and points on other ranks.
#pragma once

#include "Ranks/RankShare.h"
#include "Support/GlobalCount.h"

#include <algorithm>
#include <iterator>

namespace atria {

/// A point of a plain mesh: the finest key of its vertex's leaf, and which of the points it is that the vertex became
/// where sheets were split. The vertex itself is 0.
struct SharedPoint
{
  MortonKey leaf;
  Index copy;

  auto operator<=>(const SharedPoint&) const = default;
};

/// Requests values for keys from the ranks that own them. `rankOf` returns the owner of a key, and `answer` the value
/// of one of this rank's own keys. Returns one answer per key.
template <typename Key, typename Answer, typename RankOf, typename AnswerTo>
std::vector<Answer> askRanks(RankExchange& exchange, const std::vector<Key>& keys, RankOf&& rankOf, AnswerTo&& answer)
{
  const auto ranks = static_cast<std::size_t>(exchange.ranks());
  std::vector<std::vector<Key>> asked(ranks);
  std::vector<std::vector<std::size_t>> places(ranks);
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto rank = static_cast<std::size_t>(rankOf(keys[i]));
    asked[rank].push_back(keys[i]);
    places[rank].push_back(i);
  }
  std::vector<std::vector<Answer>> answers;
  for (const std::vector<Key>& some : exchangeLists(exchange, asked))
  {
    std::vector<Answer>& out = answers.emplace_back();
    for (const Key& key : some)
    {
      out.push_back(answer(key));
    }
  }
  std::vector<Answer> result(keys.size());
  const auto received = exchangeLists(exchange, answers);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    for (std::size_t i = 0; i < places[rank].size(); ++i)
    {
      result[places[rank][i]] = received[rank][i];
    }
  }
  return result;
}

/// Returns, for each rank, the numbers of what it has of this one. `theirs` has the numbers of what this rank has of
/// each other, `keyOf` turns them into keys, and `numberOf` finds the number of a key that others request. The lists
/// then have the same order on both ranks.
template <typename Key, typename KeyOf, typename NumberOf>
std::vector<std::vector<Index>> askedOf(const std::vector<std::vector<Index>>& theirs, RankExchange& exchange,
                                        KeyOf&& keyOf, NumberOf&& numberOf)
{
  std::vector<std::vector<Key>> asked(theirs.size());
  for (std::size_t rank = 0; rank < theirs.size(); ++rank)
  {
    std::ranges::transform(theirs[rank], std::back_inserter(asked[rank]), keyOf);
  }
  std::vector<std::vector<Index>> ours;
  for (const std::vector<Key>& some : exchangeLists(exchange, asked))
  {
    std::ranges::transform(some, std::back_inserter(ours.emplace_back()), numberOf);
  }
  return ours;
}

} // namespace atria
