// SPDX-License-Identifier: GPL-3.0-or-later
/// One model in every format gives the same surfaces, names and mesh; and what each format has of its own.
#include "ModelSamples.h"
#include "VRMLModel.h"
#include "vtkAtriaDualMesher.h"
#include "vtkAtriaModelReader.h"
#include "vtkAtriaVRMLReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <array>
#include <fstream>
#include <set>

namespace {

namespace fs = std::filesystem;
using atria::Vec3;
using atria::testing::SampleModel;
using atria::testing::writeFile;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

struct Measure
{
  double area = 0.0;
  double volume = 0.0; ///< the surface's part in the volume enclosed: positive in sum where fronts look outwards
  std::string material;
};

std::string fieldString(vtkPolyData* data, const char* array, vtkIdType i)
{
  auto* strings = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(array));
  return strings ? strings->GetValue(i) : "(none)";
}

std::map<std::string, Measure> measuresOf(vtkPolyData* data)
{
  std::map<std::string, Measure> all;
  vtkDataArray* ids = data->GetCellData()->GetArray("SurfaceId");
  for (vtkIdType i = 0; ids && i < data->GetNumberOfCells(); ++i)
  {
    EXPECT_EQ(data->GetCellType(i), VTK_TRIANGLE);
    const auto surface = static_cast<vtkIdType>(ids->GetTuple1(i));
    Measure& m = all[fieldString(data, "SurfaceName", surface)];
    m.material = fieldString(data, "MaterialName", surface);
    vtkNew<vtkIdList> cell;
    data->GetCellPoints(i, cell);
    Vec3 p[3];
    for (int k = 0; k < 3; ++k)
    {
      data->GetPoint(cell->GetId(k), p[k].data());
    }
    m.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    m.volume += p[0].dot(p[1].cross(p[2])) / 6.0;
  }
  return all;
}

std::vector<std::string> stringsOf(vtkStringArray* array)
{
  std::vector<std::string> out;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    out.push_back(array->GetValue(i));
  }
  return out;
}

vtkSmartPointer<vtkPolyDataAlgorithm> readerFor(const fs::path& file)
{
  if (vtkAtriaModelReader::CanReadFile(file.c_str()))
  {
    auto reader = vtkSmartPointer<vtkAtriaModelReader>::New();
    reader->SetFileName(file.c_str());
    return reader;
  }
  auto reader = vtkSmartPointer<vtkAtriaVRMLReader>::New();
  reader->SetFileName(file.c_str());
  return reader;
}

class ModelReader : public atria::testing::VtkTest
{
protected:
  ModelReader()
  {
    reader->SetLengthUnit(vtkAtriaModelReader::Meters); // no hints
    reader->MergeDuplicateFacesOff();
  }

  vtkPolyData* read(const fs::path& file)
  {
    reader->SetFileName(file.c_str());
    reader->Modified(); // the file of that name may be another
    reader->Update();
    return reader->GetOutput();
  }
  vtkPolyData* readText(const std::string& name, const std::string& text)
  {
    return read(writeFile(scratch.path(), name, text));
  }
  std::vector<std::string> namesOf(vtkPolyData* data)
  {
    auto* names = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SurfaceName"));
    return names ? stringsOf(names) : std::vector<std::string>{};
  }
  /// The one error of reading `text`, which leaves the output empty.
  std::string errorOf(const std::string& name, const std::string& text)
  {
    const vtkPolyData* data = readText(name, text);
    EXPECT_EQ(const_cast<vtkPolyData*>(data)->GetNumberOfCells(), 0);
    messages.takeWarnings();
    const std::vector<std::string> errors = messages.takeErrors();
    return errors.empty() ? "" : errors.front();
  }
  /// The reader's warnings, which then have been seen.
  std::vector<std::string> warnings()
  {
    EXPECT_EQ(messages.takeWarnings().size(), reader->GetNumberOfWarnings() > 0 ? 1u : 0u);
    return stringsOf(reader->GetWarnings());
  }

