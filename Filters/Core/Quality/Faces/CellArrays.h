// SPDX-License-Identifier: GPL-3.0-or-later
/// Views of cells as VTK lays them out, without VTK's types and without copies.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

namespace atria {

/// Integers of 32 or 64 bits, as VTK stores ids.
class IdView
{
public:
  using Wide = std::span<const std::int64_t>;
  using Narrow = std::span<const std::int32_t>;

  IdView() = default;
  IdView(Wide ids) : wide(ids.data()), count(ids.size()) {}
  IdView(Narrow ids) : narrow(ids.data()), count(ids.size()) {}
  template <std::convertible_to<Wide> Ids> IdView(const Ids& ids) : IdView(Wide(ids)) {}
  template <std::convertible_to<Narrow> Ids> IdView(const Ids& ids) : IdView(Narrow(ids)) {}

  std::size_t size() const { return count; }
  std::int64_t operator[](std::size_t i) const { return wide ? wide[i] : narrow[i]; }
  /// Returns `number` ids from `first` on; they must exist.
  IdView part(std::size_t first, std::size_t number) const
  {
    return wide ? IdView(Wide(wide + first, number)) : IdView(Narrow(narrow + first, number));
  }
  /// True if there are `number` ids from `first` on.
  bool has(std::int64_t first, std::int64_t number) const
  {
    const auto all = static_cast<std::int64_t>(count);
    return first >= 0 && number >= 0 && first <= all && number <= all - first;
  }

private:
  const std::int64_t* wide = nullptr;
  const std::int32_t* narrow = nullptr;
  std::size_t count = 0;
};

/// The faces of polyhedra, in one of the two forms that VTK has had.
class PolyhedronFaces
{
public:
  PolyhedronFaces() = default;

  /// Form up to VTK 9.3. For each polyhedron, the stream has its number of faces, then the number of points and the
  /// points of each face. `locations` has one entry per cell: the place in the stream where this begins.
  static PolyhedronFaces Stream(IdView stream, IdView locations)
  {
    PolyhedronFaces faces;
    faces.points_ = stream;
    faces.starts_ = locations;
    return faces;
  }
  /// Form from VTK 9.4 on. Cell c has the faces cellFaces[cellOffsets[c] .. cellOffsets[c + 1]), and face f the points
  /// facePoints[faceOffsets[f] .. faceOffsets[f + 1]).
  static PolyhedronFaces Lists(IdView cellOffsets, IdView cellFaces, IdView faceOffsets, IdView facePoints)
  {
    PolyhedronFaces faces;
    faces.points_ = facePoints;
    faces.starts_ = cellOffsets;
    faces.faces_ = cellFaces;
    faces.faceOffsets_ = faceOffsets;
    faces.areLists_ = true;
    return faces;
  }

  /// Calls use(points), with an IdView, for each face of a cell. Returns false if the lists of a cell's faces do not
  /// end within the arrays; `use` has then been called for the faces before.
  template <typename F> bool each(std::size_t cell, F&& use) const
  {
    return areLists_ ? eachOfLists(cell, use) : eachOfStream(cell, use);
  }

private:
  template <typename F> bool eachOfStream(std::size_t cell, F&& use) const
  {
    std::int64_t at = cell < starts_.size() ? starts_[cell] : -1;
    if (!points_.has(at, 1))
    {
      return false;
    }
    for (std::int64_t left = points_[static_cast<std::size_t>(at++)]; left > 0; --left)
    {
      if (!points_.has(at, 1) || !points_.has(at + 1, points_[static_cast<std::size_t>(at)]))
      {
        return false;
      }
      const std::int64_t size = points_[static_cast<std::size_t>(at++)];
      use(points_.part(static_cast<std::size_t>(at), static_cast<std::size_t>(size)));
      at += size;
    }
    return true;
  }

  template <typename F> bool eachOfLists(std::size_t cell, F&& use) const
  {
    if (cell + 1 >= starts_.size() || !faces_.has(starts_[cell], starts_[cell + 1] - starts_[cell]))
    {
      return false;
    }
    for (std::int64_t i = starts_[cell]; i < starts_[cell + 1]; ++i)
    {
      const std::int64_t face = faces_[static_cast<std::size_t>(i)];
      if (!faceOffsets_.has(face, 2))
      {
        return false;
      }
      const std::int64_t first = faceOffsets_[static_cast<std::size_t>(face)];
      const std::int64_t size = faceOffsets_[static_cast<std::size_t>(face) + 1] - first;
      if (!points_.has(first, size))
      {
        return false;
      }
      use(points_.part(static_cast<std::size_t>(first), static_cast<std::size_t>(size)));
    }
    return true;
  }

  IdView points_; ///< points of faces, or the stream
  IdView starts_; ///< one entry per cell
  IdView faces_;
  IdView faceOffsets_;
  bool areLists_ = false;
};

/// Appends the faces of a cell to a stream, with the new point numbers newPoint(point). Returns false as each() does.
template <typename NewPoint>
bool appendFaces(const PolyhedronFaces& faces, std::size_t cell, NewPoint&& newPoint, std::vector<std::int64_t>& stream)
{
  const std::size_t begin = stream.size();
  stream.push_back(0);
  return faces.each(cell, [&](const IdView& points) {
    ++stream[begin];
    stream.push_back(static_cast<std::int64_t>(points.size()));
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      stream.push_back(static_cast<std::int64_t>(newPoint(points[i])));
    }
  });
}

/// Cells as in vtkUnstructuredGrid. Cell types are VTK's numbers; known types are tetrahedron 10, voxel 11, hexahedron
/// 12, wedge 13, pyramid 14, polyhedron 42.
struct CellArrays
{
  std::span<const unsigned char> types;
  IdView offsets; ///< types.size() + 1
  IdView connectivity;
  PolyhedronFaces faces;
};

} // namespace atria
