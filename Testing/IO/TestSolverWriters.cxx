// SPDX-License-Identifier: GPL-3.0-or-later
/// Formats of solvers, by other readers: the same cells, names, areas and volumes.
#include "OpenFOAMCase.h"
#include "SolverMeshFacts.h"
#include "Support/CheckMesh.h"
#include "Support/CheckWarnings.h"
#include "Support/FoamReader.h"
#include "Support/ProgressWatch.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"
#include "VtkVersions.h"
#include "vtkAtriaCGNSWriter.h"
#include "vtkAtriaFluentWriter.h"
#include "vtkAtriaSU2Writer.h"

#include <vtkCGNSReader.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArraySelection.h>
#include <vtkFLUENTReader.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <type_traits>

namespace {

namespace fs = std::filesystem;
using atria::FaceMesh;
using atria::Vec3;
using atria::testing::bytesOf;
using atria::testing::expectSameFacts;
using atria::testing::MeshFacts;
using atria::testing::SampleMesh;
using ::testing::HasSubstr;

constexpr std::array<int, 3> size{5, 4, 4};
// Readers of VTK keep points in single precision.
constexpr double singlePrecision = 1e-6;
constexpr double doublePrecision = 1e-12;

/// A piece of the plane z = 2 that ends inside the box.
std::string canopy(const Vec3& center)
{
  const bool on = std::abs(center[2] - 2.0) < 0.2 && center[0] > 1 && center[0] < 4 && center[1] > 1 && center[1] < 3;
  return on ? "canopy 1" : "";
}

class SolverWriters : public atria::testing::VtkTest
{
protected:
  /// Cells of all types about a sheet; polyhedra beside it are flat there.
  void SetUp() override
  {
    sample = atria::testing::mixedCells(size, 8, 0.1);
    grid = atria::testing::toGrid(sample);
    const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
    patches = atria::testing::toPatches(mesh, atria::testing::sidesOfBox(size), canopy);
    expected = atria::testing::factsOf(grid, patches);
    ASSERT_EQ(expected.patches.size(), 8u);
  }

  void addZones()
  {
    vtkNew<vtkIntArray> zones;
    zones->SetName("ZoneId");
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      zones->InsertNextValue(cell % 3 == 0 ? 7 : 0);
      zoneSize += cell % 3 == 0 ? 1 : 0;
    }
    grid->GetCellData()->AddArray(zones);
  }

  template <typename Writer> int write(vtkNew<Writer>& writer, const char* name)
  {
    writer->SetInputDataObject(grid);
    writer->SetPatchesData(patches);
    writer->SetFileName(file(name).c_str());
    const int written = writer->Write();
    if constexpr (std::is_base_of_v<vtkAtriaPolyhedralMeshWriter, Writer>)
    {
      if (written != 0)
      {
        atria::testing::expectCheckWarnings(messages, writer->GetChecks());
      }
    }
    return written;
  }

  /// With all cells and faces as they are.
  template <typename Writer> int writeAsItIs(const char* name)
  {
    vtkNew<Writer> writer;
    writer->MergeCoplanarFacesOff();
    writer->MergeUnderdeterminedCellsOff();
    return write(writer, name);
  }

  fs::path file(const char* name) const { return scratch.path() / name; }

  /// What it would be with other names of patches.
  MeshFacts renamed(const std::map<std::string, std::string>& names) const
  {
    MeshFacts facts = expected;
    for (const auto& [from, to] : names)
    {
      facts.patches[to] = facts.patches.at(from);
      facts.patches.erase(from);
    }
    return facts;
  }

  atria::testing::ScratchFolder scratch;
  SampleMesh sample;
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
  MeshFacts expected;
  std::size_t zoneSize = 0;
};

MeshFacts factsOfCase(const fs::path& folder)
{
  std::ofstream(folder / "case.foam");
  return atria::testing::factsOf(atria::testing::readFoam(folder / "case.foam")->GetOutput());
}

