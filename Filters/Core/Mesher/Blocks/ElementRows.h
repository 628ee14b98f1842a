// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Mesh/DualMesh.h"

#include <algorithm>

namespace atria {

/// The element across a face, or on the other side of the sheet that it is on; noIndex where there is none.
inline Index beyond(const DualMesh& mesh, std::int32_t code)
{
  return code >= 0                    ? static_cast<Index>(code)
         : DualMesh::isBoundary(code) ? mesh.boundaryFaces[DualMesh::boundaryFaceOf(code)].opposite
                                      : noIndex;
}

/// Finds elements about others. A mark for each element is kept, so that this takes no more time than there are
/// elements found.
class ElementRows
{
public:
  /// Only elements marked in `within` are found; where that is empty, any are.
  explicit ElementRows(const DualMesh& mesh, const std::vector<char>& within = {})
      : mesh_(mesh), within_(within), marks_(mesh.elementCount(), 0)
  {
  }

  /// Elements, which are different, and so many rows about them: what shares faces with them, or is on the other side
  /// of a sheet. In order.
  std::vector<Index> grow(std::vector<Index> elements, int rows)
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
          add(beyond(mesh_, code), elements);
        }
      }
    }
    std::ranges::sort(elements);
    return elements;
  }

private:
  void add(Index element, std::vector<Index>& elements)
  {
    if (element != noIndex && marks_[element] != last_ && (within_.empty() || within_[element]))
    {
      marks_[element] = last_;
      elements.push_back(element);
    }
  }

  const DualMesh& mesh_;
  std::vector<char> within_;
  std::vector<Index> marks_;
  Index last_ = 0;
};

} // namespace atria
