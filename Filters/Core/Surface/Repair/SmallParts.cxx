// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/SmallParts.h"

#include "Support/UnionFind.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Triangles/BoundaryEdges.h"
#include "Surface/Triangles/SoupParts.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

/// Edge of the cells in which small parts count as one, in sizes of octants at features.
constexpr double cellRatio = 0.25;

/// Groups of small parts.
class SmallParts
{
public:
  SmallParts(const TriangleSoup& soup_, const GridFrame& frame_, const SmallPartOptions& options_,
             const RunContext& runContext)
      : soup(soup_), frame(frame_), options(options_), context(runContext), parts(partsOf(soup))
  {
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      const Index part = partOf(t);
      if (part >= boxes.size())
      {
        boxes.resize(part + 1, noBox);
      }
      boxes[part].extend(boxOf(soup, t, 0));
    }
    isOut.resize(boxes.size());
    std::ranges::transform(boxes, isOut.begin(), [&](const LatticeBox& box) { return isSmall(box); });
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      const Index surface = soup.surfaceIds[t];
      const bool isKept = surface < options.keptSurfaces.size() && options.keptSurfaces[surface];
      isOut[partOf(t)] = isOut[partOf(t)] && !isKept ? 1 : 0;
    }
    groups.reset(boxes.size());
  }

  std::vector<char> find()
  {
    joinNear();
    keepLargeGroups();
    keepPatches();
    std::vector<char> marked(soup.triangles.size());
    for (Index t = 0; t < marked.size(); ++t)
    {
      marked[t] = isOut[partOf(t)];
    }
    return marked;
  }

private:
  static constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max();
  static constexpr LatticeBox noBox{{far, far, far}, {-far, -far, -far}};

  Index partOf(Index t) const { return parts[soup.sources[t]]; }

  bool isSmall(const LatticeBox& box) const
  {
    if (box.empty())
    {
      return false;
    }
    auto size = static_cast<double>(frame.latticeSize(frame.featureLevel));
    for (const FinerPlace& place : options.finerPlaces)
    {
      size = overlap(place.box, box) ? std::min(size, static_cast<double>(frame.latticeSize(place.level))) : size;
    }
    return between(box.low, box.high).norm() < options.size * size;
  }

  /// Joins small parts whose boxes touch the same cell.
  void joinNear()
  {
    const auto cell =
        static_cast<std::int64_t>(std::ceil(cellRatio * static_cast<double>(frame.latticeSize(frame.featureLevel))));
    const auto cellOf = [&](std::int64_t at) { return at >= 0 ? at / cell : -((cell - 1 - at) / cell); };
    std::map<LatticePoint, Index> firstIn;
    for (Index part = 0; part < boxes.size(); ++part)
    {
      if (!isOut[part])
      {
        continue;
      }
      const LatticeBox box = grown(boxes[part], static_cast<std::int64_t>(std::ceil(options.gapTolerance)));
      for (std::int64_t x = cellOf(box.low[0]); x <= cellOf(box.high[0]); ++x)
      {
        for (std::int64_t y = cellOf(box.low[1]); y <= cellOf(box.high[1]); ++y)
        {
          for (std::int64_t z = cellOf(box.low[2]); z <= cellOf(box.high[2]); ++z)
          {
            groups.join(part, firstIn.try_emplace({x, y, z}, part).first->second);
          }
        }
      }
    }
  }

  void keepLargeGroups()
  {
    std::vector<LatticeBox> ofGroup(boxes.size(), noBox);
    for (Index part = 0; part < boxes.size(); ++part)
    {
      if (isOut[part])
      {
        ofGroup[groups.find(part)].extend(boxes[part]);
      }
    }
    for (Index part = 0; part < boxes.size(); ++part)
    {
      isOut[part] = isOut[part] && isSmall(ofGroup[groups.find(part)]) ? 1 : 0;
    }
  }

  /// Keeps groups at a boundary edge of parts that stay: they may close a hole there.
  void keepPatches()
  {
    std::vector<NumberedBox> small;
    for (Index part = 0; part < boxes.size(); ++part)
    {
      if (isOut[part])
      {
        small.push_back({grown(boxes[part], static_cast<std::int64_t>(std::ceil(options.gapTolerance))), part});
      }
    }
    if (small.empty())
    {
      return;
    }
    const BoxTree tree(std::move(small), context);
    const BoundaryEdges boundary(soup.triangles, soup.points.size(), context.executor,
                                 [&](Index t) { return !isOut[partOf(t)]; });
    std::vector<char> isPatch(boxes.size(), 0);
    for (const BoundaryEdge& edge : boundary.edges())
    {
      tree.eachTouching(boundsOf(soup.points[edge.a], soup.points[edge.b]), 0,
                        [&](std::size_t place) { isPatch[groups.find(tree.box(place).id)] = 1; });
    }
    for (Index part = 0; part < boxes.size(); ++part)
    {
      isOut[part] = isOut[part] && !isPatch[groups.find(part)] ? 1 : 0;
    }
  }

  const TriangleSoup& soup;
  const GridFrame& frame;
  const SmallPartOptions& options;
  const RunContext& context;
  std::vector<Index> parts;
  std::vector<LatticeBox> boxes;
  std::vector<char> isOut;
  UnionFind groups;
};

} // namespace

std::vector<char> findSmallParts(const TriangleSoup& soup, const GridFrame& frame, const SmallPartOptions& options,
                                 const RunContext& context)
{
  if (!(options.size > 0.0) || soup.triangles.empty())
  {
    return std::vector<char>(soup.triangles.size(), 0);
  }
  return SmallParts(soup, frame, options, context).find();
}

} // namespace atria
