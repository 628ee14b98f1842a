// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/BoxPairs.h"

#include "Surface/Search/BoxTree.h"

namespace atria {

NumberedBox boundsOf(const std::vector<NumberedBox>& boxes)
{
  NumberedBox all = boxes.front();
  for (const NumberedBox& box : boxes)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      all.low[axis] = std::min(all.low[axis], box.low[axis]);
      all.high[axis] = std::max(all.high[axis], box.high[axis]);
    }
  }
  return all;
}

NumberedBox boxOf(const TriangleSoup& soup, Index triangle, std::int64_t margin)
{
  NumberedBox box{soup.corner(triangle, 0), soup.corner(triangle, 0), triangle};
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 1; i < 3; ++i)
    {
      box.low[axis] = std::min(box.low[axis], soup.corner(triangle, i)[axis]);
      box.high[axis] = std::max(box.high[axis], soup.corner(triangle, i)[axis]);
    }
    box.low[axis] -= margin;
    box.high[axis] += margin;
  }
  return box;
}

std::vector<NumberedBox> boxesOf(const TriangleSoup& soup, const std::vector<Index>& triangles, std::int64_t margin,
                                 const RunContext& context)
{
  constexpr std::size_t grain = 4096;
  std::vector<NumberedBox> boxes(triangles.size());
  context.executor.forEach(boxes.size(), grain, [&](std::size_t i) { boxes[i] = boxOf(soup, triangles[i], margin); });
  return boxes;
}

void forBoxPairs(const std::vector<NumberedBox>& first, const std::vector<NumberedBox>& second,
                 const RunContext& context, const std::function<void(Index, Index)>& visit)
{
  const BoxTree tree(second, context);
  for (const NumberedBox& box : first)
  {
    tree.eachTouching(box, 0, [&](std::size_t place) {
      if (tree.box(place).id != box.id)
      {
        visit(box.id, tree.box(place).id);
      }
    });
  }
}

} // namespace atria
