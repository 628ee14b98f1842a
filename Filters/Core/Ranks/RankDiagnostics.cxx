// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/RankDiagnostics.h"

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

/// A diagnostic as it is sent; `between` is the number of points of its line.
struct Entry
{
  Diagnostic::Kind kind;
  Vec3 begin;
  Vec3 end;
  Index element;
  double width;
  std::uint64_t order;
  std::size_t between;
};

/// Returns the stage that finds a kind, by its place among the stages.
int stageOf(Diagnostic::Kind kind)
{
  switch (kind)
  {
    case Diagnostic::leakPath:
      return 0;
    case Diagnostic::closedCrack:
    case Diagnostic::openCrack:
      return 1;
    case Diagnostic::mergedSheets:
      return 2;
    case Diagnostic::unresolvedFeature:
    case Diagnostic::cluster:
      return 3;
    case Diagnostic::leftOutElement:
      return 4;
    default:
      return 5;
  }
}

/// Gathers the lists of all ranks on the first one; returns nothing on others.
template <typename T> std::vector<T> joinOnFirst(RankExchange& exchange, const std::vector<T>& own)
{
  std::vector<std::vector<T>> toRanks(static_cast<std::size_t>(exchange.ranks()));
  toRanks[0] = own;
  std::vector<T> all;
  for (const std::vector<T>& some : exchangeLists(exchange, toRanks))
  {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

Index elementOf(std::uint64_t number) { return number < noIndex ? static_cast<Index>(number) : noIndex; }

/// Returns, for each point, the element of the piece that has it and the lowest number in the mesh of all ranks. If
/// this is an own element, it is the first of all ranks: the piece has all elements at points of own ones.
std::vector<Index> firstElementsOf(const DualMesh& mesh, const std::vector<std::uint64_t>& numbers)
{
  std::vector<Index> first(mesh.points.size(), noIndex);
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    for (const Index p : mesh.corners[e])
    {
      const bool isFirst = first[p] == noIndex || numbers[e] < numbers[first[p]];
      first[p] = isFirst ? e : first[p];
    }
  }
  return first;
}

} // namespace

RankDiagnostics::RankDiagnostics(const std::vector<Diagnostic>& found, const SharedPiece& piece, const LayerMesh& layer)
    : own_(found)
{
  auto number = piece.askedNumbers.begin();
  for (Diagnostic& diagnostic : own_)
  {
    diagnostic.element = diagnostic.element == noIndex ? noIndex : elementOf(*number++);
    if (diagnostic.kind == Diagnostic::leftOutElement)
    {
      diagnostic.order = diagnostic.order < layer.plainElements ? 0 : 1; // elements of layers have the last numbers
    }
  }
}

void RankDiagnostics::addDetached(const std::vector<DetachedVertex>& detached, const SharedPiece& piece, int rank)
{
  const std::vector<Index> firstElements = firstElementsOf(piece.mesh, piece.elementNumbers);
  for (const DetachedVertex& vertex : detached)
  {
    const auto at = std::ranges::lower_bound(piece.pointsBefore, vertex.point);
    if (at == piece.pointsBefore.end() || *at != vertex.point)
    {
      continue;
    }
    const auto p = static_cast<std::size_t>(at - piece.pointsBefore.begin());
    const Index e = firstElements[p];
    // The owner of the first element reports the point, as the point's owner may own none of its elements.
    if (piece.elementRanks[e] == rank)
    {
      own_.push_back({Diagnostic::detachedVertex,
                      piece.mesh.points[p],
                      vertex.wanted,
                      elementOf(piece.elementNumbers[e]),
                      0.0,
                      {},
                      piece.pointNumbers[p]});
    }
  }
}

std::vector<Diagnostic> RankDiagnostics::gather(RankExchange& exchange) const
{
  std::vector<Entry> entries;
  std::vector<Vec3> lines;
  for (const Diagnostic& own : own_)
  {
    entries.push_back({own.kind, own.begin, own.end, own.element, own.width, own.order, own.between.size()});
    lines.insert(lines.end(), own.between.begin(), own.between.end());
  }
  lines = joinOnFirst(exchange, lines);
  std::vector<Diagnostic> all;
  auto line = lines.begin();
  for (const Entry& entry : joinOnFirst(exchange, entries))
  {
    const auto end = line + static_cast<std::ptrdiff_t>(entry.between);
    all.push_back({entry.kind, entry.begin, entry.end, entry.element, entry.width, {line, end}, entry.order});
    line = end;
  }
  std::ranges::stable_sort(all, [](const Diagnostic& l, const Diagnostic& r) {
    return std::tuple(stageOf(l.kind), l.order) < std::tuple(stageOf(r.kind), r.order);
  });
  return all;
}

} // namespace atria