  atria::testing::ScratchFolder scratch;
  vtkNew<vtkAtriaModelReader> reader;
};

class EveryFormat : public ModelReader, public ::testing::WithParamInterface<std::string>
{
protected:
  /// The formats that have no writer here are written by make_models.py.
  fs::path written()
  {
    const auto writer = atria::testing::writersWithNames().find(GetParam());
    const bool isWritten = writer != atria::testing::writersWithNames().end();
    const fs::path folder = isWritten ? scratch.path() : atria::testing::dataFolder() / "Models";
    fs::path file = folder / ("house." + GetParam());
    if (isWritten)
    {
      writer->second(house, file);
    }
    return file;
  }

  const SampleModel house = atria::testing::sampleHouse();
};

TEST_P(EveryFormat, KeepsSurfacesNamesMaterialsAndFronts)
{
  const auto source = readerFor(written());
  source->Update();
  const auto found = measuresOf(source->GetOutput());
  ASSERT_TRUE(source->GetOutput()->GetPoints());
  EXPECT_EQ(source->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  ASSERT_EQ(found.size(), house.surfaces.size());
  double volume = 0.0;
  const bool hasMaterials =
      GetParam() != "stl" && GetParam() != "dxf" && GetParam().substr(0, 3) != "vtm" && GetParam() != "vtpc";
  for (const SampleModel::Surface& surface : house.surfaces)
  {
    SCOPED_TRACE(surface.name);
    ASSERT_TRUE(found.count(surface.name));
    const Measure& measure = found.at(surface.name);
    double area = 0.0;
    for (const auto& t : trianglesOf(house, surface))
    {
      area += 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm();
    }
    EXPECT_NEAR(measure.area, area, 1e-12);
    const bool isGiven = GetParam() != "dae" || !surface.material.empty(); // else assimp takes the first there is
    EXPECT_EQ(measure.material, !isGiven ? "Brick" : hasMaterials ? surface.material : "");
    volume += measure.volume;
  }
  // The open door is in the plane y = 0, so that it takes nothing away.
  EXPECT_NEAR(volume, 8 * 6 * 5, 1e-10);
  double bounds[6];
  source->GetOutput()->GetBounds(bounds);
  EXPECT_THAT(bounds, ElementsAre(0, 8, 0, 6, 0, 6));
}

TEST_P(EveryFormat, GivesTheSameMesh)
{
  vtkNew<vtkAtriaDualMesher> mesher;
  mesher->SetDomainMode(vtkAtriaDualMesher::Explicit);
  const double domain[6] = {-8, 16, -8, 14, 0, 12};
  mesher->SetDomainBounds(domain);
  mesher->SetSizeMax(8.0);
  mesher->SetSizeMid(2.0);
  mesher->SetSizeMin(1.0);
  std::vector<vtkIdType> counts;
  std::vector<std::vector<std::string>> names;
  vtkNew<vtkAtriaVRMLReader> vrml;
  const fs::path reference = scratch.path() / "reference.wrl";
  atria::testing::writersWithNames().at("wrl")(house, reference);
  vrml->SetFileName(reference.c_str());
  const auto other = readerFor(written());
  for (vtkAlgorithm* source : {static_cast<vtkAlgorithm*>(vrml), static_cast<vtkAlgorithm*>(other)})
  {
    mesher->SetInputConnection(0, source->GetOutputPort());
    mesher->Update();
    auto* mesh = vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0));
    counts.push_back(mesh->GetNumberOfCells());
    counts.push_back(mesh->GetNumberOfPoints());
    auto* patches = vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1));
    names.emplace_back();
    for (unsigned i = 0; i < patches->GetNumberOfPartitionedDataSets(); ++i)
    {
      names.back().push_back(patches->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()));
      counts.push_back(patches->GetPartition(i, 0)->GetNumberOfCells());
    }
    std::sort(names.back().begin(), names.back().end());
  }
  std::sort(counts.begin(), counts.begin() + static_cast<long>(counts.size() / 2));
  std::sort(counts.begin() + static_cast<long>(counts.size() / 2), counts.end());
  EXPECT_GT(counts.front(), 0);
  EXPECT_EQ(names[0], names[1]);
  EXPECT_TRUE(std::equal(counts.begin(), counts.begin() + static_cast<long>(counts.size() / 2),
                         counts.begin() + static_cast<long>(counts.size() / 2), counts.end()));
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormat,
                         ::testing::Values("wrl", "obj", "stl", "gltf", "glb", "vtp", "vtm", "vtpc"),
                         [](const auto& format) { return format.param; });
