// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedPiece.h"

#include "Support/Error.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// A point: the wall point that it is or stands above, and its place in the chain from there, 0 for the wall point.
struct ChainPoint
{
  SharedPoint wall;
  Index place;

  auto operator<=>(const ChainPoint&) const = default;
};

/// Sets the numbers in the mesh of all ranks of what this rank owns, one group after the other. `groupOf` returns the
/// group of each entry, or the number of groups for entries of other ranks. Returns the count on all ranks.
template <typename GroupOf>
std::uint64_t numberOwn(std::vector<std::uint64_t>& numbers, std::size_t groups, RankExchange& exchange,
                        GroupOf&& groupOf)
{
  std::vector<std::uint64_t> next(groups + 1, 0);
  for (Index i = 0; i < numbers.size(); ++i)
  {
    numbers[i] = next[groupOf(i)]++;
  }
  std::uint64_t before = 0;
  for (std::size_t group = 0; group < groups; ++group)
  {
    const GlobalCount count = countBefore(next[group], exchange);
    next[group] = before + count.before;
    before += count.all;
  }
  for (Index i = 0; i < numbers.size(); ++i)
  {
    numbers[i] += next[groupOf(i)];
  }
  return before;
}

/// Sets all numbers: own ones from `own`, others by request to their owners. `find` returns the number here of a key.
template <typename Key, typename KeyOf, typename RankOf, typename Find>
void askForOthers(std::vector<std::uint64_t>& numbers, const std::vector<std::uint64_t>& own,
                  const std::vector<Index>& before, const std::vector<int>& ranks, RankExchange& exchange,
                  KeyOf&& keyOf, RankOf&& rankOf, Find&& find)
{
  std::vector<Index> places;
  std::vector<Key> keys;
  numbers.resize(before.size());
  for (Index i = 0; i < before.size(); ++i)
  {
    numbers[i] = own[before[i]];
    if (ranks[i] != exchange.rank())
    {
      places.push_back(i);
      keys.push_back(keyOf(i));
    }
  }
  const std::vector<std::uint64_t> answers = askRanks<Key, std::uint64_t>(exchange, keys, rankOf, [&](const Key& key) {
    const Index found = find(key);
    if (found == noIndex)
    {
      throw RanksDisagree("ranks do not have the same mesh where their shares meet");
    }
    return own[found];
  });
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    numbers[places[i]] = answers[i];
  }
}

/// Returns the numbers before something was left out, one per number now.
std::vector<Index> numbersBefore(const std::vector<Index>& numbers, std::size_t count)
{
  std::vector<Index> before(count);
  for (Index i = 0; i < (numbers.empty() ? count : numbers.size()); ++i)
  {
    if (numbers.empty() || numbers[i] != noIndex)
    {
      before[numbers.empty() ? i : numbers[i]] = i;
    }
  }
  return before;
}

class PieceTaker
{
public:
  PieceTaker(const DualMesh& finished, const KeptNumbers& keptNumbers, const SharedLayers& shared,
             const LayerMesh& layerMesh, const RankShare& rankShare)
      : mesh(finished), kept(keptNumbers), layers(shared), layer(layerMesh), share(rankShare),
        elements(numbersBefore(kept.elements, mesh.elementCount())),
        points(numbersBefore(kept.points, mesh.points.size()))
  {
  }

  SharedPiece run(int ghostLevels, const std::vector<SharedElement>& asked)
  {
    takeElements(ghostLevels);
    takeFaces();
    if (out.mesh.zoneFaces.empty())
    {
      release(out.mesh.neighbors);
    }
    numberElements(asked);
    numberPoints();
    return std::move(out);
  }

private:
  bool isOwn(Index element) const { return layers.isOwn(elements[element]); }

  void takeElements(int ghostLevels)
  {
    std::vector<char> stays(mesh.elementCount());
    std::vector<char> hasPoint(mesh.points.size(), 0);
    for (Index e = 0; e < stays.size(); ++e)
    {
      stays[e] = isOwn(e) ? 1 : 0;
    }
    for (int level = 0;; ++level)
    {
      for (Index e = 0; e < stays.size(); ++e)
      {
        for (int c = 0; c < 8 && stays[e]; ++c)
        {
          hasPoint[mesh.corners[e][c]] = 1;
        }
      }
      if (level == ghostLevels)
      {
        break;
      }
      for (Index e = 0; e < stays.size(); ++e)
      {
        stays[e] = hasMarked(mesh.corners[e], hasPoint) ? 1 : 0;
      }
    }
    std::vector<Index> newPoints(mesh.points.size(), noIndex);
    const auto pointCount = static_cast<std::size_t>(std::ranges::count(hasPoint, 1));
    out.pointsBefore.reserve(pointCount);
    out.mesh.points.reserve(pointCount);
    for (Index p = 0; p < newPoints.size(); ++p)
    {
      if (hasPoint[p])
      {
        newPoints[p] = static_cast<Index>(out.pointsBefore.size());
        out.pointsBefore.push_back(p);
        out.mesh.points.push_back(mesh.points[p]);
      }
    }
    newElements.assign(mesh.elementCount(), noIndex);
    reserve(static_cast<std::size_t>(std::ranges::count(stays, 1)));
    for (Index e = 0; e < stays.size(); ++e)
    {
      if (stays[e])
      {
        newElements[e] = static_cast<Index>(out.elementsBefore.size());
        out.elementsBefore.push_back(e);
        std::array<Index, 8> corners;
        std::ranges::transform(mesh.corners[e], corners.begin(), [&](Index p) { return newPoints[p]; });
        out.mesh.corners.push_back(corners);
        appendLabels(out.mesh, mesh, e);
      }
    }
  }

