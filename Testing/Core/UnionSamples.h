// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces of sample meshes and a check of their order, for tests of unions.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/SampleMesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

namespace atria::testing {

using Loop = std::vector<Index>;

inline FaceMesh meshOf(const SampleMesh& sample) { return makeFaceMesh(sample.points, sample.view()); }

inline Loop loopOf(const FaceMesh& mesh, std::size_t face) { return {mesh.face(face).begin(), mesh.face(face).end()}; }

/// Checks the order of faces, and that each cell is closed.
inline void expectWellFormed(const FaceMesh& mesh)
{
  ASSERT_EQ(mesh.faceOffsets.size(), mesh.faceCount() + 1);
  ASSERT_EQ(mesh.faceOffsets.back(), mesh.facePoints.size());
  std::map<std::array<Index, 3>, int> balance;
  std::pair<Index, Index> before{0, 0};
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const bool isInternal = f < mesh.internalFaceCount();
    const std::pair<Index, Index> now{mesh.owner[f], isInternal ? mesh.neighbor[f] : 0};
    EXPECT_TRUE(f == mesh.internalFaceCount() || now >= before) << f;
    EXPECT_TRUE(!isInternal || mesh.owner[f] < mesh.neighbor[f]) << f;
    before = now;
    const Loop loop = loopOf(mesh, f);
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      balance[{mesh.owner[f], a, b}] += loop[i] == a ? 1 : -1;
      balance[{isInternal ? mesh.neighbor[f] : noIndex, a, b}] += !isInternal ? 0 : loop[i] == a ? -1 : 1;
    }
  }
  EXPECT_TRUE(std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; }));
}

} // namespace atria::testing
