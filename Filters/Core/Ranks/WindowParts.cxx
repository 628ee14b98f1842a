// SPDX-License-Identifier: GPL-3.0-or-later
#include "Ranks/WindowParts.h"

#include "Mesher/Blocks/MeshWindow.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace atria {

namespace {

template <typename To, typename List> To chosenOf(const List& list, const std::vector<Index>& chosen)
{
  To out(chosen.size());
  std::ranges::transform(chosen, out.begin(), [&](Index i) { return list[i]; });
  return out;
}

/// Returns the faces of zones at these elements, also where the neighbor is not among them.
std::vector<ZoneFace> zoneFacesOf(const DualMesh& mesh, const std::vector<Index>& elements)
{
  std::vector<ZoneFace> faces;
  for (ZoneFace face : mesh.zoneFaces)
  {
    const auto found = std::ranges::lower_bound(elements, face.element);
    if (found != elements.end() && *found == face.element)
    {
      face.element = static_cast<Index>(found - elements.begin());
      faces.push_back(face);
    }
  }
  return faces;
}

using LimitOf = std::pair<Index, DisplacementLimit>;

/// Calls an archive with all of a part except its displacement limits.
template <typename Archive, typename Part> void visit(Archive& archive, Part& part)
{
  auto& mesh = part.plain.mesh;
  archive(mesh.points);
  archive(mesh.corners);
  archive(mesh.neighbors);
  archive(mesh.boundaryFaces);
  archive(mesh.zoneFaces);
  archive(mesh.levels);
  archive(mesh.zones);
  archive(mesh.rooms);
  archive(mesh.cellZones);
  auto& classification = part.plain.classification;
  archive(classification.classes);
  archive(classification.offsets);
  archive(classification.pieces);
  archive(classification.turnedSides);
  archive(part.plain.vertexOf);
  archive(part.elementKeys);
  archive(part.points);
  archive(part.near.mayMove);
  archive(part.near.rows);
  archive(part.beyond);
}

Bytes bytesOf(const WindowPart& part)
{
  const auto& limits = part.plain.classification.displacementLimits;
  ByteWriter writer;
  writer(std::vector<LimitOf>(limits.begin(), limits.end()));
  visit(writer, part);
  return writer.take();
}

WindowPart partFrom(const Bytes& bytes)
{
  WindowPart part;
  std::vector<LimitOf> limits;
  ByteReader reader(bytes);
  reader(limits);
  visit(reader, part);
  part.plain.classification.displacementLimits.insert(limits.begin(), limits.end());
  return part;
}

/// Joins one list after the other, and frees that list of each part at once. Else all lists would be in memory twice.
class WindowJoiner
{
public:
  WindowJoiner(std::vector<WindowPart> parts, Index cutTag) : parts_(std::move(parts)), cutTag_(cutTag) {}

  SharedWindow join()
  {
    takePoints();
    takeElements();
    takeFaces();
    dropLooseZoneFaces();
    orderBoundaryFaces(out_.plain.mesh);
    return std::move(out_);
  }

private:
  struct Source
  {
    std::uint32_t part = 0;
    Index vertex = noIndex;
  };

  /// Takes vertices, and then the other points. Parts agree on the points that several of them have.
  void takePoints()
  {
    std::vector<SharedPoint> vertices;
    std::vector<SharedPoint> others;
    for (const WindowPart& part : parts_)
    {
      const auto middle = part.points.begin() + static_cast<std::ptrdiff_t>(part.near.mayMove.size());
      vertices.insert(vertices.end(), part.points.begin(), middle);
      others.insert(others.end(), middle, part.points.end());
    }
    sortUnique(vertices);
    sortUnique(others);
    out_.vertexCount = static_cast<Index>(vertices.size());
    out_.points = std::move(vertices);
    out_.points.reserve(out_.points.size() + others.size());
    out_.points.insert(out_.points.end(), others.begin(), others.end());
    release(others);
    out_.plain.mesh.points.resize(out_.points.size());
    out_.plain.vertexOf.resize(out_.points.size());
    std::vector<Source> sources(out_.vertexCount);
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      takePlaces(i, sources);
      release(parts_[i].points);
      release(parts_[i].plain.mesh.points);
      release(parts_[i].plain.vertexOf);
    }
    classify(sources);
    for (WindowPart& part : parts_)
    {
      part.plain.classification = {};
      release(part.near.mayMove);
    }
  }