  void reserve(std::size_t count)
  {
    out.elementsBefore.reserve(count);
    out.mesh.corners.reserve(count);
    out.mesh.levels.reserve(count);
    out.mesh.zones.reserve(count);
    out.mesh.rooms.reserve(mesh.rooms.empty() ? 0 : count);
    out.mesh.cellZones.reserve(mesh.cellZones.empty() ? 0 : count);
  }

  void takeFaces()
  {
    const auto count = static_cast<std::size_t>(
        std::ranges::count_if(mesh.boundaryFaces, [&](const BoundaryFace& face) { return isOwn(face.element); }));
    out.hasOpposite.reserve(count);
    out.mesh.boundaryFaces.reserve(count);
    out.facesBefore.reserve(count);
    for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
    {
      BoundaryFace face = mesh.boundaryFaces[f];
      if (isOwn(face.element))
      {
        out.hasOpposite.push_back(face.opposite != noIndex ? 1 : 0);
        face.element = newElements[face.element];
        face.opposite = face.opposite == noIndex ? noIndex : newElements[face.opposite];
        out.mesh.boundaryFaces.push_back(face);
        out.facesBefore.push_back(f);
      }
    }
    std::array<std::int32_t, 6> none;
    none.fill(DualMesh::noFace);
    out.mesh.neighbors.assign(mesh.zoneFaces.empty() ? 0 : out.mesh.elementCount(), none);
    for (ZoneFace face : mesh.zoneFaces)
    {
      if (isOwn(face.element))
      {
        const auto other = static_cast<Index>(mesh.neighbors[face.element][face.direction]);
        face.element = newElements[face.element];
        out.mesh.neighbors[face.element][face.direction] = static_cast<std::int32_t>(newElements[other]);
        out.mesh.zoneFaces.push_back(face);
      }
    }
  }

  void numberElements(const std::vector<SharedElement>& asked)
  {
    std::vector<std::uint64_t> own(mesh.elementCount());
    out.elementCount = numberOwn(own, 2, share.exchange(), [&](Index e) {
      return !isOwn(e) ? 2U : layer.plainElements > elements[e] ? 0U : 1U;
    });
    const auto keyOf = [&](Index i) { return layers.elementOf(elements[out.elementsBefore[i]]); };
    const auto rankOf = [&](const SharedElement& element) { return share.rankOf(element.point >> 3); };
    out.elementRanks.reserve(out.elementsBefore.size());
    for (Index i = 0; i < out.elementsBefore.size(); ++i)
    {
      out.elementRanks.push_back(isOwn(out.elementsBefore[i]) ? share.rank() : rankOf(keyOf(i)));
    }
    const auto find = [&](const SharedElement& key) {
      const Index found = layers.find(key);
      return found == noIndex || kept.elements.empty() ? found : kept.elements[found];
    };
    askForOthers<SharedElement>(out.elementNumbers, own, out.elementsBefore, out.elementRanks, share.exchange(), keyOf,
                                rankOf, find);
    out.askedNumbers =
        askRanks<SharedElement, std::uint64_t>(share.exchange(), asked, rankOf, [&](const SharedElement& key) {
          const Index found = find(key);
          return found == noIndex ? noNumber : own[found];
        });
  }

  SharedPoint wallOf(Index point) const { return layers.wallPointOf(points[point]); }
  Index placeOf(Index point) const
  {
    return layer.isNew(points[point]) ? layer.places[points[point] - layer.plainPoints] : 0;
  }

  void numberPoints()
  {
    std::vector<std::uint64_t> own(mesh.points.size());
    out.pointCount = numberOwn(own, 4, share.exchange(), [&](Index p) {
      const SharedPoint wall = wallOf(p);
      return !share.isOwn(wall.leaf) ? 4U : (placeOf(p) > 0 ? 2U : 0U) + (wall.copy > 0 ? 1U : 0U);
    });
    const auto keyOf = [&](Index i) { return ChainPoint{wallOf(out.pointsBefore[i]), placeOf(out.pointsBefore[i])}; };
    const auto rankOf = [&](const ChainPoint& point) { return share.rankOf(point.wall.leaf); };
    out.pointRanks.reserve(out.pointsBefore.size());
    for (Index i = 0; i < out.pointsBefore.size(); ++i)
    {
      out.pointRanks.push_back(rankOf(keyOf(i)));
    }
    askForOthers<ChainPoint>(out.pointNumbers, own, out.pointsBefore, out.pointRanks, share.exchange(), keyOf, rankOf,
                             [&](const ChainPoint& key) { return find(key); });
  }

  /// Returns a point's number here; noIndex if there is none.
  Index find(const ChainPoint& point) const
  {
    Index found = layers.find(point.wall);
    if (found != noIndex && point.place > 0)
    {
      const Index copy = layer.copies[found];
      const Index count = copy == noIndex ? 0 : layer.places[copy - layer.plainPoints];
      found = point.place <= count ? copy - (count - point.place) : noIndex;
    }
    return found == noIndex || kept.points.empty() ? found : kept.points[found];
  }

  const DualMesh& mesh;
  const KeptNumbers& kept;
  const SharedLayers& layers;
  const LayerMesh& layer;
  const RankShare& share;
  std::vector<Index> elements; ///< numbers before any were left out, one per element
  std::vector<Index> points;
  std::vector<Index> newElements;
  SharedPiece out;
};

} // namespace

SharedPiece takePiece(const DualMesh& mesh, const KeptNumbers& kept, const SharedLayers& layers, const LayerMesh& layer,
                      const RankShare& share, int ghostLevels, const std::vector<SharedElement>& asked)
{
  return PieceTaker(mesh, kept, layers, layer, share).run(ghostLevels, asked);
}

} // namespace atria