INSTANTIATE_TEST_SUITE_P(CityJson, EveryFormat, ::testing::Values("city.json"),
                         [](const auto&) { return std::string("json"); });
#ifdef ATRIA_WITH_ASSIMP
INSTANTIATE_TEST_SUITE_P(Assimp, EveryFormat, ::testing::Values("dae", "3ds", "fbx", "dxf"),
                         [](const auto& format) { return format.param; });
#endif

TEST_F(ModelReader, CallsTheSurfaceOfFilesWithoutNamesLikeTheFile)
{
  const SampleModel house = atria::testing::sampleHouse();
  const fs::path stl = scratch.path() / "town hall.STL";
  const fs::path ply = scratch.path() / "library.ply";
  atria::testing::writeBinaryStl(house, stl);
  atria::testing::writePly(house, ply);
  const auto solid = measuresOf(read(stl));
  const auto polygons = measuresOf(read(ply));
  ASSERT_EQ(solid.size(), 1u);
  ASSERT_EQ(polygons.size(), 1u);
  EXPECT_EQ(solid.begin()->first, "town hall");
  EXPECT_EQ(polygons.begin()->first, "library");
  EXPECT_NEAR(solid.begin()->second.volume, 240.0, 1e-10);
  EXPECT_NEAR(polygons.begin()->second.volume, 240.0, 1e-10);
  EXPECT_NEAR(solid.begin()->second.area, polygons.begin()->second.area, 1e-10);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST_F(ModelReader, SharesCornersOfFacets)
{
  const fs::path stl = scratch.path() / "house.stl";
  atria::testing::writeBinaryStl(atria::testing::sampleHouse(), stl);
  vtkPolyData* data = read(stl);
  std::set<std::array<double, 3>> places;
  for (vtkIdType p = 0; p < data->GetNumberOfPoints(); ++p)
  {
    places.insert({data->GetPoint(p)[0], data->GetPoint(p)[1], data->GetPoint(p)[2]});
  }
  EXPECT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(places.size()));
  EXPECT_LT(data->GetNumberOfPoints(), 3 * data->GetNumberOfCells());
}

TEST_F(ModelReader, TellsObjObjectsGroupsAndMaterialsApart)
{
  const std::string f = "f 1 2 3 4\n";
  const auto found = measuresOf(readText(
      "city.obj", square + f + "o House\ng House_Roof\nusemtl Tiles\n" + f + "g House_Wall\nusemtl Brick\n" + f +
                      "usemtl Glass\n" + f + "o Church\ng Tower\n" + f + "usemtl Brick\n" + f + "g default\n" + f));
  std::vector<std::string> names;
  for (const auto& [name, measure] : found)
  {
    EXPECT_EQ(measure.area, 1.0) << name;
    names.push_back(name);
  }
  EXPECT_THAT(names, UnorderedElementsAre("city", "House_Roof", "House_Wall_Brick", "House_Wall_Glass",
                                          "Church_Tower_Glass", "Church_Tower_Brick", "Church"));
}

