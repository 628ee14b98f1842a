// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Shares/SharedElements.h"

#include "Support/IndexTable.h"

#include <algorithm>

namespace atria {

namespace {

struct ElementSum
{
  PointKey element;
  std::uint64_t sum;
};

/// Sums up what an element is, without numbers that only this rank has.
class ElementSummer
{
public:
  ElementSummer(const SharedWindow& window, Index cutTag) : window_(window), cutTag_(cutTag) {}

  std::uint64_t sumOf(Index element)
  {
    const DualMesh& mesh = window_.mesh.mesh;
    sum_ = 0;
    add(static_cast<std::uint64_t>(mesh.levels[element]));
    add(static_cast<std::uint64_t>(mesh.zones[element]));
    add(mesh.rooms.empty() ? 0 : static_cast<std::uint64_t>(mesh.rooms[element]));
    add(mesh.cellZones.empty() ? 0 : static_cast<std::uint64_t>(mesh.cellZones[element]));
    std::ranges::for_each(mesh.corners[element], [this](Index point) { addPoint(point); });
    std::ranges::for_each(mesh.neighbors[element], [this](std::int32_t code) { addFace(code); });
    return sum_;
  }

private:
  void add(std::uint64_t value) { sum_ = mixed(sum_ + value); }

  void addPoint(Index point)
  {
    const VertexClassification& classification = window_.mesh.classification;
    const Index vertex = window_.mesh.vertexOf[point];
    add(window_.points[point].leaf);
    add(window_.points[point].copy);
    add(static_cast<std::uint64_t>(classification.classes[vertex]));
    std::ranges::for_each(classification.piecesOf(vertex), [this](Index piece) { add(piece); });
  }

  /// Beyond a face where the window is cut is an element.
  void addFace(std::int32_t code)
  {
    const DualMesh& mesh = window_.mesh.mesh;
    if (!DualMesh::isBoundary(code))
    {
      add(code == DualMesh::noFace ? 0 : 1);
      return;
    }
    const BoundaryFace& face = mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    if (face.tag == cutTag_)
    {
      add(1);
      return;
    }
    add(2);
    add(face.tag);
    add(static_cast<std::uint64_t>(face.side));
    add(face.chart);
  }

  const SharedWindow& window_;
  Index cutTag_;
  std::uint64_t sum_ = 0;
};

} // namespace

void expectSameElements(const SharedWindow& window, Index cutTag, const RankShare& share)
{
  ElementSummer summer(window, cutTag);
  std::vector<std::vector<ElementSum>> sums(static_cast<std::size_t>(share.ranks()));
  for (Index e = 0; e < window.elementKeys.size(); ++e)
  {
    if (!window.isOwn(e))
    {
      const PointKey key = window.elementKeys[e];
      sums[static_cast<std::size_t>(share.rankOf(key >> 3))].push_back({key, summer.sumOf(e)});
    }
  }
  const auto begin = window.elementKeys.begin() + window.firstOwn;
  const auto end = window.elementKeys.begin() + window.endOwn;
  for (const std::vector<ElementSum>& some : exchangeLists(share.exchange(), sums))
  {
    for (const ElementSum& one : some)
    {
      const auto found = std::lower_bound(begin, end, one.element);
      if (found == end || *found != one.element ||
          summer.sumOf(static_cast<Index>(found - window.elementKeys.begin())) != one.sum)
      {
        throw RanksDisagree("ranks do not have the same elements where their shares meet");
      }
    }
  }
}

} // namespace atria
