// SPDX-License-Identifier: GPL-3.0-or-later
/// Models all of whose coordinates lie on planes of the grid, at every level, turned exactly by quarter turns.
///
/// Which side of a wall on a grid plane the grid points of that plane are on is a matter of convention: all are thought
/// to be shifted towards growing x, y and z. That convention does not turn with the model, so coordinates of vertices
/// need not be the turned ones, and in a turned model a wall may cut the edges on its other side. What must not change
/// is what does not depend on that choice:
/// - the octree, and with it the number of elements in all;
/// - zones and the number of elements in each, as a space from plane to plane has as many grid points either way;
/// - faces of each surface, where octants on both sides of its walls are equal, as they are where only walls refine;
/// - how many faces meet at each point of the boundary, as a histogram.
/// The domain's planes pass through octants' centers, away from the model, so that they turn into each other.
#include "Support/DualMeshChecks.h"
#include "Support/MeshIt.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

/// The 24 turns of a cube: x -> sign * axis.
std::vector<std::array<int, 3>> turns()
{
  std::vector<std::array<int, 3>> out;
  std::array<int, 3> axes{0, 1, 2};
  do
  {
    const bool even = (axes[0] + 1) % 3 == axes[1];
    for (int signs = 0; signs < 8; ++signs)
    {
      const bool mirrored = ((signs & 1) + (signs >> 1 & 1) + (signs >> 2)) % 2 != 0;
      if (even != mirrored)
      {
        std::array<int, 3> turn;
        for (int i = 0; i < 3; ++i)
        {
          turn[i] = (signs >> i & 1 ? -1 : 1) * (axes[i] + 1);
        }
        out.push_back(turn);
      }
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return out;
}

Vec3 turned(const Vec3& p, const std::array<int, 3>& turn)
{
  Vec3 q;
  for (int i = 0; i < 3; ++i)
  {
    q[i] = turn[i] > 0 ? p[turn[i] - 1] : -p[-turn[i] - 1];
  }
  return q;
}

/// What does not depend on the convention.
struct Figures
{
  std::size_t elements = 0;
  std::vector<std::size_t> zones; ///< elements in each, sorted
  std::map<std::pair<std::string, SheetSide>, std::size_t> faces;
  std::map<int, std::size_t> degrees;                ///< points by number of boundary faces about them
  std::map<std::pair<int, int>, std::size_t> shapes; ///< elements by quadrilaterals and triangles
};

Figures figuresOf(const Meshed& meshed)
{
  const DualMesh& mesh = meshed.mesh();
  Figures out;
  out.elements = mesh.elementCount();
  std::map<std::int32_t, std::size_t> zones;
  for (Index e = 0; e < mesh.elementCount(); ++e)
  {
    ++zones[mesh.zones[e]];
    const FaceCounts counts = faceCounts(mesh, e);
    ++out.shapes[{counts.quads, counts.triangles}];
  }
  for (const auto& [zone, count] : zones)
  {
    out.zones.push_back(count);
  }
  std::sort(out.zones.begin(), out.zones.end());
  std::map<Index, int> degree;
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    const bool bare = face.tag >= meshed.model.names.size();
    ++out.faces[{bare ? "domain" : meshed.model.names[face.tag], face.side}];
    const ReducedFace corners = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < corners.count; ++i)
    {
      ++degree[corners.points[i]];
    }
  }
  for (const auto& [point, count] : degree)
  {
    ++out.degrees[count];
  }
  return out;
}

/// Faces of a solid's surface meet two by two.
void expectClosed(const Meshed& meshed, Index surface)
{
  std::map<std::pair<Index, Index>, int> edges;
  for (const BoundaryFace& face : meshed.mesh().boundaryFaces)
  {
    const ReducedFace corners = faceOf(meshed.mesh().corners[face.element], face.direction);
    for (int i = 0; face.tag == surface && i < corners.count; ++i)
    {
      const Index a = corners.points[i], b = corners.points[(i + 1) % corners.count];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  EXPECT_FALSE(edges.empty());
  EXPECT_TRUE(std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; }))
      << "the patch of " << meshed.model.names[surface] << " is open";
}

