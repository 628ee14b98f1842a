// SPDX-License-Identifier: GPL-3.0-or-later
/// Dual meshes of cubes in a block, with sheets between some of them.
#pragma once

#include "Dual/Mesh/DualMesh.h"

#include <array>
#include <functional>

namespace atria::testing {

/// Names a face of the block's outside, or an inner face: the element below it and an upper direction.
using IsSheet = std::function<bool(Index element, int direction)>;

/// Tags of faces: of sheets, and of the block's outside from xMin on.
struct BlockTags
{
  Index sheet = 6;
  Index firstSide = 0;
};

/// Cubes of 1 m in rows along x. Inner faces that are sheets have boundary faces on both sides.
class Block
{
public:
  Block(std::array<Index, 3> count, const IsSheet& isSheet, const BlockTags& tags = {}) : size(count)
  {
    for (Index i = 0; i < (size[0] + 1) * (size[1] + 1) * (size[2] + 1); ++i)
    {
      mesh.points.emplace_back(i % (size[0] + 1), i / (size[0] + 1) % (size[1] + 1),
                               i / ((size[0] + 1) * (size[1] + 1)));
    }
    for (Index e = 0; e < size[0] * size[1] * size[2]; ++e)
    {
      mesh.corners.push_back(cornersOf(e));
      mesh.neighbors.push_back({});
      mesh.levels.push_back(std::uint8_t{0});
      mesh.zones.push_back(std::int32_t{0});
    }
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        link(e, direction, isSheet, tags);
      }
    }
  }

  Index pointAt(Index i, Index j, Index k) const { return i + (size[0] + 1) * (j + (size[1] + 1) * k); }

  DualMesh mesh;

private:
  std::array<Index, 3> cellOf(Index e) const { return {e % size[0], e / size[0] % size[1], e / (size[0] * size[1])}; }

  std::array<Index, 8> cornersOf(Index e) const
  {
    const auto [i, j, k] = cellOf(e);
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const Index bits = hexahedronCorner.at(c);
      corners.at(c) = pointAt(i + (bits & 1), j + (bits >> 1 & 1), k + (bits >> 2));
    }
    return corners;
  }

  void link(Index e, int direction, const IsSheet& isSheet, const BlockTags& tags)
  {
    const auto axis = static_cast<std::size_t>(axisOf(direction));
    const std::array<Index, 3> steps{1, size[0], size[0] * size[1]};
    const Index place = cellOf(e).at(axis);
    const bool isOutside = isUpper(direction) ? place + 1 == size.at(axis) : place == 0;
    const Index next = isUpper(direction) ? e + steps.at(axis) : e - steps.at(axis);
    const Index below = isUpper(direction) ? e : next;
    std::int32_t& code = mesh.neighbors[e].at(static_cast<std::size_t>(direction));
    if (!isOutside && !isSheet(below, direction | 1))
    {
      code = static_cast<std::int32_t>(next);
      return;
    }
    code = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
    const auto side = isUpper(direction) && !isOutside ? SheetSide::back : SheetSide::front;
    const Index tag = isOutside ? tags.firstSide + static_cast<Index>(direction) : tags.sheet;
    mesh.boundaryFaces.push_back(
        {e, tag, isOutside ? noIndex : next, static_cast<std::uint8_t>(direction), side, isOutside, noIndex});
  }

  std::array<Index, 3> size;
};

inline bool noSheet(Index /*element*/, int /*direction*/) { return false; }

} // namespace atria::testing
