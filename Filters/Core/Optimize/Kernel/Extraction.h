// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Optimize/Kernel/Region.h"
#include "Support/Numbering.h"

namespace atria {

/// Builds the arrays of a region from its judged cells, which are in order. Parts of them are numbered each by itself,
/// on all threads, and then put together: the result does not depend on the parts but for the order of points and of
/// cells beside, where that may be any.
class Extraction
{
public:
  enum class Order
  {
    any,   ///< of points and of cells beside; these are numbered by one thread
    ofMesh ///< both have the order of their numbers in the mesh
  };

  Extraction(const CellSource& mesh, std::vector<Index> cells, bool withNatives, Order order);

  /// Once. No point may move.
  Region run(const RunContext& context);

  /// After that: calls use(cell, corners) for each judged cell, on all threads; its corners are called as in the
  /// region, and some may be there more than once.
  template <typename Use> void forCells(const RunContext& context, Use&& use) const
  {
    context.executor.forEach(parts.size(), 1, [&](std::size_t i) {
      const Part& part = parts[i];
      for (Index c = 0; c < part.size(); ++c)
      {
        use(part.first + c, part.cornersOf(c));
      }
    });
  }

private:
  struct Part
  {
    Index first = 0; ///< of its cells
    /// Of the mesh as they are met; then their numbers in the region.
    std::vector<Index> pointIds;
    std::vector<Index> ghosts;
    /// Of each cell, by `pointIds` until all are put together.
    std::vector<Index> cornerOffsets{0};
    std::vector<Index> corners;
    /// For each face that has a cell across, in their order, that cell's number in the region; those beside come behind
    /// all judged ones, by `ghosts` until all are put together.
    std::vector<Index> across;
    RegionCells made;

    Index size() const { return static_cast<Index>(cornerOffsets.size()) - 1; }
    std::span<const Index> cornersOf(Index cell) const
    {
      return {corners.data() + cornerOffsets[cell], corners.data() + cornerOffsets[cell + 1]};
    }
  };

  void number(Part& part, std::size_t begin, std::size_t end) const;
  void join(const RunContext& context);
  void joinNumbers(const RunContext& context);
  void makeFaces(Part& part) const;
  void joinFaces(const RunContext& context);
  void addCellFaces(const RunContext& context);
  void measureGhosts(const RunContext& context);

  const CellSource& source;
  bool natives;
  Order order;
  Region region;
  std::vector<Index> ghosts;
  Numbering judged;
  std::vector<Part> parts;
};

} // namespace atria