  void takePlaces(std::size_t i, std::vector<Source>& sources)
  {
    const WindowPart& part = parts_[i];
    std::vector<Index>& numbers = numbers_.emplace_back();
    numbers.reserve(part.points.size());
    for (Index p = 0; p < part.points.size(); ++p)
    {
      const Index point = numbers.emplace_back(out_.find(part.points[p]));
      out_.plain.mesh.points[point] = part.plain.mesh.points[p];
      out_.plain.vertexOf[point] = point < out_.vertexCount ? point : out_.find({part.points[p].leaf, 0});
      if (point < out_.vertexCount)
      {
        sources[point] = {static_cast<std::uint32_t>(i), p};
      }
    }
  }

  void classify(const std::vector<Source>& sources)
  {
    VertexClassification& to = out_.plain.classification;
    to.classes.reserve(sources.size());
    to.offsets.reserve(sources.size() + 1);
    to.offsets.push_back(0);
    out_.near.mayMove.reserve(sources.size());
    for (const auto& [number, vertex] : sources)
    {
      const WindowPart& part = parts_[number];
      const VertexClassification& from = part.plain.classification;
      const auto pieces = from.piecesOf(vertex);
      to.pieces.insert(to.pieces.end(), pieces.begin(), pieces.end());
      to.offsets.push_back(static_cast<Index>(to.pieces.size()));
      if (!from.turnedSides.empty())
      {
        to.turnedSides.push_back(from.turnedSides[vertex]);
      }
      const auto found = from.displacementLimits.find(vertex);
      if (found != from.displacementLimits.end())
      {
        to.displacementLimits.emplace(static_cast<Index>(to.classes.size()), found->second);
      }
      to.classes.push_back(from.classes[vertex]);
      out_.near.mayMove.push_back(part.near.mayMove[vertex]);
    }
  }

  /// `listOf` returns the list of a part, or of the window; `convert` turns an entry of part i into one of the window.
  template <typename ListOf, typename Convert> void joinLists(ListOf&& listOf, Convert&& convert)
  {
    auto& to = listOf(out_);
    std::size_t count = 0;
    std::ranges::for_each(parts_, [&](WindowPart& part) { count += listOf(part).size(); });
    to.reserve(count);
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      auto& from = listOf(parts_[i]);
      std::ranges::transform(from, std::back_inserter(to), [&](const auto& entry) { return convert(i, entry); });
      release(from);
    }
  }
  template <typename ListOf> void joinLists(ListOf&& listOf)
  {
    joinLists(listOf, [](std::size_t, const auto& entry) { return entry; });
  }

  void takeElements()
  {
    for (const WindowPart& part : parts_)
    {
      firsts_.push_back(firsts_.back() + static_cast<Index>(part.elementKeys.size()));
    }
    joinLists([](auto& of) -> auto& { return of.elementKeys; });
    joinLists(
        [](auto& of) -> auto& { return of.plain.mesh.corners; },
        [&](std::size_t i, std::array<Index, 8> corners) {
          std::ranges::transform(corners, corners.begin(), [&](Index p) { return numbers_[i][p]; });
          return corners;
        });
    release(numbers_);
    joinLists(
        [](auto& of) -> auto& { return of.plain.mesh.neighbors; },
        [&](std::size_t i, std::array<std::int32_t, 6> neighbors) {
          for (std::int32_t& code : neighbors)
          {
            code += code >= 0 ? static_cast<std::int32_t>(firsts_[i]) : 0;
          }
          return neighbors;
        });
    joinLists([](auto& of) -> auto& { return of.plain.mesh.levels; });
    joinLists([](auto& of) -> auto& { return of.plain.mesh.zones; });
    joinLists([](auto& of) -> auto& { return of.plain.mesh.rooms; });
    joinLists([](auto& of) -> auto& { return of.plain.mesh.cellZones; });
    joinLists([](auto& of) -> auto& { return of.near.rows; });
  }

  void takeFaces()
  {
    std::size_t count = 0;
    std::ranges::for_each(parts_, [&](const WindowPart& part) { count += part.beyond.size(); });
    out_.plain.mesh.boundaryFaces.reserve(count);
    for (std::size_t i = 0; i < parts_.size(); ++i)
    {
      addFaces(parts_[i], firsts_[i]);
      release(parts_[i].beyond);
      release(parts_[i].plain.mesh.boundaryFaces);
    }
    joinLists(
        [](auto& of) -> auto& { return of.plain.mesh.zoneFaces; },
        [&](std::size_t i, ZoneFace face) {
          face.element += firsts_[i];
          return face;
        });
  }

  void addFaces(const WindowPart& part, Index first)
  {
    DualMesh& mesh = out_.plain.mesh;
    for (std::size_t f = 0; f < part.beyond.size(); ++f)
    {
      BoundaryFace face = part.plain.mesh.boundaryFaces[f];
      face.element += first;
      const Index beyond = find(part.beyond[f]);
      if (face.tag == cutTag_ && beyond != noIndex)
      {
        mesh.neighbors[face.element][face.direction] = static_cast<std::int32_t>(beyond);
        continue;
      }
      face.opposite = face.tag == cutTag_ ? noIndex : beyond;
      mesh.boundaryFaces.push_back(face);
    }
  }

  Index find(PointKey key) const
  {
    const auto found = std::ranges::lower_bound(out_.elementKeys, key);
    return found != out_.elementKeys.end() && *found == key ? static_cast<Index>(found - out_.elementKeys.begin())
                                                            : noIndex;
  }

  /// Removes faces of zones where the window ends.
  void dropLooseZoneFaces()
  {
    DualMesh& mesh = out_.plain.mesh;
    std::erase_if(mesh.zoneFaces,
                  [&](const ZoneFace& face) { return mesh.neighbors[face.element][face.direction] < 0; });
  }

  std::vector<WindowPart> parts_;
  /// One entry per part: the numbers of its points in the window, and the number of its first element.
  std::vector<std::vector<Index>> numbers_;
  std::vector<Index> firsts_{0};
  Index cutTag_;
  SharedWindow out_;
};

