// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes divided among ranks.
#pragma once

#include "Ranks/WidePiece.h"
#include "Support/SampleMesh.h"

#include <array>
#include <vector>

namespace atria::testing {

/// Cells of all kinds, with points moved, and above them cubes with points of their own where both meet, as at the two
/// sides of a sheet; some of the faces between cubes are sheets without thickness.
struct DividedSample
{
  DividedSample(unsigned seed, std::size_t ranks, std::array<int, 3> size = {7, 6, 5}, double distance = 0.25);

  SampleMesh mesh;
  std::vector<BoundaryFaceKey> faces() const;
  std::vector<Index> patchOf;
  std::vector<std::int64_t> labels; ///< by cell
  std::vector<Index> rankOf;        ///< by cell

  std::vector<std::vector<std::int64_t>> facePoints;
  std::vector<Index> faceCells;
};

/// What a rank has of it, with cells and points in an order of its own.
class PieceOfSample
{
public:
  PieceOfSample(const DividedSample& sample, Index rank);
  NarrowPiece view() const;

private:
  SampleMesh mesh;
  std::vector<std::int64_t> cellIds;
  std::vector<std::int64_t> pointIds;
  std::vector<char> isOwn;
  std::vector<std::int64_t> labels;
  std::vector<std::vector<std::int64_t>> facePoints;
  std::vector<BoundaryFaceKey> faces;
  std::vector<Index> patchOf;
};

/// By cell, how many rings it is away from the cells of a rank.
std::vector<Index> ringsAbout(const DividedSample& sample, Index rank);

} // namespace atria::testing
