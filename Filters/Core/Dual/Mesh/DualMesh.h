// SPDX-License-Identifier: GPL-3.0-or-later
/// The one mesh structure: hexahedra some of whose corners coincide.
#pragma once

#include "Support/Buffer.h"
#include "Support/Executor.h"
#include "Support/Types.h"

#include <atomic>
#include <span>
#include <string>
#include <vector>

namespace atria {

/// Corners of an element in VTK's order of a hexahedron, as bits x 1, y 2, z 4 of the direction from the grid point.
inline constexpr std::array<std::uint8_t, 8> hexahedronCorner{0, 1, 3, 2, 4, 5, 7, 6};

/// The four corners of an element's face in each Direction, in VTK's order, normal outwards.
inline constexpr std::array<std::array<std::uint8_t, 4>, 6> hexahedronFace{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

/// The side of a sheet that an element lies on. Seen from the front, the triangle's points run counterclockwise.
enum class SheetSide : std::uint8_t
{
  front,
  back
};

/// A face on which the mesh ends: on a surface, or on a side of the domain.
struct BoundaryFace
{
  Index element;
  /// Surface id; or the number of surfaces plus the number of a bare domain side (Grid/Prism.h).
  Index tag;
  /// The element on the other side of the sheet, if that is in the mesh; else noIndex.
  Index opposite;
  std::uint8_t direction;
  SheetSide side;
  /// True if the face is on a side of the domain, bare or named by a surface that lies on it.
  bool onDomainSide;
  /// The smooth piece of the surface; noIndex on a domain side.
  Index chart = noIndex;
};

/// A face within the mesh that lies on a permeable surface.
struct ZoneFace
{
  Index element;
  /// The surface's id.
  Index tag;
  std::uint8_t direction;
  /// The side of the surface on which the element lies; the neighbor lies on the other.
  SheetSide side;
};

/// An element is the dual of a grid point. Its corners are the vertices of the octants in the eight directions from the
/// point, its faces the duals of the octree's edges in the six axis directions. A face has its four corners without
/// those that coincide; with fewer than three left it is none. Layer elements have the same form. Takes 61 bytes an
/// element: 56 for corners and neighbors, 5 for level and zone.
struct DualMesh
{
  /// Neighbor code of a face that has shrunk to an edge or a point.
  static constexpr std::int32_t noFace = std::numeric_limits<std::int32_t>::min();
  static constexpr bool isBoundary(std::int32_t neighbor) { return neighbor < 0 && neighbor != noFace; }
  static constexpr Index boundaryFaceOf(std::int32_t neighbor) { return static_cast<Index>(~neighbor); }

  std::vector<Vec3> points;
  /// One entry per element: eight points in VTK's order of a hexahedron.
  Buffer<std::array<Index, 8>> corners;
  /// One entry per element and Direction: the element across, or ~i for boundary face i, or noFace.
  Buffer<std::array<std::int32_t, 6>> neighbors;
  std::vector<BoundaryFace> boundaryFaces;
  /// Lists each face once.
  std::vector<ZoneFace> zoneFaces;
  /// One entry per element: the level of the finest octant around it, and its zone.
  Buffer<std::uint8_t> levels;
  Buffer<std::int32_t> zones;
  /// One entry per element: its room, and the surface that encloses it as a cell zone; -1 for none. Empty if unused.
  Buffer<std::int32_t> rooms;
  Buffer<std::int32_t> cellZones;

  std::size_t elementCount() const { return corners.size(); }
};

/// Appends the labels of an element: those of element `like` of a mesh, which may be the same mesh.
inline void appendLabels(DualMesh& to, const DualMesh& from, Index like)
{
  to.levels.push_back(std::uint8_t(from.levels[like]));
  to.zones.push_back(std::int32_t(from.zones[like]));
  if (!from.rooms.empty())
  {
    to.rooms.push_back(std::int32_t(from.rooms[like]));
  }
  if (!from.cellZones.empty())
  {
    to.cellZones.push_back(std::int32_t(from.cellZones[like]));
  }
}

/// Appends an element with the labels of element `like`.
inline void appendElement(DualMesh& to, const std::array<Index, 8>& corners,
                          const std::array<std::int32_t, 6>& neighbors, const DualMesh& from, Index like)
{
  to.corners.push_back(corners);
  to.neighbors.push_back(neighbors);
  appendLabels(to, from, like);
}

/// A face without coinciding corners. `count` is below 3 if there is no face.
struct ReducedFace
{
  std::array<Index, 4> points;
  int count = 0;

  std::span<const Index> loop() const& { return {points.data(), static_cast<std::size_t>(count)}; }
  std::span<const Index> loop() && = delete; // the face would be gone
};

inline ReducedFace faceOf(const std::array<Index, 8>& corners, int direction)
{
  ReducedFace face;
  for (const std::uint8_t c : hexahedronFace[direction])
  {
    const Index p = corners[c];
    if (face.count == 0 || (face.points[face.count - 1] != p && (face.count < 3 || face.points[0] != p)))
    {
      face.points[face.count++] = p;
    }
  }
  while (face.count > 1 && face.points[face.count - 1] == face.points[0])
  {
    --face.count;
  }
  return face;
}

/// True if no two corners of an element coincide.
inline bool hasAllCorners(const std::array<Index, 8>& corners)
{
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (corners[i] == corners[j])
      {
        return false;
      }
    }
  }
  return true;
}

/// True if one of an element's corners is marked. Does not branch for each corner, as most are not.
inline bool hasMarked(const std::array<Index, 8>& corners, const std::vector<char>& marked)
{
  int any = 0;
  for (const Index p : corners)
  {
    any |= marked[p];
  }
  return any != 0;
}

/// Marks the points of faces of zones.
inline void markZonePoints(const DualMesh& mesh, std::vector<char>& marked)
{
  for (const ZoneFace& face : mesh.zoneFaces)
  {
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      marked[mesh.corners[face.element][c]] = 1;
    }
  }
}

/// Marks the points of boundary faces.
inline std::vector<char> boundaryPoints(const DualMesh& mesh, const Executor& executor)
{
  std::vector<char> marked(mesh.points.size(), 0);
  executor.forEach(mesh.boundaryFaces.size(), 4096, [&](std::size_t f) {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      std::atomic_ref(marked[mesh.corners[face.element][c]]).store(1, std::memory_order_relaxed);
    }
  });
  return marked;
}

} // namespace atria