TEST_F(ModelReader, NamesObjSurfacesByMaterialWhereThereIsNothingElse)
{
  readText("a.obj", square + "usemtl Old brick\nf 1 2 3 4\nusemtl Gla\xdf\nf 1 2 3\nusemtl Old brick\nf 1 3 4\n");
  EXPECT_THAT(namesOf(reader->GetOutput()), ElementsAre("Old brick", "Gla\xc3\x9f"));
  EXPECT_EQ(measuresOf(reader->GetOutput()).at("Old brick").area, 1.5);
}

TEST_F(ModelReader, ReadsObjInDoublePrecisionWhateverEndsItsLines)
{
  vtkPolyData* data = readText("far.obj", "# C:\\models\\\rv 4500000.125 +5300000.25 1e1\rv 4500001.125 5300000.25 10\r"
                                          "v 4500001.125 5300001.25 10 0.5 0.5 0.5\rf 1 2 \\\r3");
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("Recenter")));
  ASSERT_EQ(data->GetNumberOfCells(), 1);
  EXPECT_EQ(data->GetPoint(0)[0], 4500000.125);
  EXPECT_EQ(data->GetPoint(2)[1], 5300001.25);
}

TEST_F(ModelReader, LeavesOutBadObjFacesAndSaysWhere)
{
  readText("bad.obj", square + "f 1 2 3\nf 1 2 9\nf 0 1 2\nf 1 2\nf a b c\nf -9 1 2\nl 1 2\np 1\ncurv 0 1 1 2\n");
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 1);
  EXPECT_THAT(warnings(), UnorderedElementsAre(AllOf(HasSubstr("bad.obj: line 6"), HasSubstr("beyond the last")),
                                               AllOf(HasSubstr("line 7"), HasSubstr("names no vertex")),
                                               HasSubstr("line 8"), HasSubstr("line 9"), HasSubstr("line 10"),
                                               HasSubstr("2 lines and points"), HasSubstr("1 free-form")));
}

TEST_F(ModelReader, NamesTheSurfaceOfAFaceThatCrossesItself)
{
  readText("a.obj", square + "g Floor\nf 1 2 3 4\ng Roof\nf 1 3 2 4\n");
  EXPECT_THAT(namesOf(reader->GetOutput()), ElementsAre("Floor"));
  EXPECT_THAT(warnings(), ElementsAre(AllOf(HasSubstr("crosses itself: in 'Roof'"), HasSubstr("order of corners"))));
}

TEST_F(ModelReader, JoinsStlSolidsOfOneNameAndNumbersThoseWithout)
{
  const auto solid = [](const std::string& name, int z) {
    const std::string height = std::to_string(z);
    return "solid" + name + "\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 " + height + "\n   vertex 2 0 " +
           height + "\n   vertex 0 1 " + height + "\n  endloop\n endfacet\nendsolid\n";
  };
  const auto found = measuresOf(readText("a.stl", solid(" Wall west", 0) + solid("", 1) + solid(" Roof", 2) +
                                                      solid(" Wall west", 3) + solid("", 4)));
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found.at("Wall west").area, 2.0);
  EXPECT_EQ(found.at("Roof").area, 1.0);
  EXPECT_EQ(found.at("a").area, 1.0);
  EXPECT_EQ(found.at("a_2").area, 1.0);
}

TEST_F(ModelReader, WarnsWhereSinglePrecisionIsTooCoarse)
{
  SampleModel house = atria::testing::sampleHouse();
  for (Vec3& p : house.points)
  {
    p += Vec3(4'500'000, 5'300'000, 0);
  }
  for (const std::string ending : {"binary.stl", "glb", "stl", "obj", "vtp"})
  {
    const fs::path file = scratch.path() / ("far." + ending);
    const bool isShort = ending == "binary.stl" || ending == "glb";
    (ending == "binary.stl" ? atria::testing::writeBinaryStl : atria::testing::writersWithNames().at(ending))(house,
                                                                                                              file);
    read(file);
    const std::vector<std::string> said = warnings();
    if (isShort)
    {
      EXPECT_THAT(said,
                  ElementsAre(HasSubstr("Recenter"), AllOf(HasSubstr("read in single precision"), HasSubstr("0.32"))))
          << ending;
    }
    else
    {
      EXPECT_THAT(said, ElementsAre(HasSubstr("Recenter"))) << ending;
    }
  }
}

