// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats of finite elements, by readers of our own: the same cells, names, areas, volumes and zones.
#include "AbaqusMesh.h"
#include "ElementFile.h"
#include "Quality/Faces/CellShapes.h"
#include "Support/ProgressWatch.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"
#include "vtkAtriaAbaqusWriter.h"
#include "vtkAtriaGmshWriter.h"

#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <set>

namespace {

namespace fs = std::filesystem;
using atria::Vec3;
using atria::testing::bytesOf;
using atria::testing::ElementFile;
using atria::testing::expectSameFacts;
using atria::testing::MeshFacts;
using atria::testing::SampleMesh;
using ::testing::HasSubstr;
using Corners = std::vector<std::int64_t>;

constexpr std::array<int, 3> size{4, 3, 3};
constexpr double tolerance = 1e-12;

/// The same hexahedron with its corners in another order.
Corners turned(Corners cube, unsigned turns)
{
  const auto turn = [&](const std::array<std::size_t, 8>& order) {
    Corners next;
    std::ranges::transform(order, std::back_inserter(next), [&](std::size_t i) { return cube[i]; });
    cube = next;
  };
  for (unsigned i = 0; i < turns; ++i)
  {
    i % 3 == 0 ? turn({0, 4, 5, 1, 3, 7, 6, 2}) : turn({1, 2, 3, 0, 5, 6, 7, 4});
  }
  return cube;
}

void addPyramids(SampleMesh& mesh, const Corners& cube, bool cutsOne)
{
  const auto apex = static_cast<std::int64_t>(mesh.points.size());
  Vec3 center = Vec3::Zero();
  std::ranges::for_each(cube, [&](std::int64_t p) { center += mesh.points[static_cast<std::size_t>(p)] / 8.0; });
  mesh.points.push_back(center);
  for (const atria::LocalFace& face : atria::shapeOf(atria::hexahedronCell).faces)
  {
    const auto at = [&](int i) { return cube[face.corners[3 - i]]; };
    const bool onBottom = std::ranges::all_of(
        face.corners, [&](std::uint8_t i) { return mesh.points[static_cast<std::size_t>(cube[i])][2] < 0.1; });
    if (cutsOne && onBottom)
    {
      mesh.addCell(atria::tetrahedronCell, {at(0), at(1), at(2), apex});
      mesh.addCell(atria::tetrahedronCell, {at(0), at(2), at(3), apex});
    }
    else
    {
      mesh.addCell(atria::pyramidCell, {at(0), at(1), at(2), at(3), apex});
    }
  }
}

/// Hexahedra with corners in many orders; a column of wedges if `wedges`; pyramids and tetrahedra if `pyramids`.
SampleMesh elements(bool wedges, bool pyramids)
{
  const SampleMesh cubes = atria::testing::hexahedra(size);
  SampleMesh mesh;
  mesh.points = cubes.points;
  std::mt19937 random(5);
  for (Vec3& x : mesh.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isInside = x[axis] > 0.5 && x[axis] < size[static_cast<std::size_t>(axis)] - 0.5;
      x[axis] += isInside ? 1e-2 * static_cast<double>(random() % 16) : 0.0;
    }
  }
  for (std::size_t cell = 0; cell < cubes.types.size(); ++cell)
  {
    const Corners c(cubes.connectivity.begin() + cubes.offsets[cell],
                    cubes.connectivity.begin() + cubes.offsets[cell + 1]);
    const Vec3& low = cubes.points[static_cast<std::size_t>(c[0])];
    if (wedges && low[0] < 0.5 && low[1] < 0.5)
    {
      mesh.addCell(atria::wedgeCell, {c[0], c[3], c[1], c[4], c[7], c[5]});
      mesh.addCell(atria::wedgeCell, {c[1], c[3], c[2], c[5], c[7], c[6]});
    }
    else if (pyramids && low[0] > 2.5 && low[1] > 1.5)
    {
      addPyramids(mesh, c, low[2] < 0.5);
    }
    else
    {
      mesh.addCell(atria::hexahedronCell, turned(c, static_cast<unsigned>(cell % 24)));
    }
  }
  return mesh;
}

