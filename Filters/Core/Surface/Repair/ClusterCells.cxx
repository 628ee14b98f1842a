// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/ClusterCells.h"

#include "Support/FewNumbers.h"
#include "Support/Pieces.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

LatticeBox boxOfOctant(const GridFrame& frame, int level, MortonKey key)
{
  const GridCell cell = gridCell(key);
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = static_cast<std::int64_t>(cell[axis]) * frame.latticeSize(level);
    box.high[axis] = box.low[axis] + frame.latticeSize(level);
  }
  return box;
}

/// Walks down from the root until octants hold few pieces or are smallest.
class ClusterSearch
{
public:
  ClusterSearch(const TriangleSoup& soup_, const std::vector<Index>& piecesOf, const GridFrame& frame_,
                const ClusterOptions& options_, const RunContext& runContext,
                std::vector<std::unordered_set<MortonKey>>& found, std::vector<char>& seen)
      : soup(soup_), pieces(piecesOf), frame(frame_), options(options_), context(runContext), keys(found), isSeen(seen)
  {
  }

  void descend(int level, MortonKey key, const std::vector<Index>& triangles)
  {
    if (!isDense(triangles))
    {
      for (const Index t : triangles)
      {
        isSeen[soup.sources[t]] = 1;
      }
      return;
    }
    if (level >= levelAt(boxOfOctant(frame, level, key)))
    {
      keys[level - frame.featureLevel].insert(key);
      return;
    }
    context.progress.check();
    std::array<std::vector<Index>, 8> parts = divide(level, key, triangles);
    for (unsigned k = 0; k < 8; ++k)
    {
      if (!parts[k].empty())
      {
        descend(level + 1, key << 3 | k, parts[k]);
        parts[k] = {};
      }
    }
  }

private:
  bool isDense(const std::vector<Index>& triangles) const
  {
    FewNumbers<mostPiecesOfOctant> seen;
    return !std::ranges::all_of(triangles, [&](Index t) { return seen.add(pieces[t]); });
  }

  int levelAt(const LatticeBox& box) const
  {
    int level = frame.featureLevel;
    for (const FinerPlace& place : options.finerPlaces)
    {
      level = overlap(place.box, box) ? std::max(level, place.level) : level;
    }
    return level;
  }

  std::array<std::vector<Index>, 8> divide(int level, MortonKey key, const std::vector<Index>& triangles) const
  {
    std::array<LatticeBox, 8> boxes;
    for (unsigned k = 0; k < 8; ++k)
    {
      boxes[k] = boxOfOctant(frame, level + 1, key << 3 | k);
    }
    std::array<std::vector<Index>, 8> parts;
    for (const Index t : triangles)
    {
      TriangleBoxTest test(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2));
      for (unsigned k = 0; k < 8; ++k)
      {
        if (test.touches(boxes[k]))
        {
          parts[k].push_back(t);
        }
      }
    }
    return parts;
  }

  const TriangleSoup& soup;
  const std::vector<Index>& pieces;
  const GridFrame& frame;
  const ClusterOptions& options;
  const RunContext& context;
  std::vector<std::unordered_set<MortonKey>>& keys;
  std::vector<char>& isSeen;
};

} // namespace

ClusterCells::ClusterCells(const TriangleSoup& soup, const std::vector<Index>& pieces, const GridFrame& frame,
                           const ClusterOptions& options, const RunContext& context)
    : frame_(frame)
{
  for (const FinerPlace& place : options.finerPlaces)
  {
    finestLevel_ = std::max(finestLevel_, place.level);
  }
  finestLevel_ = std::max(finestLevel_, frame.featureLevel);
  keys_.resize(static_cast<std::size_t>(finestLevel_ - frame.featureLevel) + 1);
  isSeen_.resize(soup.sources.empty() ? 0 : soup.sources.back() + 1, 0);
  const LatticeBox root = boxOfOctant(frame, 0, 0);
  std::vector<Index> inRoot;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    if (touches(root, soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2)))
    {
      inRoot.push_back(t);
    }
  }
  ClusterSearch(soup, pieces, frame, options, context, keys_, isSeen_).descend(0, 0, inRoot);
}

void ClusterCells::hide(Index source)
{
  isSeen_.resize(std::max<std::size_t>(isSeen_.size(), source + 1), 1);
  isSeen_[source] = 0;
}

std::vector<Index> seenTriangles(const TriangleSoup& soup, const ClusterCells& clusters, const RunContext& context)
{
  return chosenNumbers(soup.triangles.size(), context.executor,
                       [&](std::size_t t) { return !clusters.isHidden(soup.sources[t]); });
}

bool ClusterCells::hold(const LatticeBox& box) const
{
  const auto isIn = [&](const GridCell& cell) {
    MortonKey key = mortonKey(cell);
    for (int level = finestLevel_; level >= frame_.featureLevel; --level, key >>= 3)
    {
      if (keys_[level - frame_.featureLevel].contains(key))
      {
        return true;
      }
    }
    return false;
  };
  if (std::ranges::all_of(keys_, [](const auto& keys) { return keys.empty(); }))
  {
    return false;
  }
  const std::int64_t size = frame_.latticeSize(finestLevel_);
  const std::int64_t root = frame_.latticeSize(0);
  GridCell low;
  GridCell high;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (box.low[axis] < 0 || box.high[axis] >= root ||
        box.high[axis] - box.low[axis] > frame_.latticeSize(frame_.featureLevel))
    {
      return false;
    }
    low[axis] = static_cast<std::uint32_t>(box.low[axis] / size);
    high[axis] = static_cast<std::uint32_t>(box.high[axis] / size);
  }
  for (std::uint32_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::uint32_t y = low[1]; y <= high[1]; ++y)
    {
      for (std::uint32_t x = low[0]; x <= high[0]; ++x)
      {
        if (!isIn({x, y, z}))
        {
          return false;
        }
      }
    }
  }
  return true;
}

} // namespace atria
