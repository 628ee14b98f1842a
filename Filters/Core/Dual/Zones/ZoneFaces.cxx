// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ZoneFaces.h"

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

/// Returns the same face, but of the element at the back.
ZoneFace atBack(ZoneFace face, const DualMesh& mesh)
{
  if (face.side == SheetSide::back)
  {
    return face;
  }
  const auto other = static_cast<Index>(mesh.neighbors[face.element][face.direction]);
  const auto code = static_cast<std::int32_t>(face.element);
  const ReducedFace wanted = faceOf(mesh.corners[face.element], face.direction);
  for (std::uint8_t direction = 0; direction < 6; ++direction)
  {
    // Points are compared, as two elements may share two faces.
    const ReducedFace candidate = faceOf(mesh.corners[other], direction);
    if (mesh.neighbors[other][direction] == code &&
        std::is_permutation(wanted.points.begin(), wanted.points.begin() + wanted.count, candidate.points.begin(),
                            candidate.points.begin() + candidate.count))
    {
      face.direction = direction;
    }
  }
  face.element = other;
  face.side = SheetSide::back;
  return face;
}

} // namespace

int senseOf(std::span<const SurfaceCrossing> cuts, Index surface, const SurfaceModel& model)
{
  int sum = 0;
  for (const SurfaceCrossing& cut : cuts)
  {
    sum += model.surfaceIds[cut.triangle] == surface ? cut.orientation : 0;
  }
  return sum;
}

void orderZoneFaces(DualMesh& mesh)
{
  for (ZoneFace& face : mesh.zoneFaces)
  {
    face = atBack(face, mesh);
  }
  std::ranges::sort(mesh.zoneFaces, [](const ZoneFace& l, const ZoneFace& r) {
    return std::tuple(l.element, l.direction, l.tag) < std::tuple(r.element, r.direction, r.tag);
  });
}

std::vector<ZoneFace> findZoneFaces(const Crossings& crossings, const SurfaceModel& model)
{
  std::vector<ZoneFace> faces;
  if (model.kinds.empty())
  {
    return faces;
  }
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    if (edge.other == noIndex || crossings.neighbors[edge.point][edge.direction] < 0)
    {
      continue;
    }
    const auto cuts = crossings.of(edge);
    const auto passes = [&](const SurfaceCrossing& cut) {
      return senseOf(cuts, model.surfaceIds[cut.triangle], model) != 0;
    };
    if (const auto first = std::ranges::find_if(cuts, passes); first != cuts.end())
    {
      const Index surface = model.surfaceIds[first->triangle];
      const bool isAlong = senseOf(cuts, surface, model) > 0;
      faces.push_back({edge.point, surface, edge.direction, isAlong ? SheetSide::back : SheetSide::front});
    }
  }
  return faces;
}

} // namespace atria
