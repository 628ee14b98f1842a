// SPDX-License-Identifier: GPL-3.0-or-later
/// What counts of a part of a mesh where it is judged together with the parts of other ranks.
#pragma once

#include "Quality/Checks/MeshChecks.h"

#include <span>
#include <vector>

namespace atria {

/// Values of some things, of which the greatest or the least is the worst.
struct CountedValues
{
  void add(double value, bool fails) { add({isGreatest, value, value, 1, fails ? std::size_t{1} : 0}); }
  void add(const CountedValues& more)
  {
    const bool isWorse = isGreatest ? worst < more.worst : more.worst < worst;
    worst = more.count > 0 && (count == 0 || isWorse) ? more.worst : worst;
    sum += more.sum;
    count += more.count;
    failing += more.failing;
  }

  bool isGreatest = false;
  double worst = 0.0; ///< if there are any
  double sum = 0.0;
  std::size_t count = 0;
  std::size_t failing = 0;
};

/// By point, whether the cell of the lowest number that has it is one of these.
std::vector<char> pointsOfOwn(const FaceMesh& mesh, std::span<const char> isOwn);

/// Without a part all counts, and there are no others. Faces count where their owner does, points where the cell of the
/// lowest number that has them does: once over all ranks. Of all ranks are those functions that say "others".
class PartCounts
{
public:
  /// Both must outlive this.
  PartCounts(const FaceMesh& mesh, const CheckedPart* part);

  bool operator()(MeshPart kind, std::size_t number) const
  {
    return !part_ || kind == MeshPart::Mesh || part_->isOwn[kind == MeshPart::Cells ? number : mesh_.owner[number]];
  }

  void addOthers(CountedValues& values) const;
  /// The place of the first thing in the order of the whole, where this one gives the first of its own, or noIndex.
  Vec3 first(MeshPart kind, std::size_t own, const Vec3& place) const;
  void addOthers(Vec3& sum, double& size) const;
  void addOthers(Box3& box) const;
  /// How many of these count, those of others included.
  std::size_t countPoints(const std::vector<Index>& points) const;
  /// Points on the boundary that others have and this one has not, as far as they may be nearer than that to its own:
  /// those on the other side of a sheet.
  std::vector<Vec3> pointsOfOthers(double distance) const;

private:
  std::vector<Index> boundaryPoints() const;

  const FaceMesh& mesh_;
  const CheckedPart* part_;
  std::vector<char> countsPoint_;
};

} // namespace atria