/// Names of the box' sides, two of which are those of a sheet.
std::string sheetOnSides(const Vec3& center)
{
  const std::string side = atria::testing::sidesOfBox(size)(center);
  return side == "xMin" ? "canopy 1_front" : side == "xMax" ? "canopy 1_back" : side;
}

class ElementWriters : public atria::testing::VtkTest
{
protected:
  void SetUp() override { take(elements(true, false)); }

  void take(const SampleMesh& mesh)
  {
    sample = mesh;
    grid = atria::testing::toGrid(sample);
    name(atria::testing::sidesOfBox(size));
  }

  void name(const atria::testing::NameOfFace& boundary)
  {
    patches = atria::testing::toPatches(makeFaceMesh(sample.points, sample.view()), boundary);
    expected = atria::testing::factsOf(grid, patches);
  }

  /// Patches as files name them.
  MeshFacts expectedInFile() const
  {
    MeshFacts facts = expected;
    for (const std::string side : {"_front", "_back"})
    {
      auto patch = facts.patches.extract("canopy 1" + side);
      patch.key() = "canopy_1" + side;
      facts.patches.insert(std::move(patch));
    }
    return facts;
  }

  template <typename Writer> int write(vtkNew<Writer>& writer, const char* name)
  {
    writer->SetInputDataObject(grid);
    writer->SetPatchesData(patches);
    writer->SetFileName(file(name).c_str());
    return writer->Write();
  }

  ElementFile writtenGmsh()
  {
    vtkNew<vtkAtriaGmshWriter> writer;
    EXPECT_EQ(write(writer, "mesh.msh"), 1);
    return atria::testing::readGmsh(file("mesh.msh"));
  }

  ElementFile writtenAbaqus()
  {
    vtkNew<vtkAtriaAbaqusWriter> writer;
    EXPECT_EQ(write(writer, "mesh.inp"), 1);
    return atria::testing::readAbaqus(file("mesh.inp"));
  }

  /// Numbers zones by the place of a cell's first corner.
  void addZones(const char* ids, const char* names, const std::vector<std::string>& words,
                const std::function<int(const Vec3&)>& zoneAt)
  {
    vtkNew<vtkIntArray> zones;
    zones->SetName(ids);
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      Vec3 low = Vec3::Constant(9.0);
      const auto first = sample.connectivity.begin() + sample.offsets[static_cast<std::size_t>(cell)];
      const auto last = sample.connectivity.begin() + sample.offsets[static_cast<std::size_t>(cell) + 1];
      std::for_each(first, last,
                    [&](std::int64_t p) { low = low.cwiseMin(sample.points[static_cast<std::size_t>(p)]); });
      zones->InsertNextValue(zoneAt(low));
    }
    grid->GetCellData()->AddArray(zones);
    vtkNew<vtkStringArray> texts;
    texts->SetName(names);
    std::ranges::for_each(words, [&](const std::string& word) { texts->InsertNextValue(word); });
    grid->GetFieldData()->AddArray(texts);
  }

  std::string file(const char* name) const { return (scratch.path() / name).string(); }

  atria::testing::ScratchFolder scratch;
  SampleMesh sample;
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
  MeshFacts expected;
};

TEST_F(ElementWriters, GmshKeepsElementsOfAllTypesAndNames)
{
  take(elements(true, true));
  name(sheetOnSides);
  const ElementFile mesh = writtenGmsh();
  std::map<std::size_t, std::size_t> counts; // by corners
  std::ranges::for_each(mesh.elements, [&](const auto& element) { ++counts[element.second.size()]; });
  for (const auto& [type, corners] : {std::pair{10, 4u}, {12, 8u}, {13, 6u}, {14, 5u}})
  {
    EXPECT_GT(counts[corners], 0u);
    EXPECT_EQ(counts[corners], static_cast<std::size_t>(std::ranges::count(sample.types, type)));
  }
  expectSameFacts(factsOf(mesh, true), expectedInFile(), tolerance);
  EXPECT_EQ(mesh.zones.size(), 1u);
  EXPECT_EQ(mesh.zones.at("fluid").size(), expected.cells);
  EXPECT_THAT(bytesOf(file("mesh.msh")), HasSubstr("canopy_1_front: \"canopy 1_front\"\n"));
}

