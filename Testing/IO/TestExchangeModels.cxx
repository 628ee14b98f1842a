// SPDX-License-Identifier: GPL-3.0-or-later
/// What the formats have of their own that architects' programs exchange: units, axes, trees of names, damage.
/// TestModelReader compares one house in all of them. ATRIA_MUTATIONS sets the number of damaged copies of each file.
#include "ExchangeModels.h"
#include "SurfacePromises.h"

#include "Support/Watchdog.h"

#include <vtkMassProperties.h>

#include <gmock/gmock.h>

#include <cstdlib>
#include <random>

#include <sys/resource.h>

namespace {

using atria::testing::ExchangeModels;
using atria::testing::houseAs;
using atria::testing::replaced;
using atria::testing::sample;
using atria::testing::writeFile;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

/// CityJSON of one square of two units for each boundary: `"0": [[0,1,2,3]]` of a MultiSurface and the like.
std::string city(const std::string& objects, const std::string& more = "")
{
  return R"({"type":"CityJSON","version":"2.0",)" + more +
         R"("transform":{"scale":[0.001,0.001,0.001],"translate":[100,200,0]},"CityObjects":{)" + objects +
         R"(},"vertices":[[0,0,0],[4000,0,0],[4000,4000,0],[0,4000,0],[1000,1000,0],[2000,1000,0],[2000,2000,0],)"
         R"([1000,2000,0],[0,0,3000],[4000,0,3000]]})";
}

const std::string square = R"("boundaries":[[[0,1,2,3]]])";

std::string object(const std::string& id, const std::string& geometry, const std::string& more = "")
{
  return "\"" + id + R"(":{"type":"Building",)" + more + R"("geometry":[)" + geometry + "]}";
}

std::string surface(const std::string& lod, const std::string& rest)
{
  return R"({"type":"MultiSurface","lod":")" + lod + "\"," + rest + "}";
}

TEST_F(ExchangeModels, CityJsonCallsSurfacesBySemanticsAndObjects)
{
  const std::string wallAndRoof = surface(
      "2", R"("boundaries":[[[0,1,9,8]],[[0,1,2,3]],[[1,2,9]]],"semantics":{"surfaces":[{"type":"WallSurface"},)"
           R"({"type":"RoofSurface"}],"values":[0,1,null]})");
  read("a.city.json", city(object("House", wallAndRoof) + "," + object("Hall", wallAndRoof)));
  EXPECT_EQ(error(), "");
  EXPECT_EQ(warned, "");
  EXPECT_THAT(names(), UnorderedElementsAre("House/WallSurface", "House/RoofSurface", "House", "Hall/WallSurface",
                                            "Hall/RoofSurface", "Hall"));
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  EXPECT_THAT(bounds, ElementsAre(100, 104, 200, 204, 0, 3));
  reader->SetSurfaceByToMaterial();
  read("a.city.json", city(object("House", wallAndRoof) + "," + object("Hall", wallAndRoof)));
  EXPECT_THAT(names(), UnorderedElementsAre("WallSurface", "RoofSurface", "Building"));
  reader->SetSurfaceByToGroup();
  read("a.city.json", city(object("House", wallAndRoof) + "," + object("Hall", wallAndRoof)));
  EXPECT_THAT(names(), UnorderedElementsAre("House", "Hall"));
}

TEST_F(ExchangeModels, TellWhatIsGround)
{
  const auto grounds = [&] {
    std::vector<std::string> found;
    vtkDataArray* isGround = reader->GetOutput()->GetFieldData()->GetArray("IsGround");
    for (std::size_t i = 0; isGround && i < names().size(); ++i)
    {
      if (isGround->GetComponent(static_cast<vtkIdType>(i), 0) != 0.0)
      {
        found.push_back(names()[i]);
      }
    }
    return found;
  };
  const std::string house = object("House", surface("2", square));
  read("a.json", city(house));
  EXPECT_FALSE(reader->GetOutput()->GetFieldData()->HasArray("IsGround"));
  const std::string road =
      surface("2", R"("boundaries":[[[0,1,2,3]],[[4,5,6,7]]],"semantics":{"surfaces":[{"type":"TrafficArea"}],)"
                   R"("values":[0,null]})");
  read("a.json", city(house + "," + replaced(object("Street", road), "Building", "Road") + "," +
                      replaced(object("Lawn", surface("1", square)), "Building", "LandUse") + "," +
                      replaced(object("Wood", surface("1", square)), "Building", "PlantCover")));
  EXPECT_THAT(grounds(), UnorderedElementsAre("TrafficArea", "Street", "Lawn")) << ::testing::PrintToString(names());
  read("a.ifc", atria::testing::bytesOf(atria::testing::dataFolder() / "Ground" / "ifc-site-is-a-block.ifc"));
  EXPECT_THAT(grounds(), ElementsAre("IfcSite_Ground")) << ::testing::PrintToString(names());
}

