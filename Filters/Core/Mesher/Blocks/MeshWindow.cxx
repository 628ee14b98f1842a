// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Blocks/MeshWindow.h"

#include "Support/Numbering.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>

namespace atria {

namespace {

class WindowMaker
{
public:
  WindowMaker(const DualMesh& mesh, const std::vector<Vec3>& points, const VertexClassification& of,
              const std::vector<Index>& vertices, const std::vector<Index>& chosen)
      : whole(mesh), places(points), classification(of), vertexOf(vertices), elements(chosen),
        elementNumbers(chosen.size(), mesh.elementCount())
  {
  }

  MeshWindow make(Index cutTag)
  {
    addElements();
    numberPoints();
    addFaces(cutTag);
    addZoneFaces();
    classify();
    out.elementIds = elements;
    return std::move(out);
  }

private:
  /// Adds the elements. Their corners get numbers as they are met.
  void addElements()
  {
    const std::size_t count = elements.size();
    out.mesh.corners.resize(count);
    out.mesh.neighbors.resize(count);
    out.mesh.levels.resize(count);
    out.mesh.zones.resize(count);
    Numbering numbers(count, places.size());
    for (Index i = 0; i < count; ++i)
    {
      const Index e = elements[i];
      elementNumbers.add(e, i);
      std::ranges::transform(whole.corners[e], out.mesh.corners[i].begin(),
                             [&](Index p) { return numbers.findOrAdd(p, met); });
      out.mesh.levels[i] = whole.levels[e];
      out.mesh.zones[i] = whole.zones[e];
    }
  }

  /// Gives points their final numbers: vertices first, then the other points, each in order.
  void numberPoints()
  {
    std::vector<Index> vertices;
    std::vector<Index> others;
    for (const Index p : met)
    {
      vertices.push_back(vertexOf[p]);
      if (vertexOf[p] != p)
      {
        others.push_back(p);
      }
    }
    sortUnique(vertices);
    std::ranges::sort(others);
    vertexCount = static_cast<Index>(vertices.size());
    out.pointIds = std::move(vertices);
    out.pointIds.insert(out.pointIds.end(), others.begin(), others.end());
    std::vector<Index> numbers(met.size());
    std::ranges::transform(met, numbers.begin(), [&](Index p) { return numberOf(p); });
    for (std::array<Index, 8>& corners : out.mesh.corners)
    {
      std::ranges::transform(corners, corners.begin(), [&](Index i) { return numbers[i]; });
    }
    out.mesh.points.resize(out.pointIds.size());
    out.vertexOf.resize(out.pointIds.size());
    for (Index p = 0; p < out.pointIds.size(); ++p)
    {
      out.mesh.points[p] = places[out.pointIds[p]];
      out.vertexOf[p] = p < vertexCount ? p : numberOf(vertexOf[out.pointIds[p]]);
    }
  }

  Index numberOf(Index point) const
  {
    const auto begin = out.pointIds.begin();
    const auto middle = begin + static_cast<std::ptrdiff_t>(vertexCount);
    const auto found = vertexOf[point] == point ? std::lower_bound(begin, middle, point)
                                                : std::lower_bound(middle, out.pointIds.end(), point);
    return static_cast<Index>(found - begin);
  }

  /// Returns the number of an element in the window; noIndex if it is not there.
  Index elementOf(Index element) const { return element == noIndex ? noIndex : elementNumbers.of(element); }

  void addFaces(Index cutTag)
  {
    std::vector<Index>& faces = out.faceIds;
    for (const Index e : elements)
    {
      for (const std::int32_t code : whole.neighbors[e])
      {
        if (DualMesh::isBoundary(code))
        {
          faces.push_back(DualMesh::boundaryFaceOf(code));
        }
      }
    }
    std::ranges::sort(faces);
    for (const Index f : faces)
    {
      BoundaryFace face = whole.boundaryFaces[f];
      face.element = elementOf(face.element);
      face.opposite = elementOf(face.opposite);
      face.tag += face.tag < cutTag ? 0 : 1;
      out.mesh.boundaryFaces.push_back(face);
    }
    for (Index e = 0; e < elements.size(); ++e)
    {
      for (std::uint8_t direction = 0; direction < 6; ++direction)
      {
        out.mesh.neighbors[e][direction] = codeOf(e, direction, cutTag);
      }
    }
    faces.resize(out.mesh.boundaryFaces.size(), noIndex);
  }

