// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/SharedLayers.h"

#include "Mesher/Blocks/ElementRows.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

/// Rows around own elements in which elements to leave out are considered.
constexpr int leaveOutRows = 6;

} // namespace

SharedLayers::SharedLayers(const SharedWindow& window, const DualMesh& plain, const LayerMesh& layer)
    : window_(window), plain_(plain), layer_(layer)
{
}

Index SharedLayers::plainElementOf(Index element) const
{
  return element < layer_.plainElements
             ? element
             : plain_.boundaryFaces[layer_.wallFaces[element - layer_.plainElements]].element;
}

SharedElement SharedLayers::elementOf(Index element) const
{
  const PointKey point = window_.elementKeys[plainElementOf(element)];
  if (element < layer_.plainElements)
  {
    return {point, noIndex, 0};
  }
  const Index prism = element - layer_.plainElements;
  return {point, layer_.heights[prism], plain_.boundaryFaces[layer_.wallFaces[prism]].direction};
}

Index SharedLayers::find(const SharedElement& element) const
{
  const auto found = std::ranges::lower_bound(window_.elementKeys, element.point);
  if (found == window_.elementKeys.end() || *found != element.point)
  {
    return noIndex;
  }
  const auto plain = static_cast<Index>(found - window_.elementKeys.begin());
  if (element.isPlain())
  {
    return plain;
  }
  const std::int32_t code = plain_.neighbors[plain][element.direction];
  return DualMesh::isBoundary(code) ? layer_.prismOn(DualMesh::boundaryFaceOf(code), element.height) : noIndex;
}

SharedLeaveOut::SharedLeaveOut(const DualMesh& mesh, const SharedLayers& layers, Index cutTag, RankExchange& exchange)
    : layers_(layers), exchange_(exchange), seen_(mesh.elementCount(), 0)
{
  std::vector<Index> own;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    if (layers_.isOwn(e))
    {
      own.push_back(e);
    }
  }
  std::ranges::for_each(ElementRows(mesh).grow(std::move(own), leaveOutRows), [&](Index e) { seen_[e] = 1; });
  // Elements where the window ends would be judged without their neighbors.
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    seen_[face.element] = face.tag == cutTag ? 0 : seen_[face.element];
  }
}

std::vector<Index> SharedLeaveOut::all(const std::vector<Index>& own)
{
  std::vector<SharedElement> shared;
  std::ranges::transform(own, std::back_inserter(shared), [&](Index e) { return layers_.elementOf(e); });
  std::vector<Index> out;
  for (const std::vector<SharedElement>& some : gatherAll(exchange_, shared))
  {
    for (const SharedElement& element : some)
    {
      if (const Index e = layers_.find(element); e != noIndex)
      {
        out.push_back(e);
      }
    }
  }
  std::ranges::sort(out);
  return out;
}

} // namespace atria
