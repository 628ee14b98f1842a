// SPDX-License-Identifier: GPL-3.0-or-later
/// Own elements of ranks that are brought together again.
#include "Ranks/OwnPart.h"
#include "Support/MeshIt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using namespace atria;
using namespace atria::testing;

/// Of each vertex its number, so that it can be told where it went.
VertexClassification classificationOf(std::size_t vertices)
{
  VertexClassification out;
  out.classes.resize(vertices);
  out.offsets.resize(vertices + 1);
  std::iota(out.offsets.begin(), out.offsets.end(), Index{0});
  out.pieces.resize(vertices);
  std::iota(out.pieces.begin(), out.pieces.end(), Index{0});
  out.leaves = out.pieces;
  for (Index v = 0; v < vertices; v += 7)
  {
    out.displacementLimits.emplace(v, DisplacementLimit{Vec3::Zero(), 0.5});
  }
  return out;
}

/// The whole mesh, of which elements from `first` up to `end` are own ones. Keys are numbers.
PlainShare shareOf(const DualMesh& mesh, Index first, Index end)
{
  PlainShare out;
  std::vector<Index> vertices(mesh.points.size());
  std::iota(vertices.begin(), vertices.end(), Index{0});
  out.plain = {mesh, classificationOf(vertices.size()), vertices};
  out.keys.resize(mesh.elementCount());
  std::iota(out.keys.begin(), out.keys.end(), PointKey{0});
  std::ranges::transform(vertices, std::back_inserter(out.points), [](Index p) { return SharedPoint{p, 0}; });
  out.firstOwn = first;
  out.endOwn = end;
  return out;
}

NearBoundary nearOf(const DualMesh& mesh)
{
  NearBoundary near{std::vector<char>(mesh.points.size()), std::vector<std::uint8_t>(mesh.elementCount())};
  for (std::size_t p = 0; p < near.mayMove.size(); ++p)
  {
    near.mayMove[p] = p % 3 == 0 ? 1 : 0;
  }
  for (std::size_t e = 0; e < near.rows.size(); ++e)
  {
    near.rows[e] = static_cast<std::uint8_t>(e % 11);
  }
  return near;
}

/// As in a window: with a tag before those of the domain's sides, and faces in the order of elements.
DualMesh asInWindow(DualMesh mesh, Index cutTag)
{
  for (BoundaryFace& face : mesh.boundaryFaces)
  {
    face.tag += face.tag < cutTag ? 0 : 1;
  }
  orderBoundaryFaces(mesh);
  return mesh;
}

TEST(WindowParts, OfAllRanksAreTheWhole)
{
  for (unsigned seed = 1; seed <= 12; ++seed)
  {
    SCOPED_TRACE(seed);
    const Meshed meshed = meshSoup(seed, 0.5);
    const DualMesh& mesh = meshed.mesh();
    const auto count = static_cast<Index>(mesh.elementCount());
    const auto cutTag = static_cast<Index>(meshed.model.names.size());
    std::vector<WindowPart> parts;
    for (const auto& [first, end] : {std::pair(Index{0}, count / 5), std::pair(count / 5, count / 2),
                                     std::pair(count / 2, count / 2), std::pair(count / 2, count)})
    {
      parts.push_back(ownPart(shareOf(mesh, first, end), nearOf(mesh), cutTag));
      EXPECT_EQ(parts.back().elementKeys.size(), end - first);
    }
    const SharedWindow window = joinParts(std::move(parts), cutTag);
    const DualMesh whole = asInWindow(mesh, cutTag);
    const DualMesh& joined = window.plain.mesh;
    EXPECT_EQ(joined.points, whole.points);
    EXPECT_EQ(joined.corners, whole.corners);
    EXPECT_EQ(joined.neighbors, whole.neighbors);
    EXPECT_EQ(joined.levels, whole.levels);
    EXPECT_EQ(joined.zones, whole.zones);
    for (const auto member :
         {&BoundaryFace::element, &BoundaryFace::tag, &BoundaryFace::opposite, &BoundaryFace::chart})
    {
      EXPECT_TRUE(std::ranges::equal(joined.boundaryFaces, whole.boundaryFaces, {}, member, member));
    }
    const VertexClassification& found = window.plain.classification;
    const VertexClassification wanted = classificationOf(mesh.points.size());
    EXPECT_EQ(found.offsets, wanted.offsets);
    EXPECT_EQ(found.pieces, wanted.pieces);
    EXPECT_EQ(found.displacementLimits.size(), wanted.displacementLimits.size());
    EXPECT_EQ(window.near.mayMove, nearOf(mesh).mayMove);
    EXPECT_EQ(window.near.rows, nearOf(mesh).rows);
  }
}

} // namespace
