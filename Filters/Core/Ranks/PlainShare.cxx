// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/PlainShare.h"

#include "Support/IndexTable.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace atria {

namespace {

/// Returns the shared points of a mesh, from the vertex of each point and the leaf of each vertex.
std::vector<SharedPoint> sharedPointsOf(const std::vector<Index>& vertexOf, const std::vector<Index>& leaves,
                                        const Octree& octree)
{
  std::vector<SharedPoint> points(vertexOf.size());
  std::map<Index, Index> copies;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    points[p] = {octree.finestKey(leaves[vertexOf[p]]), p < leaves.size() ? 0 : ++copies[vertexOf[p]]};
  }
  return points;
}

void markPoints(const DualMesh& mesh, Index element, std::vector<char>& marked)
{
  std::ranges::for_each(mesh.corners[element], [&](Index p) { marked[p] = 1; });
}

/// Returns the elements of other ranks at marked points. Throws RanksDisagree if the octree ends before them.
std::vector<Index> othersAtPoints(const PlainShare& own, const std::vector<char>& marked)
{
  std::vector<Index> elements;
  for (Index e = 0; e < own.keys.size(); ++e)
  {
    if (!own.isOwn(e) && hasMarked(own.plain.mesh.corners[e], marked))
    {
      if (own.keys[e] == noKey)
      {
        throw RanksDisagree("a rank's octree ends beside its share");
      }
      elements.push_back(e);
    }
  }
  return elements;
}

std::vector<Index> elementsBeside(const PlainShare& own, const RankShare& share)
{
  std::vector<char> marked(own.points.size());
  std::ranges::transform(own.points, marked.begin(),
                         [&](const SharedPoint& point) { return share.isOwn(point.leaf) ? 1 : 0; });
  for (Index e = own.firstOwn; e < own.endOwn; ++e)
  {
    markPoints(own.plain.mesh, e, marked);
  }
  return othersAtPoints(own, marked);
}

struct ElementSum
{
  PointKey element;
  std::uint64_t sum;
};

/// Sums up the properties of an element, without numbers that only this rank has.
class ElementSummer
{
public:
  explicit ElementSummer(const PlainShare& own) : own_(own), mesh_(own.plain.mesh) {}

  std::uint64_t sumOf(Index element)
  {
    sum_ = 0;
    add(static_cast<std::uint64_t>(mesh_.levels[element]));
    add(static_cast<std::uint64_t>(mesh_.zones[element]));
    add(mesh_.rooms.empty() ? 0 : static_cast<std::uint64_t>(mesh_.rooms[element]));
    add(mesh_.cellZones.empty() ? 0 : static_cast<std::uint64_t>(mesh_.cellZones[element]));
    std::ranges::for_each(mesh_.corners[element], [this](Index point) { addPoint(point); });
    std::ranges::for_each(mesh_.neighbors[element], [this](std::int32_t code) { addFace(code); });
    return sum_;
  }

private:
  void add(std::uint64_t value) { sum_ = mixed(sum_ + value); }

  void addPoint(Index point)
  {
    const VertexClassification& classification = own_.plain.classification;
    const Index vertex = own_.plain.vertexOf[point];
    add(own_.points[point].leaf);
    add(own_.points[point].copy);
    add(static_cast<std::uint64_t>(classification.classes[vertex]));
    add(classification.turnedSides.empty() ? 0 : static_cast<std::uint64_t>(classification.turnedSides[vertex]));
    std::ranges::for_each(classification.piecesOf(vertex), [this](Index piece) { add(piece); });
  }

  void addFace(std::int32_t code)
  {
    if (!DualMesh::isBoundary(code))
    {
      add(code == DualMesh::noFace ? 0 : 1);
      return;
    }
    const BoundaryFace& face = mesh_.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    add(2);
    add(face.tag);
    add(static_cast<std::uint64_t>(face.side));
    add(face.chart);
    add(face.opposite == noIndex ? 0 : 1);
  }

  const PlainShare& own_;
  const DualMesh& mesh_;
  std::uint64_t sum_ = 0;
};

} // namespace

Index PlainShare::vertexOf(MortonKey leaf) const
{
  const auto end = points.begin() + static_cast<std::ptrdiff_t>(plain.classification.classes.size());
  const auto found = std::lower_bound(points.begin(), end, SharedPoint{leaf, 0});
  if (found == end || found->leaf != leaf)
  {
    throw RanksDisagree("ranks do not have the same points where their shares meet");
  }
  return static_cast<Index>(found - points.begin());
}

std::vector<Index> PlainShare::besideThese(const std::vector<Index>& elements) const
{
  std::vector<char> marked(points.size(), 0);
  std::ranges::for_each(elements, [&](Index e) { markPoints(plain.mesh, e, marked); });
  return othersAtPoints(*this, marked);
}

PlainShare shareOf(ClassifiedMesh plain, std::vector<PointKey> keys, const Octree& octree, const RankShare& share)
{
  PlainShare out{std::move(plain), std::move(keys), 0, 0, {}, {}};
  std::tie(out.firstOwn, out.endOwn) = ownRange(out.keys, share);
  out.points = sharedPointsOf(out.plain.vertexOf, out.plain.classification.leaves, octree);
  out.beside = elementsBeside(out, share);
  return out;
}

void expectSameElements(const PlainShare& own, const RankShare& share)
{
  ElementSummer summer(own);
  std::vector<std::vector<ElementSum>> sums(static_cast<std::size_t>(share.ranks()));
  for (const Index e : own.besideThese(own.beside))
  {
    sums[static_cast<std::size_t>(share.rankOf(own.keys[e] >> 3))].push_back({own.keys[e], summer.sumOf(e)});
  }
  for (const std::vector<ElementSum>& some : exchangeLists(share.exchange(), sums))
  {
    for (const ElementSum& one : some)
    {
      if (summer.sumOf(own.find(one.element)) != one.sum)
      {
        throw RanksDisagree("ranks do not have the same elements where their shares meet");
      }
    }
  }
}

} // namespace atria