TEST_F(ExchangeModels, CityJsonSurfacesHaveHoles)
{
  read("a.json", city(object("House", surface("2", R"("boundaries":[[[0,1,2,3],[4,7,6,5]]])"))));
  EXPECT_EQ(error(), "");
  vtkNew<vtkMassProperties> measured;
  measured->SetInputData(reader->GetOutput());
  measured->Update();
  EXPECT_NEAR(measured->GetSurfaceArea(), 15.0, 1e-9);
}

TEST_F(ExchangeModels, CityJsonTakesTheHighestLevelOfDetail)
{
  const std::string low = surface("1.2", R"("boundaries":[[[0,1,2]]])");
  read("a.json", city(object("House", low + "," + surface("2.2", square))));
  EXPECT_EQ(triangles(), 2);
  EXPECT_EQ(reader->GetNotes()->GetValue(0), "1 geometries are left out for those of a higher level of detail");
  // A part that is finer stands for the whole; one that is not stands beside it.
  const std::string part = R"("parents":["House"],)";
  const std::string whole = R"("children":["Part"],)";
  read("a.json", city(object("House", low, whole) + "," + object("Part", surface("2.2", square), part)));
  EXPECT_THAT(names(), ElementsAre("Part"));
  read("a.json", city(object("House", surface("2.2", square), whole) + "," + object("Part", low, part)));
  EXPECT_THAT(names(), UnorderedElementsAre("House", "Part"));
}

TEST_F(ExchangeModels, CityJsonReadsSolidsTemplatesAndSequences)
{
  read("a.json", city(object("House", R"({"type":"Solid","lod":"1","boundaries":[[[[0,1,2,3]],[[0,1,9,8]]]],)"
                                      R"("semantics":{"surfaces":[{"type":"GroundSurface"}],"values":[[0,null]]}})")));
  EXPECT_THAT(names(), UnorderedElementsAre("GroundSurface", "House"));
  const std::string tree = R"({"type":"GeometryInstance","template":0,"boundaries":[2],)"
                           R"("transformationMatrix":[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]})";
  const std::string templates = R"("geometry-templates":{"templates":[)" + surface("1", R"("boundaries":[[[0,1,2]]])") +
                                R"(],"vertices-templates":[[0,0,0],[1,0,0],[0,0,1]]},)";
  read("a.json", city(object("Tree", tree), templates));
  EXPECT_EQ(error(), "");
  double bounds[6];
  reader->GetOutput()->GetBounds(bounds);
  EXPECT_THAT(bounds, ElementsAre(104, 106, 204, 204, 0, 2));
  read("a.json",
       city(object("Tree", replaced(tree, "[2]", "[99]")) + "," + object("House", surface("1", square)), templates));
  EXPECT_THAT(warned, HasSubstr("an instance in 'Tree' is left out"));
  EXPECT_EQ(triangles(), 2);
  const std::string feature =
      R"({"type":"CityJSONFeature","id":"A","CityObjects":{"A":{"type":"Building","geometry":[)" +
      surface("1", R"("boundaries":[[[0,1,2]]])") + R"(]}},"vertices":[[0,0,0],[1000,0,0],[1000,1000,0]]})";
  read("a.city.jsonl",
       city("") + "\n" + feature + "\n\n" + replaced(replaced(feature, "\"A\":", "\"B\":"), "[0,0,0]", "[0,0,9]"));
  EXPECT_THAT(names(), UnorderedElementsAre("A", "B"));
  EXPECT_EQ(reader->GetOutput()->GetBounds()[0], 100.0);
}