  std::int32_t codeOf(Index e, std::uint8_t direction, Index cutTag)
  {
    const std::int32_t code = whole.neighbors[elements[e]][direction];
    if (code == DualMesh::noFace)
    {
      return code;
    }
    if (code < 0)
    {
      const auto found = std::ranges::lower_bound(out.faceIds, DualMesh::boundaryFaceOf(code));
      return ~static_cast<std::int32_t>(found - out.faceIds.begin());
    }
    if (const Index across = elementOf(static_cast<Index>(code)); across != noIndex)
    {
      return static_cast<std::int32_t>(across);
    }
    out.mesh.boundaryFaces.push_back({e, cutTag, noIndex, direction, SheetSide::front, false});
    return ~static_cast<std::int32_t>(out.mesh.boundaryFaces.size() - 1);
  }

  void addZoneFaces()
  {
    for (ZoneFace face : whole.zoneFaces)
    {
      face.element = elementOf(face.element);
      if (face.element != noIndex && out.mesh.neighbors[face.element][face.direction] >= 0)
      {
        out.mesh.zoneFaces.push_back(face);
      }
    }
  }

  void classify()
  {
    VertexClassification& to = out.classification;
    to.offsets = {0};
    for (Index v = 0; v < vertexCount; ++v)
    {
      const Index vertex = out.pointIds[v];
      to.classes.push_back(classification.classes[vertex]);
      to.leaves.push_back(classification.leaves[vertex]);
      const auto pieces = classification.piecesOf(vertex);
      to.pieces.insert(to.pieces.end(), pieces.begin(), pieces.end());
      to.offsets.push_back(static_cast<Index>(to.pieces.size()));
      if (!classification.planes.empty())
      {
        to.planes.push_back(classification.planes[vertex]);
      }
      if (!classification.turnedSides.empty())
      {
        to.turnedSides.push_back(classification.turnedSides[vertex]);
      }
      if (const auto found = classification.displacementLimits.find(vertex);
          found != classification.displacementLimits.end())
      {
        to.displacementLimits.emplace(v, found->second);
      }
    }
  }

  const DualMesh& whole;
  const std::vector<Vec3>& places;
  const VertexClassification& classification;
  const std::vector<Index>& vertexOf;
  const std::vector<Index>& elements;
  Numbering elementNumbers;
  std::vector<Index> met; ///< points, in the order in which elements have them
  Index vertexCount = 0;
  MeshWindow out;
};

} // namespace

LayerOptions optionsOfWindows(LayerOptions options)
{
  const auto cut = static_cast<std::ptrdiff_t>(options.surfaceCount());
  options.ofTag.insert(options.ofTag.begin() + cut, WallLayers{.layers = 0});
  if (!options.supporting.empty())
  {
    options.supporting.insert(options.supporting.begin() + cut, SupportingLayer::none);
  }
  return options;
}

MeshWindow extractWindow(const DualMesh& whole, const std::vector<Vec3>& points,
                         const VertexClassification& classification, const std::vector<Index>& vertexOf,
                         const std::vector<Index>& elements, Index cutTag)
{
  return WindowMaker(whole, points, classification, vertexOf, elements).make(cutTag);
}

/// Marks points of faces with the tag, vertices without elements, and all points at the same vertices.
std::vector<char> pointsAtCut(const MeshWindow& window, Index cutTag)
{
  std::vector<char> vertices(window.vertexCount(), 1);
  for (const auto& corners : window.mesh.corners)
  {
    for (const Index p : corners)
    {
      if (p < vertices.size())
      {
        vertices[p] = 0;
      }
    }
  }
  for (const BoundaryFace& face : window.mesh.boundaryFaces)
  {
    for (int i = 0; i < 4 && face.tag == cutTag; ++i)
    {
      vertices[window.vertexOf[cornerOf(window.mesh, face, i)]] = 1;
    }
  }
  std::vector<char> atCut(window.pointIds.size());
  std::ranges::transform(window.vertexOf, atCut.begin(), [&](Index v) { return vertices[v]; });
  return atCut;
}

} // namespace atria
