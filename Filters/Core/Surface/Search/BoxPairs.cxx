// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/BoxPairs.h"

#include "Surface/Search/BoxTree.h"

namespace atria {

LatticeBox boundsOf(const std::vector<NumberedBox>& boxes)
{
  LatticeBox all = boxes.front();
  std::ranges::for_each(boxes, [&](const LatticeBox& box) { all.extend(box); });
  return all;
}

NumberedBox boxOf(const TriangleSoup& soup, Index triangle, std::int64_t margin)
{
  const LatticeBox box = boundsOf(soup.corner(triangle, 0), soup.corner(triangle, 1), soup.corner(triangle, 2));
  return {grown(box, margin), triangle};
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