/// Returns the part with these elements of `whole`, which are sorted.
WindowPart partOf(const WindowPart& whole, const std::vector<Index>& elements, Index cutTag)
{
  const DualMesh& mesh = whole.plain.mesh;
  MeshWindow window =
      extractWindow(mesh, mesh.points, whole.plain.classification, whole.plain.vertexOf, elements, cutTag);
  WindowPart part;
  part.elementKeys = chosenOf<std::vector<PointKey>>(whole.elementKeys, elements);
  part.points = chosenOf<std::vector<SharedPoint>>(whole.points, window.pointIds);
  const std::vector<Index> vertices(window.pointIds.begin(),
                                    window.pointIds.begin() + static_cast<std::ptrdiff_t>(window.vertexCount()));
  part.near = {chosenOf<std::vector<char>>(whole.near.mayMove, vertices),
               chosenOf<std::vector<std::uint8_t>>(whole.near.rows, elements)};
  part.beyond.reserve(window.faceIds.size());
  for (Index f = 0; f < window.faceIds.size(); ++f)
  {
    const BoundaryFace& face = window.mesh.boundaryFaces[f];
    const bool isCut = window.faceIds[f] == noIndex;
    part.beyond.push_back(isCut ? whole.elementKeys[mesh.neighbors[elements[face.element]][face.direction]]
                                : whole.beyond[window.faceIds[f]]);
  }
  using Numbers = Buffer<std::int32_t>;
  window.mesh.rooms = mesh.rooms.empty() ? Numbers() : chosenOf<Numbers>(mesh.rooms, elements);
  window.mesh.cellZones = mesh.cellZones.empty() ? Numbers() : chosenOf<Numbers>(mesh.cellZones, elements);
  window.mesh.zoneFaces = zoneFacesOf(mesh, elements);
  part.plain = {std::move(window.mesh), std::move(window.classification), std::move(window.vertexOf)};
  return part;
}

/// Does the same for a part that is cut itself. All faces where the new part ends have one tag.
WindowPart partOfCut(const WindowPart& cut, const std::vector<Index>& elements, Index cutTag)
{
  WindowPart part = partOf(cut, elements, cutTag + 1);
  for (BoundaryFace& face : part.plain.mesh.boundaryFaces)
  {
    face.tag -= face.tag > cutTag ? 1 : 0;
  }
  return part;
}

} // namespace

std::vector<WindowPart> exchangeParts(WindowPart own, const std::vector<std::vector<Index>>& elements, Index cutTag,
                                      RankExchange& exchange)
{
  std::vector<Bytes> messages;
  messages.reserve(elements.size());
  for (const std::vector<Index>& some : elements)
  {
    messages.push_back(some.empty() ? Bytes() : bytesOf(partOfCut(own, some, cutTag)));
  }
  std::vector<WindowPart> parts;
  parts.reserve(elements.size());
  for (Bytes& bytes : exchange.exchange(std::move(messages)))
  {
    parts.push_back(bytes.empty() ? WindowPart() : partFrom(bytes));
    release(bytes);
  }
  parts[static_cast<std::size_t>(exchange.rank())] = std::move(own);
  return parts;
}

SharedWindow joinParts(std::vector<WindowPart> parts, Index cutTag)
{
  return WindowJoiner(std::move(parts), cutTag).join();
}

} // namespace atria