TEST_F(ElementWriters, AbaqusKeepsElementsAndNames)
{
  name(sheetOnSides);
  const ElementFile mesh = writtenAbaqus();
  EXPECT_THAT(bytesOf(file("mesh.inp")), HasSubstr("** \"canopy 1_front\"\n*SURFACE, NAME=canopy_1_front"));
  expectSameFacts(factsOf(mesh, false), expectedInFile(), tolerance);
}

TEST_F(ElementWriters, FacesOfAbaqusLieOnTheSidesOfTheBox)
{
  // The sides are planes, which the nodes of the faces S1 to S6 in Abaqus' manual must lie on, however an element is
  // turned.
  const ElementFile mesh = writtenAbaqus();
  const std::map<std::string, std::pair<int, double>> planes{{"xMin", {0, 0}}, {"xMax", {0, size[0]}},
                                                             {"yMin", {1, 0}}, {"yMax", {1, size[1]}},
                                                             {"zMin", {2, 0}}, {"zMax", {2, size[2]}}};
  std::size_t faces = 0;
  for (const auto& [name, plane] : planes)
  {
    for (const auto& face : mesh.surfaces.at(name))
    {
      ++faces;
      for (const std::int64_t node : face)
      {
        EXPECT_DOUBLE_EQ(mesh.points.at(node)[plane.first], plane.second) << name;
      }
    }
  }
  EXPECT_EQ(mesh.surfaces.size(), planes.size());
  EXPECT_GT(faces, 66u) << "of cubes, and triangles of wedges";
  const std::string text = bytesOf(file("mesh.inp"));
  for (const char* side : {", S1\n", ", S2\n", ", S3\n", ", S4\n", ", S5\n", ", S6\n"})
  {
    EXPECT_THAT(text, HasSubstr(side));
  }
}

TEST_F(ElementWriters, ZonesAreVolumesAndSetsOfElements)
{
  addZones("RoomId", "RoomName", {"room 1", "outside"}, [](const Vec3& low) { return low[0] > 1.5 ? 1 : 0; });
  addZones("CellZoneId", "CellZoneName", {"tree"},
           [](const Vec3& low) { return low[0] > 2.5 && low[2] < 0.5 ? 0 : -1; });
  for (const ElementFile& mesh : {writtenGmsh(), writtenAbaqus()})
  {
    EXPECT_EQ(mesh.zones.size(), 3u);
    EXPECT_NEAR(volumeOf(mesh, "room_1") + volumeOf(mesh, "outside"), expected.volume, tolerance * expected.volume);
    const std::set<std::int64_t> outside(mesh.zones.at("outside").begin(), mesh.zones.at("outside").end());
    EXPECT_EQ(mesh.zones.at("tree").size(), 3u);
    EXPECT_TRUE(
        std::ranges::all_of(mesh.zones.at("tree"), [&](std::int64_t element) { return outside.contains(element); }));
    expectSameFacts(factsOf(mesh, false), expected, tolerance);
  }
}

TEST_F(ElementWriters, CellsInNoZoneOfGmshAreFluid)
{
  addZones("CellZoneId", "CellZoneName", {"fluid"}, [](const Vec3& low) { return low[0] > 2.5 ? 0 : -1; });
  const ElementFile mesh = writtenGmsh();
  EXPECT_EQ(mesh.zones.size(), 2u);
  EXPECT_EQ(mesh.zones.at("fluid").size() + mesh.zones.at("fluid_2").size(), expected.cells);
}

TEST_F(ElementWriters, AbaqusReadsAllNamesAndNumbers)
{
  const std::map<std::string, std::string> odd{{"xMin", std::string(100, 'a')}, {"xMax", std::string(100, 'a') + "b"},
                                               {"yMin", "2nd floor"},           {"yMax", "_wall"},
                                               {"zMin", "Wall, wet"},           {"zMax", "WALL, WET"}};
  const auto sides = atria::testing::sidesOfBox(size);
  name([&](const Vec3& center) { return odd.at(sides(center)); });
  addZones("CellZoneId", "CellZoneName", {"EALL"}, [](const Vec3& low) { return low[0] > 2.5 ? 0 : -1; });
  grid->GetPoints()->SetPoint(0, -1.2345678901234567e-5, -1e-300, 0.0);
  const ElementFile mesh = writtenAbaqus();
  EXPECT_EQ(mesh.surfaces.size(), odd.size());
  EXPECT_TRUE(mesh.surfaces.contains("N_2nd_floor"));
  EXPECT_TRUE(mesh.surfaces.contains("N__wall"));
  EXPECT_FALSE(mesh.zones.contains("EALL")) << "this set has all elements";
}