TEST_F(SolverWriters, FluentMeshesComeBackFromOpenFOAMsConverter)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "OpenFOAM is not installed";
  }
  addZones();
  ASSERT_EQ(writeAsItIs<vtkAtriaFluentWriter>("mesh.msh"), 1);
  atria::completeCase(file("case"));
  std::string log;
  ASSERT_TRUE(atria::testing::runOpenFOAM("fluent3DMeshToFoam '" + file("mesh.msh").string() + "'", file("case"), log))
      << log;
  const atria::testing::CheckMeshReport report = atria::testing::runCheckMesh(file("case"), "");
  ASSERT_TRUE(report.completed) << report.log;
  EXPECT_EQ(report.failedChecks, 0) << report.log;
  EXPECT_EQ(report.counts.at("cell zones"), 2);
  EXPECT_EQ(report.counts.at("face zones"), 3);
  EXPECT_NEAR(report.totalVolume, expected.volume, 1e-9 * expected.volume);
  expectSameFacts(factsOfCase(file("case")),
                  renamed({{"canopy 1_front", "canopy_1"}, {"canopy 1_back", "canopy_1-shadow"}}), singlePrecision);
}

TEST_F(SolverWriters, VtkReadsFluentMeshesWithTheirZones)
{
  addZones();
  ASSERT_EQ(writeAsItIs<vtkAtriaFluentWriter>("mesh.msh"), 1);
  const std::string text = bytesOf(file("mesh.msh"));
  EXPECT_THAT(text, HasSubstr(" wall canopy_1)())"));
  EXPECT_THAT(text, HasSubstr(" wall canopy_1-shadow)())"));
  EXPECT_THAT(text, HasSubstr(" pressure-outlet xMin)())"));
  EXPECT_THAT(text, HasSubstr(" fluid zone7)())"));
  if (ATRIA_VTK_HAS_FACE_LISTS)
  {
    GTEST_SKIP() << "vtkFLUENTReader of these versions ends in vtkUnstructuredGrid::InsertNextCell at polyhedra";
  }
  vtkNew<vtkFLUENTReader> reader;
  reader->SetFileName(file("mesh.msh").c_str());
  reader->Update();
  ASSERT_EQ(reader->GetOutput()->GetNumberOfBlocks(), 2u);
  auto* second = vtkUnstructuredGrid::SafeDownCast(reader->GetOutput()->GetBlock(1));
  EXPECT_EQ(static_cast<std::size_t>(second->GetNumberOfCells()), zoneSize);
  // It asks for results, too.
  EXPECT_THAT(messages.takeErrors(), ::testing::Each(HasSubstr("Could not open data file")));
  EXPECT_THAT(messages.takeWarnings(), ::testing::Each(HasSubstr("Unable to open dat file")));
  // To it polyhedra are sets of points.
  std::map<int, std::size_t> types;
  for (unsigned block = 0; block < 2; ++block)
  {
    auto* zone = vtkUnstructuredGrid::SafeDownCast(reader->GetOutput()->GetBlock(block));
    for (vtkIdType cell = 0; cell < zone->GetNumberOfCells(); ++cell)
    {
      const int type = zone->GetCellType(cell);
      ++types[type == VTK_CONVEX_POINT_SET ? VTK_POLYHEDRON : type];
    }
  }
  for (const auto& [type, count] : types)
  {
    const auto isOfType = [type = type](unsigned char its) {
      return its == type || (its == VTK_VOXEL && type == VTK_HEXAHEDRON);
    };
    EXPECT_EQ(count, static_cast<std::size_t>(std::ranges::count_if(sample.types, isOfType))) << "type " << type;
  }
  EXPECT_EQ(types.size(), 5u);
}

TEST_F(SolverWriters, MarkersAreTheBoundaryOfSU2sElements)
{
  // Its sheets have points of their own on both sides.
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  const auto sides = atria::testing::sidesOfBox(size);
  patches = atria::testing::toPatches(mesh, [&](const Vec3& center) {
    const std::string side = sides(center);
    return side == "zMin" ? "ground, wet" : side;
  });
  expected = atria::testing::factsOf(grid, patches);
  vtkNew<vtkAtriaSU2Writer> writer;
  ASSERT_EQ(write(writer, "mesh.su2"), 1);
  EXPECT_THAT(bytesOf(file("mesh.su2")), HasSubstr("% \"ground, wet\"\nMARKER_TAG= ground__wet\n"));
  const MeshFacts facts = atria::testing::factsOfSU2(file("mesh.su2"));
  EXPECT_GT(facts.cells, expected.cells) << "there are polyhedra to divide";
  expectSameFacts(facts, renamed({{"ground, wet", "ground__wet"}}), doublePrecision, false);
}