/// A glTF file of one triangle in a mesh with the primitives given, and with these nodes.
std::string gltf(const std::string& nodes, const std::string& primitives, const std::string& more = "")
{
  // (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), as 32-bit numbers.
  return R"({"asset":{"version":"2.0"},)" + more + R"("scenes":[{"nodes":[0]}],"nodes":[)" + nodes +
         R"(],"meshes":[{"name":"Mesh","primitives":[)" + primitives +
         R"(]}],"materials":[{"name":"Brick"},{"name":"Glass"}],"accessors":[{"bufferView":0,"componentType":5126,)"
         R"("type":"VEC3","count":4,"min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":48}],)"
         R"("images":[{"uri":"missing.png"}],)"
         R"("buffers":[{"byteLength":48,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAA"}]})";
}

const std::string strip = R"({"attributes":{"POSITION":0},"mode":5})";

TEST_F(ModelReader, PlacesGltfNodesAndTurnsThemUp)
{
  const auto found = measuresOf(
      readText("a.gltf", gltf(R"({"name":"Site","children":[1,2,3],"translation":[0,10,0]},{"name":"Wall","mesh":0},)"
                              R"({"mesh":0,"scale":[-2,1,1]},{"name":"Wall","mesh":0,"translation":[0,0,5]})",
                              strip)));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found.at("Wall").area, 1.0);
  EXPECT_EQ(found.at("Wall_2").area, 1.0);
  EXPECT_EQ(found.at("Mesh").area, 2.0);
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  EXPECT_THAT(bounds, ElementsAre(-2, 1, -5, 0, 10, 11));
  // All look along the file's z, which is -y here; the mirrored one too, as glTF turns its triangles over.
  vtkPolyData* data = reader->GetOutput();
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> cell;
    data->GetCellPoints(i, cell);
    Vec3 p[3];
    for (int k = 0; k < 3; ++k)
    {
      data->GetPoint(cell->GetId(k), p[k].data());
    }
    EXPECT_LT((p[1] - p[0]).cross(p[2] - p[0]).y(), 0.0) << "triangle " << i;
  }
}

TEST_F(ModelReader, TellsPrimitivesOfANodeApartByMaterial)
{
  const std::string of = R"({"attributes":{"POSITION":0},"material":)";
  readText("a.gltf",
           gltf(R"({"name":"Wall","mesh":0})", of + "0,\"mode\":5}," + of + "1,\"mode\":6}," + of + "0,\"mode\":1}"));
  EXPECT_THAT(namesOf(reader->GetOutput()), ElementsAre("Wall_Brick", "Wall_Glass"));
  EXPECT_EQ(measuresOf(reader->GetOutput()).at("Wall_Glass").material, "Glass");
  EXPECT_THAT(warnings(), ElementsAre(HasSubstr("1 sets of lines")));
}

