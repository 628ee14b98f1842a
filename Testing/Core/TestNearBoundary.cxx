// SPDX-License-Identifier: GPL-3.0-or-later
/// What is near the boundary of a mesh, found by parts of it.
#include "Mesher/Blocks/MeshBlocks.h"
#include "Ranks/SharedNumbers.h"
#include "Support/MeshIt.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

/// Elements are divided by number; all of others are asked for.
class RangeExchange : public NearExchange
{
public:
  RangeExchange(std::size_t elements, RankExchange& exchange) : elements_(elements), exchange_(exchange)
  {
    for (Index e = 0; e < elements; ++e)
    {
      if (rankOf(e) != exchange.rank())
      {
        others_.push_back(e);
      }
    }
  }

  bool isOwn(Index element) const override { return rankOf(element) == exchange_.rank(); }
  bool isAny(bool own) const override { return isAnywhere(own, exchange_); }
  std::vector<Index> takeElements(std::vector<std::uint8_t>& values) const override
  {
    const std::vector<std::uint8_t> theirs = askRanks<Index, std::uint8_t>(
        exchange_, others_, [&](Index e) { return rankOf(e); }, [&](Index e) { return values[e]; });
    std::vector<Index> changed;
    for (std::size_t i = 0; i < others_.size(); ++i)
    {
      if (values[others_[i]] != theirs[i])
      {
        values[others_[i]] = theirs[i];
        changed.push_back(others_[i]);
      }
    }
    return changed;
  }
  void takeVertices(std::vector<char>& values) const override
  {
    for (const std::vector<char>& some : gatherAll(exchange_, values))
    {
      std::ranges::transform(some, values, values.begin(), [](char a, char b) { return a | b; });
    }
  }

private:
  int rankOf(Index element) const
  {
    return static_cast<int>(element * static_cast<std::size_t>(exchange_.ranks()) / elements_);
  }

  std::size_t elements_;
  RankExchange& exchange_;
  std::vector<Index> others_;
};

TEST(NearBoundary, PartsFindWhatTheWholeDoes)
{
  for (unsigned seed = 1; seed <= 6; ++seed)
  {
    SCOPED_TRACE(seed);
    const Meshed whole = meshSoup(seed, seed % 2 == 0 ? 0.25 : 0.5);
    const DualMesh& mesh = whole.mesh();
    std::vector<Index> vertices(mesh.points.size());
    std::iota(vertices.begin(), vertices.end(), Index{0});
    const NearBoundary all = findNearBoundary(mesh, vertices, vertices.size());
    EXPECT_GT(std::ranges::count(all.rows, NearBoundary::far), 0);
    for (const int ranks : {1, 2, 5})
    {
      SCOPED_TRACE(ranks);
      onRanks(ranks, [&](RankExchange& exchange) {
        const RangeExchange parts(mesh.elementCount(), exchange);
        const NearBoundary found = findNearBoundary(mesh, vertices, vertices.size(), parts);
        EXPECT_EQ(found.rows, all.rows);
        EXPECT_EQ(found.mayMove, all.mayMove);
      });
    }
  }
}

} // namespace
