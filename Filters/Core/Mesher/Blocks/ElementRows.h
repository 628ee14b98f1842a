// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the elements in rows around others.
#pragma once

#include "Dual/Mesh/DualMesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace atria {

/// The element across a face, or on the other side of the sheet that it is on; noIndex where there is none.
inline Index beyond(const DualMesh& mesh, std::int32_t code)
{
  return code >= 0                    ? static_cast<Index>(code)
         : DualMesh::isBoundary(code) ? mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                      : noIndex;
}

/// Finds elements about others. A mark for each element is kept, so that this takes no more time than there are
/// elements found. Of a mesh there have to be neighbors and boundary faces.
class ElementRows
{
public:
  explicit ElementRows(const DualMesh& mesh) : mesh_(mesh), marks_(mesh.neighbors.size(), 0) {}

  /// Elements, which are different, and so many rows about them: what shares faces with them, or is on the other side
  /// of a sheet. In order.
  std::vector<Index> grow(std::vector<Index> elements, int rows)
  {
    return grow(std::move(elements), rows, [](Index) { return true; });
  }
  /// The same of those for which `isWithin` says true.
  template <typename IsWithin> std::vector<Index> grow(std::vector<Index> elements, int rows, IsWithin&& isWithin)
  {
    ++last_;
    std::ranges::for_each(elements, [&](Index e) { marks_[e] = last_; });
    std::size_t begin = 0;
    for (int row = 0; row < rows; ++row)
    {
      for (const std::size_t end = elements.size(); begin < end; ++begin)
      {
        for (const std::int32_t code : mesh_.neighbors[elements[begin]])
        {
          const Index other = beyond(mesh_, code);
          if (other != noIndex && marks_[other] != last_ && isWithin(other))
          {
            marks_[other] = last_;
            elements.push_back(other);
          }
        }
      }
    }
    std::ranges::sort(elements);
    return elements;
  }

private:
  const DualMesh& mesh_;
  std::vector<Index> marks_;
  Index last_ = 0;
};

} // namespace atria