TEST_F(SolverWriters, SU2IsToldOfSheetsOneFaceWide)
{
  const FaceMesh mesh = makeFaceMesh(sample.points, sample.view());
  patches = atria::testing::toPatches(mesh, atria::testing::sidesOfBox(size), [&](const Vec3& center) {
    return (center - Vec3(2.5, 1.5, 2.0)).norm() < 0.3 ? "flap" : "";
  });
  vtkNew<vtkAtriaSU2Writer> writer;
  ASSERT_EQ(write(writer, "mesh.su2"), 1);
  EXPECT_THAT(messages.takeWarnings(), ::testing::ElementsAre(HasSubstr("faces of sheets one face wide")));
}

TEST_F(SolverWriters, CgnsFilesPassTheirOwnCheckAndVtkReadsThem)
{
  if (!vtkAtriaCGNSWriter::IsAvailable())
  {
    GTEST_SKIP() << "built without libcgns";
  }
  addZones();
  ASSERT_EQ(writeAsItIs<vtkAtriaCGNSWriter>("mesh.cgns"), 1);
  vtkNew<vtkCGNSReader> reader;
  reader->SetFileName(file("mesh.cgns").c_str());
  reader->LoadBndPatchOn();
  reader->UpdateInformation();
  reader->EnableAllBases();
  reader->EnableAllFamilies();
  reader->Update();
  MeshFacts facts = atria::testing::factsOf(reader->GetOutput());
  facts.volume = -facts.volume; // of VTK's polyhedra the faces look inward
  expectSameFacts(facts, expected, doublePrecision);
}

TEST_F(SolverWriters, CgnscheckHasNothingToSay)
{
  if (!vtkAtriaCGNSWriter::IsAvailable() || std::system("command -v cgnscheck > /dev/null 2>&1") != 0)
  {
    GTEST_SKIP() << "built without libcgns, or cgnscheck is not installed";
  }
  addZones();
  // It tells faces apart by their points, which those of this sheet have in common.
  patches = atria::testing::toPatches(makeFaceMesh(sample.points, sample.view()), atria::testing::sidesOfBox(size));
  ASSERT_EQ(writeAsItIs<vtkAtriaCGNSWriter>("mesh.cgns"), 1);
  const fs::path log = file("log");
  EXPECT_EQ(std::system(("cgnscheck '" + file("mesh.cgns").string() + "' > '" + log.string() + "' 2>&1").c_str()), 0);
  const std::string said = bytesOf(log);
  EXPECT_THAT(said, ::testing::Not(HasSubstr("ERROR"))) << said;
  EXPECT_THAT(said, ::testing::Not(HasSubstr("WARNING"))) << said;
  EXPECT_THAT(said, HasSubstr("checking BC \"zMax\""));
}

template <typename Writer> class SolverWritersError : public SolverWriters
{
};

using Writers = ::testing::Types<vtkAtriaFluentWriter, vtkAtriaSU2Writer, vtkAtriaCGNSWriter>;
TYPED_TEST_SUITE(SolverWritersError, Writers);

TYPED_TEST(SolverWritersError, FolderThatIsNotThere)
{
  vtkNew<TypeParam> writer;
  EXPECT_EQ(this->write(writer, "nowhere/mesh.x"), 0);
  EXPECT_THAT(
      this->messages.takeErrors(),
      ::testing::Contains(HasSubstr(vtkAtriaCGNSWriter::IsAvailable() ||
                                            std::string(writer->GetClassName()).find("CGNS") == std::string::npos
                                        ? "does not exist; make it first"
                                        : "without libcgns")));
}

TYPED_TEST(SolverWritersError, NoFileName)
{
  vtkNew<TypeParam> writer;
  writer->SetInputDataObject(this->grid);
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_THAT(this->messages.takeErrors(), ::testing::Contains(HasSubstr("No FileName was given")));
}

TYPED_TEST(SolverWritersError, AbortLeavesTheFileOfBefore)
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