struct Model
{
  const char* name;
  std::function<void(TriangleSurface&)> make;
  std::vector<Index> solids;
};

void PrintTo(const Model& model, std::ostream* out) { *out << model.name; }

const std::vector<Model> models{{"Solid",
                                 [](TriangleSurface& s) {
                                   addBox(s, "Solid", {{-8, -4, -8}, {4, 8, 0}});
                                 },
                                 {0}},
                                {"SolidsSideBySide",
                                 [](TriangleSurface& s) {
                                   addBox(s, "A", {{-8, -8, -8}, {0, 0, 0}});
                                   addBox(s, "B", {{0, -8, -8}, {8, 0, 0}});
                                 },
                                 {}},
                                {"SolidsAtACorner",
                                 [](TriangleSurface& s) {
                                   addBox(s, "A", {{-8, -8, -8}, {0, 0, 0}});
                                   addBox(s, "B", {{0, 0, 0}, {8, 8, 8}});
                                 },
                                 {}},
                                {"SheetsInTheAir",
                                 [](TriangleSurface& s) {
                                   addSheet(s, "Corner1", {0, -8, -8}, {0, 8, 0}, {0, 0, 8});
                                   addSheet(s, "Corner2", {0, -8, -8}, {8, 0, 0}, {0, 0, 8});
                                   addSheet(s, "Alone", {-8, 4, -4}, {8, 0, 0}, {0, 0, 8});
                                 },
                                 {}},
                                {"RoomWithPartition",
                                 [](TriangleSurface& s) {
                                   // Both rooms share the partition's corners, so that it meets the walls along whole
                                   // edges.
                                   addBox(s, "West", {{-8, -4, -4}, {0, 4, 4}});
                                   addBox(s, "East", {{0, -4, -4}, {8, 4, 4}});
                                   addSheet(s, "Canopy", {-8, -8, 4}, {16, 0, 0}, {0, 4, 0});
                                 },
                                 {}}};

class ExactTurns : public ::testing::TestWithParam<std::tuple<Model, double>>
{
};

TEST_P(ExactTurns, KeepTheTopology)
{
  const auto& [model, sizeMid] = GetParam();
  TriangleSurface surface;
  model.make(surface);
  // The root is [-16, 16]^3, symmetric about the origin, its planes are on multiples of 1, 2, 4, 8 and 16.
  GridOptions grid;
  grid.domain = {Vec3::Constant(-15.5), Vec3::Constant(15.5)};
  grid.sizeMin = 1.0;
  grid.sizeMid = sizeMid;
  grid.sizeMax = std::max(sizeMid, 4.0 * (sizeMid - 1.0));
  grid.startLevel = 1;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  std::vector<Figures> all;
  ASSERT_EQ(turns().size(), 24u);
  for (const auto& turn : turns())
  {
    SCOPED_TRACE(std::to_string(turn[0]) + " " + std::to_string(turn[1]) + " " + std::to_string(turn[2]));
    TriangleSurface now = surface;
    for (Vec3& p : now.points)
    {
      p = turned(p, turn);
    }
    const Meshed meshed = meshIt(now, grid, options);
    ASSERT_EQ(meshed.frame.origin, Vec3::Constant(-16.0));
    ASSERT_EQ(meshed.frame.rootSize(), 32.0);
    EXPECT_TRUE(isSound(meshed.mesh()));
    for (const Index solid : model.solids)
    {
      expectClosed(meshed, solid);
    }
    all.push_back(figuresOf(meshed));
    EXPECT_EQ(all.back().elements, all.front().elements);
    EXPECT_EQ(all.back().shapes, all.front().shapes);
    EXPECT_EQ(all.back().zones, all.front().zones);
    EXPECT_EQ(all.back().faces, all.front().faces);
    EXPECT_EQ(all.back().degrees, all.front().degrees);
  }
}

INSTANTIATE_TEST_SUITE_P(OnGridPlanes, ExactTurns,
                         ::testing::Combine(::testing::ValuesIn(models), ::testing::Values(1.0, 2.0)),
                         [](const auto& test) {
                           return std::string(std::get<0>(test.param).name) +
                                  (std::get<1>(test.param) == 1.0 ? "_uniform" : "_adaptive");
                         });

} // namespace