TEST_F(ExchangeModels, CityJsonSaysWhatIsWrong)
{
  read("a.json", city(object("House", surface("1", R"("boundaries":[[[0,1,2,3]],[[0,1,99]],[[0,1,"x"]],7])"))));
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(warned, AllOf(HasSubstr("a.json"), HasSubstr("3 surfaces are left out")));
  const std::string whole = city(object("House", surface("1", square)));
  read("a.json", whole.substr(0, whole.size() - 1));
  EXPECT_THAT(error(), AllOf(HasSubstr("a.json"), HasSubstr("its JSON is damaged: parse error at line 1, column")));
  read("a.jsonl", whole + "\n" + whole.substr(0, whole.size() - 1));
  EXPECT_THAT(error(), AllOf(HasSubstr("a.jsonl"), HasSubstr("line 2: its JSON is damaged")));
  read("a.json", R"({"type":"FeatureCollection"})");
  EXPECT_THAT(error(), AllOf(HasSubstr("a.json"), HasSubstr("is no CityJSON")));
  read("a.json", city("", R"("metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/4979"},)"));
  EXPECT_THAT(error(), HasSubstr("degrees"));
  read("a.json",
       city(R"("a":{"type":"Building","parents":["b"],"children":["b"]},"b":{"type":"Building","parents":["a"],)"
            R"("children":["a"],"geometry":[)" +
            surface("1", square) + "]}"));
  EXPECT_EQ(triangles(), 2) << "parents in a circle";
}

TEST_F(ExchangeModels, CityJsonOfANewerVersionIsReadWithAWarning)
{
  for (const char* known : {"1.0", "1.1", "2.0"})
  {
    read("a.json", replaced(city(object("House", surface("1", square))), R"("version":"2.0")",
                            R"("version":")" + std::string(known) + '"'));
    EXPECT_EQ(warned, "") << known;
  }
  read("a.json", replaced(city(object("House", surface("1", square))), R"("version":"2.0")", R"("version":"3.1")"));
  EXPECT_THAT(warned, HasSubstr("its version of CityJSON is 3.1, and 1 and 2 are known"));
  EXPECT_EQ(triangles(), 2);
}

TEST_F(ExchangeModels, CityJsonNamesSolidsThatAreNotClosed)
{
  const std::string whole = R"([[0,3,2,1]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]],[[4,5,6,7]])";
  const auto solid = [](const std::string& type, const std::string& boundaries) {
    return R"({"type":")" + type + R"(","lod":"2","boundaries":)" + boundaries + "}";
  };
  const auto read2 = [&](const std::string& objects) {
    read("a.json", R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1],"translate":[0,0,0]},)"
                   R"("CityObjects":{)" +
                       objects +
                       R"(},"vertices":[[0,0,0],[4,0,0],[4,4,0],[0,4,0],[0,0,3],[4,0,3],[4,4,3],[0,4,3],[2,0,0]]})");
  };
  read2(object("House", solid("Solid", "[[" + whole + "]]")) + "," +
        object("Hall", solid("MultiSolid", "[[[" + whole + "]]]")));
  EXPECT_EQ(warned, "");
  // Two edges along one of a neighbor close it as well.
  read2(object("House", solid("Solid", "[[" + replaced(whole, "[[0,1,5,4]]", "[[0,8,1,5,4]]") + "]]")));
  EXPECT_EQ(warned, "");
  const std::string open = replaced(whole, "[[3,0,4,7]],", "");
  read2(object("House", solid("Solid", "[[" + open + "]]")) + "," +
        object("Hall", solid("CompositeSolid", "[[[" + open + "]]]")) + "," +
        object("Shed", solid("MultiSurface", "[" + open + "]")));
  EXPECT_THAT(warned, AllOf(HasSubstr("2 city objects are not closed"), HasSubstr("Hall, House")));
  EXPECT_THAT(warned, Not(HasSubstr("Shed"))) << "which need not be closed";
}

