// SPDX-License-Identifier: GPL-3.0-or-later
/// Builds the arrays of a region from its judged cells.
#pragma once

#include "Optimize/Kernel/Region.h"
#include "Support/Numbering.h"

namespace atria {

/// Builds a region from its judged cells, which are in order. Parts of them are numbered separately, on all threads,
/// and then joined. The result does not depend on the parts.
class Extraction
{
public:
  enum class Order
  {
    any,   ///< points and ghosts are in the order in which one thread meets them
    ofMesh ///< points and ghosts are in the order of their numbers in the mesh
  };

  Extraction(const CellSource& mesh, std::vector<Index> cells, bool withNatives, Order order);

  /// Returns the region, in which no point may move. May be called once. Throws Aborted when asked to.
  Region run(const RunContext& context);

  /// Calls use(cell, corners) for each judged cell, on all threads; run() must have been called. Corners are numbers of
  /// the region's points; one may be listed more than once.
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
    Index first = 0; ///< the first of its cells
    /// Points and ghosts in the order in which they are met: their numbers in the mesh until parts are joined, then
    /// those in the region.
    std::vector<Index> pointIds;
    std::vector<Index> ghosts;
    /// Corners of each cell: places in `pointIds` until parts are joined, then numbers in the region.
    std::vector<Index> cornerOffsets{0};
    std::vector<Index> corners;
    /// One entry per face with a cell across, in order: the number of that cell in the region. Ghosts are numbered
    /// after all judged cells, by their places in `ghosts` until parts are joined.
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
