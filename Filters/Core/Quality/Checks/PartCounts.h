// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts cells, faces and points of a part of a mesh once over all ranks.
#pragma once

#include "Quality/Checks/MeshChecks.h"

#include <span>
#include <vector>

namespace atria {

/// Summary of values of which the greatest or the least is the worst.
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

/// Returns one entry per point: 1 if the lowest-numbered cell that has it is an own one.
std::vector<char> pointsOfOwn(const FaceMesh& mesh, std::span<const char> isOwn);

/// Without a part everything counts, and there are no other ranks. Faces count where their owner does, points where the
/// lowest-numbered cell that has them does: once over all ranks. All ranks must call these functions at the same time,
/// except operator().
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
  /// Returns the position of the first part in the order of the whole mesh. `own` is the first one of this rank, or
  /// noIndex.
  Vec3 first(MeshPart kind, std::size_t own, const Vec3& place) const;
  void addOthers(Vec3& sum, double& size) const;
  void addOthers(Box3& box) const;
  /// Returns the number of points that count, over all ranks.
  std::size_t countPoints(const std::vector<Index>& points) const;
  /// Returns boundary points of other ranks that this rank does not have and that may be nearer than `distance` to its
  /// own, such as those on the other side of a sheet.
  std::vector<Vec3> pointsOfOthers(double distance) const;

private:
  std::vector<Index> boundaryPoints() const;

  const FaceMesh& mesh_;
  const CheckedPart* part_;
  std::vector<char> countsPoint_;
};

} // namespace atria