TEST_F(ModelReader, TakesUnitsAxesAndWhatMakesASurfaceAsTheVRMLReaderDoes)
{
  const SampleModel house = atria::testing::sampleHouse();
  const fs::path stl = scratch.path() / "house.stl";
  const fs::path glb = scratch.path() / "house.glb";
  atria::testing::writersWithNames().at("stl")(house, stl);
  atria::testing::writersWithNames().at("glb")(house, glb);
  double bounds[6];
  reader->SetLengthUnit(vtkAtriaModelReader::Feet);
  reader->SetUpAxis(vtkAtriaModelReader::YUp);
  read(stl)->GetBounds(bounds);
  EXPECT_THAT(bounds,
              ::testing::Pointwise(::testing::DoubleNear(1e-12), {0.0, 8 * 0.3048, -6 * 0.3048, 0.0, 0.0, 6 * 0.3048}));
  reader->SetLengthUnit(vtkAtriaModelReader::UnstatedUnit); // which glTF defines
  reader->SetUpAxis(vtkAtriaModelReader::ZUp);
  read(glb)->GetBounds(bounds);
  EXPECT_THAT(bounds, ElementsAre(0, 8, 0, 6, -6, 0));
  reader->SetSurfaceBy(vtkAtriaModelReader::Material);
  EXPECT_EQ(namesOf(read(glb)).size(), 3u);
  reader->SetSurfaceBy(vtkAtriaModelReader::Connected);
  EXPECT_EQ(namesOf(read(glb)).size(), 7u); // two planes of the roof
  reader->SetSurfaceBy(vtkAtriaModelReader::Group);
  readText("a.obj", square + "g Wall\nusemtl Brick\nf 1 2 3\nusemtl Glass\nf 1 3 4\ng Roof\nf 1 2 4\n");
  EXPECT_THAT(namesOf(reader->GetOutput()), ElementsAre("Wall", "Roof"));
}

TEST_F(ModelReader, MergesFacesThatCoincideHoweverTheyAreCut)
{
  reader->MergeDuplicateFacesOn();
  readText("a.obj", square + "g Front\nf 1 2 3 4\ng Back\nf 3 2 1 4\n");
  EXPECT_THAT(namesOf(reader->GetOutput()), ElementsAre("Front"));
  EXPECT_EQ(reader->GetNumberOfMergedFaces(), 1);
}

TEST_F(ModelReader, RefusesWhatIsNoModelAndNamesTheFile)
{
  reader->SetFileName((scratch.path() / "absent.obj").c_str());
  reader->Update();
  EXPECT_THAT(messages.takeErrors().front(), AllOf(HasSubstr("absent.obj"), HasSubstr("does not exist")));
  EXPECT_THAT(errorOf("model.xyz", "0\nSECTION\n"), AllOf(HasSubstr("model.xyz"), HasSubstr(".obj .stl .ply")));
  EXPECT_THAT(errorOf("model.DWG", "AC1032"), AllOf(HasSubstr("model.DWG"), HasSubstr("export it there as DXF")));
  EXPECT_THAT(errorOf("a.stl", ""), HasSubstr("a.stl' holds no surfaces: it is empty"));
  EXPECT_THAT(errorOf("a.obj", "v 1 2\nf 1 1 1\n"),
              AllOf(HasSubstr("a.obj"), HasSubstr("line 1"), HasSubstr("export")));
  EXPECT_THAT(errorOf("a.obj", "v 1 2 nan\n"), HasSubstr("line 1"));
  EXPECT_THAT(errorOf("a.obj", square), AllOf(HasSubstr("a.obj"), HasSubstr("no surfaces")));
  EXPECT_THAT(errorOf("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
              AllOf(HasSubstr("a.stl"), HasSubstr("line 4")));
  EXPECT_THAT(errorOf("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                               "property float z\nend_header\n0 0 0\n"),
              AllOf(HasSubstr("a.ply"), HasSubstr("cloud of points")));
  EXPECT_THAT(errorOf("a.ply", "playing\n"), HasSubstr("no PLY"));
  EXPECT_THAT(errorOf("a.gltf", "{\"asset\":"), AllOf(HasSubstr("a.gltf"), HasSubstr("export it again")));
  EXPECT_THAT(errorOf("a.glb", "glTF"), HasSubstr("a.glb"));
  EXPECT_THAT(errorOf("a.gltf", gltf(R"({"mesh":0})", strip, R"("extensionsUsed":["KHR_draco_mesh_compression"],)")),
              AllOf(HasSubstr("draco"), HasSubstr("without compression")));
  EXPECT_THAT(errorOf("a.vtp", "<VTKFile"), HasSubstr("a.vtp"));
}

} // namespace