TEST_F(ExchangeModels, GltfPrimitivesThatSharePointsTakeWhatTheyUse)
{
  constexpr int parts = 500;
  constexpr int corners = 90; // of each
  std::string nodes;
  std::string list;
  std::string meshes;
  std::string accessors = R"({"bufferView":0,"componentType":5126,"count":45000,"type":"VEC3"})";
  std::string bytes;
  const auto add = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  for (int i = 0; i < parts * corners; ++i)
  {
    add(static_cast<float>(i / 3));
    add(static_cast<float>(i % 3 == 1 ? 1 : 0));
    add(static_cast<float>(i % 3 == 2 ? 1 : 0));
  }
  for (int i = 0; i < parts * corners; ++i)
  {
    add(static_cast<std::uint32_t>(i));
  }
  for (int i = 0; i < parts; ++i)
  {
    const std::string n = std::to_string(i);
    const std::string comma = i == 0 ? "" : ",";
    list += comma + n;
    nodes += comma + R"({"mesh":)" + n + R"(,"name":"N)" + n + R"(","translation":[0,)" + n + ",0]}";
    meshes += comma + R"({"primitives":[{"attributes":{"POSITION":0},"indices":)" + std::to_string(i + 1) + "}]}";
    accessors += R"(,{"bufferView":1,"byteOffset":)" + std::to_string(4 * corners * i) +
                 R"(,"componentType":5125,"count":90,"type":"SCALAR"})";
  }
  writeFile(scratch.path(), "a.bin", bytes);
  rusage before{};
  getrusage(RUSAGE_SELF, &before);
  read("a.gltf", R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[)" + list + R"(]}],"nodes":[)" + nodes +
                     R"(],"meshes":[)" + meshes + R"(],"accessors":[)" + accessors +
                     R"(],"bufferViews":[{"buffer":0,"byteLength":540000},{"buffer":0,"byteOffset":540000,)" +
                     R"("byteLength":180000}],"buffers":[{"uri":"a.bin","byteLength":720000}]})");
  rusage after{};
  getrusage(RUSAGE_SELF, &after);
  EXPECT_EQ(error(), "");
  EXPECT_EQ(triangles(), parts * corners / 3);
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPoints(), parts * corners);
  EXPECT_NEAR(area(), 0.5 * parts * corners / 3, 1e-6);
  EXPECT_EQ(reader->GetOutput()->GetBounds()[5], parts - 1 + 1.0) << "each at the place of its node";
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 200'000) << "kilobytes; points of all times primitives were 1 GB";
}

#ifdef ATRIA_WITH_ASSIMP

TEST_F(ExchangeModels, ColladaPolygonsHaveHoles)
{
  read("a.dae", sample("dae-polygon-with-hole.dae"));
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()["WallWithWindow"], 26.129, 1e-3);
  EXPECT_NEAR(areas()["SecondWall"], 26.129, 1e-3);
  // Two holes, corners of two numbers, and a polygon without holes beside it.
  const std::string input = R"(<input semantic="VERTEX" source="#v" offset="0"/>)";
  std::string two =
      replaced(sample("dae-polygon-with-hole.dae"), input, R"(<input semantic="VERTEX" source="#v" offset="1"/>)");
  two = replaced(two, "<p>0 1 2 3</p><h>4 7 6 5</h>", "<p>9 0 9 1 9 2 9 3</p><h>9 4 9 7 9 6</h><h>9 4 9 6 9 5</h>");
  two = replaced(two, "<ph>", "<p>9 4 9 5 9 6</p><ph>");
  two = replaced(two, "<polygons count=\"1\"", "<polygons count=\"2\"");
  read("a.dae", two);
  EXPECT_EQ(error(), "");
  EXPECT_NEAR(areas()["SecondWall"], 26.129 + 0.5 * 3.871, 1e-3);
}

TEST_F(ExchangeModels, UnitsAndAxesOfTheFileAreHonored)
{
  for (const char* ending : {"dae", "fbx", "dxf", "3ds"})
  {
    read("house." + std::string(ending), houseAs(ending));
    EXPECT_EQ(warned, "") << ending;
    EXPECT_DOUBLE_EQ(height(), 6.0) << ending;
  }
  read("house.dae", replaced(houseAs("dae"), "meter=\"0.5\"", "meter=\"0.0254\""));
  EXPECT_NEAR(height(), 6.0 * 0.0508, 1e-6);
  read("house.fbx", replaced(houseAs("fbx"), "\"\",100", "\"\",2.54"));
  EXPECT_NEAR(height(), 6.0 * 0.0254, 1e-6);
  read("house.dxf", replaced(houseAs("dxf"), "70\n6\n", "70\n4\n"));
  EXPECT_NEAR(height(), 0.006, 1e-8);
  read("house.dae", replaced(houseAs("dae"), "Y_UP", "Z_UP"));
  EXPECT_DOUBLE_EQ(height(), 6.0) << "which is its width now";
  EXPECT_DOUBLE_EQ(reader->GetOutput()->GetBounds()[3], 6.0);
  EXPECT_DOUBLE_EQ(reader->GetOutput()->GetBounds()[4], -6.0);
  reader->SetUpAxisToY();
  read("house.dae", replaced(houseAs("dae"), "Y_UP", "Z_UP"));
  EXPECT_DOUBLE_EQ(reader->GetOutput()->GetBounds()[4], 0.0) << "what is stated wins";
}

