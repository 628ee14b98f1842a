// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Checks/PartCounts.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

namespace atria {

namespace {

struct NumberedPoint
{
  std::int64_t id;
  Vec3 place;
};

/// Key of a cell or face in the order of the whole mesh; after all others if there is none.
struct First
{
  int isBoundary = 2;
  std::int64_t owner = 0;
  std::int64_t neighbor = 0;
  Vec3 place = Vec3::Zero();

  auto key() const { return std::tuple(isBoundary, owner, neighbor); }
};

} // namespace

std::vector<char> pointsOfOwn(const FaceMesh& mesh, std::span<const char> isOwn)
{
  std::vector<Index> lowest(mesh.points.size(), noIndex);
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    for (const Index point : mesh.face(f))
    {
      lowest[point] = std::min(lowest[point], mesh.owner[f]); // the owner is never higher than the neighbor
    }
  }
  std::vector<char> counted(lowest.size());
  std::ranges::transform(lowest, counted.begin(), [&](Index cell) { return cell != noIndex ? isOwn[cell] : char{0}; });
  return counted;
}

PartCounts::PartCounts(const FaceMesh& mesh, const CheckedPart* part) : mesh_(mesh), part_(part)
{
  if (part_)
  {
    countsPoint_ = pointsOfOwn(mesh_, part_->isOwn);
  }
}

void PartCounts::addOthers(CountedValues& values) const
{
  if (!part_)
  {
    return;
  }
  CountedValues all{values.isGreatest};
  for (const CountedValues& some : gatherAll(part_->exchange, values))
  {
    all.add(some);
  }
  values = all;
}

Vec3 PartCounts::first(MeshPart kind, std::size_t own, const Vec3& place) const
{
  if (!part_)
  {
    return place;
  }
  First least;
  if (own != noIndex)
  {
    const bool isFace = kind == MeshPart::Faces;
    const bool isInternal = isFace && own < mesh_.internalFaceCount();
    const auto idOf = [&](std::size_t cell) { return kind == MeshPart::Mesh ? 0 : part_->cellIds[cell]; };
    least = {isFace && !isInternal ? 1 : 0, idOf(isFace ? mesh_.owner[own] : own),
             isInternal ? idOf(mesh_.neighbor[own]) : 0, place};
  }
  for (const First& other : gatherAll(part_->exchange, least))
  {
    least = other.key() < least.key() ? other : least;
  }
  return least.place;
}

void PartCounts::addOthers(Vec3& sum, double& size) const
{
  if (!part_)
  {
    return;
  }
  const std::vector<std::pair<Vec3, double>> all = gatherAll(part_->exchange, std::pair(sum, size));
  sum = Vec3::Zero();
  size = 0.0;
  for (const auto& [itsSum, itsSize] : all)
  {
    sum += itsSum;
    size += itsSize;
  }
}

void PartCounts::addOthers(Box3& box) const
{
  if (!part_)
  {
    return;
  }
  for (const Box3& other : gatherAll(part_->exchange, box))
  {
    box.min = box.min.cwiseMin(other.min);
    box.max = box.max.cwiseMax(other.max);
  }
}

std::size_t PartCounts::countPoints(const std::vector<Index>& points) const
{
  if (!part_)
  {
    return points.size();
  }
  const auto own =
      static_cast<std::size_t>(std::ranges::count_if(points, [&](Index point) { return countsPoint_[point] != 0; }));
  return sumAll(part_->exchange, std::array{own})[0];
}

std::vector<Index> PartCounts::boundaryPoints() const
{
  std::vector<Index> points;
  for (std::size_t f = mesh_.internalFaceCount(); f < mesh_.faceCount(); ++f)
  {
    if (part_->isOwn[mesh_.owner[f]])
    {
      points.insert(points.end(), mesh_.face(f).begin(), mesh_.face(f).end());
    }
  }
  sortUnique(points);
  return points;
}

std::vector<Vec3> PartCounts::pointsOfOthers(double distance) const
{
  std::vector<Vec3> out;
  if (!part_)
  {
    return out;
  }
  const std::vector<Index> points = boundaryPoints();
  Box3 box;
  std::ranges::for_each(points, [&](Index point) { box.extend(mesh_.points[point]); });
  const std::vector<Box3> boxes = gatherAll(part_->exchange, box);
  std::vector<std::vector<NumberedPoint>> toRanks(boxes.size());
  for (std::size_t rank = 0; rank < boxes.size(); ++rank)
  {
    for (const Index point : points)
    {
      if (static_cast<int>(rank) != part_->exchange.rank() &&
          boxes[rank].squaredDistance(mesh_.points[point]) <= distance * distance)
      {
        toRanks[rank].push_back({part_->pointIds[point], mesh_.points[point]});
      }
    }
  }
  std::map<std::int64_t, Vec3> guests;
  for (const std::vector<NumberedPoint>& some : exchangeLists(part_->exchange, toRanks))
  {
    for (const NumberedPoint& point : some)
    {
      if (!std::ranges::binary_search(part_->pointIds, point.id))
      {
        guests.emplace(point.id, point.place);
      }
    }
  }
  std::ranges::transform(guests, std::back_inserter(out), [](const auto& guest) { return guest.second; });
  return out;
}

} // namespace atria