TEST(AbaqusNumber, HasTwentyCharactersAtMost)
{
  EXPECT_EQ(atria::abaqusNumber(0.1), "0.1");
  EXPECT_EQ(atria::abaqusNumber(-12.345678901234567), "-12.345678901234567");
  for (const double value :
       {-1.2345678901234567e-5, -1.2345678901234567e-100, 1.0 / 3e5, -2.0 / 3e7, 123456.78901234567})
  {
    const std::string text = atria::abaqusNumber(value);
    EXPECT_LE(text.size(), 20u) << text;
    EXPECT_NEAR(std::stod(text), value, 1e-12 * std::abs(value));
  }
}

TEST_F(ElementWriters, SolversAreToldOfSheetsOneFaceWide)
{
  take(elements(false, false));
  patches = atria::testing::toPatches(
      makeFaceMesh(sample.points, sample.view()), atria::testing::sidesOfBox(size),
      [](const Vec3& center) { return (center - Vec3(1.5, 1.5, 1.1)).norm() < 0.3 ? "flap" : ""; });
  vtkNew<vtkAtriaGmshWriter> gmsh;
  EXPECT_EQ(write(gmsh, "mesh.msh"), 1);
  EXPECT_THAT(messages.takeWarnings(), ::testing::ElementsAre(HasSubstr("2 faces of sheets one face wide")));
}

TEST_F(ElementWriters, PolyhedraAndPyramidsAreRefusedWithTheirNumber)
{
  take(atria::testing::mixedCells({3, 3, 3}, 8, 0.1));
  const auto polyhedra = std::to_string(std::ranges::count(sample.types, atria::polyhedronCell));
  const auto pyramids = std::to_string(std::ranges::count(sample.types, atria::pyramidCell));
  vtkNew<vtkAtriaGmshWriter> gmsh;
  EXPECT_EQ(write(gmsh, "mesh.msh"), 0);
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(AllOf(HasSubstr("no place for " + polyhedra + " polyhedra among"),
                                        HasSubstr("ElementType Hexahedral and few layers, or write another format"))));
  vtkNew<vtkAtriaAbaqusWriter> abaqus;
  EXPECT_EQ(write(abaqus, "mesh.inp"), 0);
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("no place for " + polyhedra + " polyhedra and " +
                                                                   pyramids + " pyramids among")));
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

template <typename Writer> class ElementWritersError : public ElementWriters
{
};

using Writers = ::testing::Types<vtkAtriaGmshWriter, vtkAtriaAbaqusWriter>;
TYPED_TEST_SUITE(ElementWritersError, Writers);

TYPED_TEST(ElementWritersError, FolderThatIsNotThere)
{
  vtkNew<TypeParam> writer;
  EXPECT_EQ(this->write(writer, "nowhere/mesh.x"), 0);
  EXPECT_THAT(this->messages.takeErrors(), ::testing::Contains(HasSubstr("does not exist; make it first")));
}

TYPED_TEST(ElementWritersError, NoFileName)
{
  vtkNew<TypeParam> writer;
  writer->SetInputDataObject(this->grid);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_THAT(this->messages.takeErrors(), ::testing::Contains(HasSubstr("No FileName was given")));
}

TYPED_TEST(ElementWritersError, AbortLeavesTheFileOfBefore)
{
  std::ofstream(this->file("mesh.x")) << "before";
  vtkNew<TypeParam> writer;
  const atria::testing::ProgressWatch watch(writer, atria::testing::beyond(0.6));
  EXPECT_EQ(this->write(writer, "mesh.x"), 0);
  this->messages.takeErrors();
  EXPECT_EQ(bytesOf(this->file("mesh.x")), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(this->scratch.path()), {}), 1) << "nothing unfinished is left";
}

} // namespace