TEST_F(ExchangeModels, AUnitThatIsStatedTwiceCountsOnce)
{
  reader->SetLengthUnitToInches();
  read("house.dae", houseAs("dae"));
  EXPECT_DOUBLE_EQ(height(), 6.0);
  EXPECT_THAT(warned, AllOf(HasSubstr("house.dae"), HasSubstr("states its unit itself")));
  read("house.3ds", houseAs("3ds"));
  EXPECT_NEAR(height(), 6.0 * 0.0254, 1e-12) << "3DS states none";
  reader->SetLengthUnitToUnstated();
  reader->SetScale(2.0);
  read("house.dae", houseAs("dae"));
  EXPECT_DOUBLE_EQ(height(), 12.0);
}

TEST_F(ExchangeModels, SinglePrecisionIsToldWhereItMatters)
{
  std::string far = houseAs("dae");
  for (std::size_t at = far.find("name=\""); at != far.npos; at = far.find("name=\"", at + 1))
  {
    if (const std::size_t end = far.find("\"><instance_geometry", at); end != far.npos && end < at + 20)
    {
      far.insert(end + 2, "<translate>2000000 0 0</translate>");
    }
  }
  read("house.dae", far);
  EXPECT_GT(reader->GetOutput()->GetBounds()[0], 999999.0);
  EXPECT_THAT(warned, AllOf(HasSubstr("house.dae"), HasSubstr("single precision")));
}

/// One change to some bytes.
void damage(std::string& bytes, std::mt19937& random)
{
  const auto below = [&](std::size_t limit) { return random() % std::max<std::size_t>(limit, 1); };
  const std::size_t at = below(bytes.size());
  switch (random() % 4)
  {
    case 0:
      bytes[at] = static_cast<char>(random());
      break;
    case 1:
      bytes.erase(at, below(40));
      break;
    case 2:
      bytes.insert(at, bytes.substr(at, below(200)));
      break;
    default:
      bytes.insert(at, random() % 2 == 0 ? "99999999999" : "(");
  }
}

class DamagedExchange : public ExchangeModels, public ::testing::WithParamInterface<std::string>
{
};

/// Assimp crashes on nearly every second damaged IFC file.
TEST_P(DamagedExchange, EndsWithWhatCanBeReadOrAnErrorThatNamesTheFile)
{
  const std::string whole = houseAs(GetParam());
  const char* wanted = std::getenv("ATRIA_MUTATIONS");
  const int copies = wanted ? std::atoi(wanted) : 40;
  std::mt19937 random(7);
  for (int i = 0; i < copies; ++i)
  {
    SCOPED_TRACE("copy " + std::to_string(i));
    std::string bytes = whole;
    for (unsigned times = 1 + random() % 4; times > 0; --times)
    {
      damage(bytes, random);
    }
    const atria::testing::Watchdog watchdog(GetParam() + ", copy " + std::to_string(i), std::chrono::seconds(120));
    this->read("damaged." + GetParam(), bytes);
    EXPECT_EQ(errors.empty(), triangles() > 0);
    EXPECT_EQ(errors.empty() ? atria::testing::brokenPromise(reader->GetOutput()) : "", "");
    if (!errors.empty())
    {
      EXPECT_THAT(error(), HasSubstr("damaged."));
    }
    if (HasFailure())
    {
      writeFile(".", "failed." + GetParam(), bytes);
      return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedExchange, ::testing::Values("dae", "3ds", "fbx", "dxf", "ifc"));

#else

TEST_F(ExchangeModels, SaysWhatIsMissing)
{
  read("house.dae", houseAs("dae"));
  EXPECT_THAT(error(), AllOf(HasSubstr("house.dae"), HasSubstr("atria-assimp")));
}

#endif

} // namespace
