// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the elements in rows around others.
#pragma once

#include "Dual/Mesh/DualMesh.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace atria {

/// Returns the element across a face of this code, or across the sheet that the face is on; noIndex if there is none.
inline Index beyond(const DualMesh& mesh, std::int32_t code)
{
  return code >= 0                    ? static_cast<Index>(code)
         : DualMesh::isBoundary(code) ? mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                      : noIndex;
}

/// Finds elements in rows around others. It keeps a mark for each element, so that a search takes time only for the
/// elements that it finds. The mesh must have neighbors and boundary faces.
class ElementRows
{
public:
  explicit ElementRows(const DualMesh& mesh) : mesh_(mesh), marks_(mesh.neighbors.size(), 0) {}

  /// Returns `elements`, which must be distinct, and `rows` rows around them, in order. A row has the elements across
  /// faces and across sheets.
  std::vector<Index> grow(std::vector<Index> elements, int rows)
  {
    return grow(std::move(elements), rows, [](Index) { return true; });
  }
  /// The same, but adds only elements for which `isWithin` is true.
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
