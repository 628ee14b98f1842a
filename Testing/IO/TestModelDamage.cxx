// SPDX-License-Identifier: GPL-3.0-or-later
/// Damaged models in other formats than VRML: the reader gives what can be read, or says what is wrong.
/// ATRIA_MUTATIONS sets the number of damaged copies of each file (default 300).
#include "ModelSamples.h"
#include "SurfacePromises.h"
#include "VRMLModel.h"
#include "vtkAtriaModelReader.h"

#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"
#include "Support/Watchdog.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>

namespace {

namespace fs = std::filesystem;
using atria::testing::bytesOf;
using atria::testing::writeFile;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// The house in one format, by the ending of the file; formats that TestModelReader does not write, too.
std::string sampleOf(const std::string& format, const fs::path& folder)
{
  const auto house = atria::testing::sampleHouse();
  const fs::path file = folder / ("house." + format);
  const auto& writers = atria::testing::writersWithNames();
  format == "binary.stl" ? atria::testing::writeBinaryStl(house, file)
  : format == "ply"      ? atria::testing::writePly(house, file)
                         : writers.at(format)(house, file);
  return bytesOf(file);
}

template <typename T> void append(std::string& bytes, T value)
{
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  bytes.append(raw, sizeof(T));
}

/// A tetrahedron as PLY, little endian, with a property and an element that are of no use.
std::string binaryPly()
{
  std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment none\nelement vertex 4\nproperty double x\n"
                      "property double y\nproperty double z\nproperty uchar red\nelement edge 1\nproperty int a\n"
                      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& p : {std::array{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}, {0.0, 3.0, 0.0}, {0.0, 0.0, 3.0}})
  {
    append(bytes, p);
    bytes.push_back('\xff');
  }
  append(bytes, 7);
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
  {
    bytes.push_back('\3');
    append(bytes, face);
  }
  return bytes;
}

/// The house as VTK's XML polydata, its numbers as text, in base64, behind the rest in base64, or raw there.
std::string xmlHouse(const std::string& mode, const fs::path& folder)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  const fs::path file = folder / "house.vtp";
  atria::testing::writersWithNames().at("vtp")(atria::testing::sampleHouse(), file);
  reader->SetFileName(file.c_str());
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(reader->GetOutputPort());
  writer->SetFileName(file.c_str());
  reader->Update();
  writer->SetDataMode(mode == "text"     ? vtkXMLWriter::Ascii
                      : mode == "inline" ? vtkXMLWriter::Binary
                                         : vtkXMLWriter::Appended);
  writer->SetEncodeAppendedData(mode != "raw");
  writer->SetCompressorType(mode == "raw" ? vtkXMLWriter::NONE : vtkXMLWriter::ZLIB);
  writer->SetHeaderType(mode == "raw" ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  writer->SetByteOrder(mode == "inline" ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
  writer->Write();
  return bytesOf(file);
}

class ModelDamage : public atria::testing::VtkTest
{
protected:
  void read(const std::string& name, const std::string& bytes)
  {
    const fs::path file = writeFile(scratch.path(), name, bytes);
    reader->SetFileName(file.c_str());
    reader->SetLengthUnit(vtkAtriaModelReader::Meters);
    reader->Modified();
    reader->Update();
    warned = messages.takeWarnings();
    errors = messages.takeErrors();
  }
  vtkIdType triangles() const { return reader->GetOutput()->GetNumberOfCells(); }
  std::string firstWarning() const
  {
    return reader->GetWarnings()->GetNumberOfValues() > 0 ? reader->GetWarnings()->GetValue(0) : "";
  }
  std::string firstError() const { return errors.empty() ? "" : errors.front(); }

  /// What is wrong with the output; empty if it is what the reader promises.
  std::string brokenPromise() const
  {
    if (errors.empty() != (triangles() > 0))
    {
      return "an error and surfaces, or neither";
    }
    return errors.empty() ? atria::testing::brokenPromise(reader->GetOutput()) : "";
  }

  atria::testing::ScratchFolder scratch;
  vtkNew<vtkAtriaModelReader> reader;
  std::vector<std::string> warned;
  std::vector<std::string> errors;
};

class DamagedFormat : public ModelDamage, public ::testing::WithParamInterface<std::string>
{
};

/// One change to some bytes.
void damage(std::string& bytes, std::mt19937& random)
{
  static const std::vector<std::string> pieces{"-1", "nan", "1e999", "99999999999", "0",  "\xff\xff\xff\xff", "\n",
                                               "{",  "}",   "[",     "\"",          " 4", "-2147483648",      "e"};
  const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : random() % limit; };
  const std::size_t at = below(bytes.size());
  const std::size_t length = std::min(below(40), bytes.size() - at);
  switch (random() % 7)
  {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      break;
    case 1:
      bytes[at] = static_cast<char>(random());
      break;
    case 2:
      bytes.erase(at, length);
      break;
    case 3:
      bytes.replace(at, below(4), pieces[below(pieces.size())]);
      break;
    case 4:
      bytes.insert(below(bytes.size()), bytes.substr(at, length));
      break;
    case 5:
      if (const std::size_t digit = bytes.find_first_of("0123456789", at); digit != bytes.npos)
      {
        bytes[digit] = static_cast<char>('0' + below(10));
      }
      break;
    default:
      bytes.replace(at, length, std::string(length, random() % 2 == 0 ? '\0' : '\xff'));
  }
}

TEST_P(DamagedFormat, EndsWithWhatCanBeReadOrAnErrorThatNamesTheFile)
{
  const std::string whole = GetParam() == "binary.ply" ? binaryPly() : sampleOf(GetParam(), scratch.path());
  const char* wanted = std::getenv("ATRIA_MUTATIONS");
  const int copies = wanted ? std::atoi(wanted) : 300;
  std::mt19937 random(1);
  int read = 0;
  for (int i = 0; i < copies; ++i)
  {
    SCOPED_TRACE("copy " + std::to_string(i));
    std::string bytes = whole;
    if (i % 4 == 0)
    {
      bytes.resize(whole.size() * static_cast<std::size_t>(i) / static_cast<std::size_t>(copies)); // cut off
    }
    for (unsigned times = i % 4 == 0 ? 0 : 1 + random() % 4; times > 0 && !bytes.empty(); --times)
    {
      damage(bytes, random);
    }
    const atria::testing::Watchdog watchdog(GetParam() + ", copy " + std::to_string(i), std::chrono::seconds(60));
    this->read("damaged." + GetParam(), bytes);
    read += triangles() > 0 ? 1 : 0;
    EXPECT_EQ(brokenPromise(), "");
    if (!errors.empty())
    {
      EXPECT_THAT(firstError(), HasSubstr("damaged."));
    }
    if (HasFailure())
    {
      writeFile(".", "failed." + GetParam(), bytes);
      return;
    }
  }
  // Of every hundred. Most changes to glTF hit its JSON, and it is refused; most of a PLY file as small as these is a
  // header.
  static const std::map<std::string, int> least{{"obj", 80},  {"stl", 90}, {"binary.stl", 90}, {"ply", 25},
                                                {"gltf", 10}, {"glb", 20}, {"binary.ply", 8}};
  EXPECT_GE(100 * read, least.at(GetParam()) * copies);
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedFormat,
                         ::testing::Values("obj", "stl", "binary.stl", "ply", "binary.ply", "gltf", "glb"));

/// What the fuzzer found, and what is like it.
TEST_F(ModelDamage, EndsAtWhatWasFoundByFuzzing)
{
  const fs::path folder = atria::testing::dataFolder() / "Models" / "damaged";
  std::error_code none; // as long as there is nothing
  for (const auto& entry : fs::directory_iterator(folder, none))
  {
    SCOPED_TRACE(entry.path().string());
    const atria::testing::Watchdog watchdog(entry.path().string(), std::chrono::seconds(60));
    read(entry.path().filename().string(), bytesOf(entry.path()));
    EXPECT_EQ(brokenPromise(), "");
  }
}

TEST_F(ModelDamage, ReadsThePlyFacesThatAreThere)
{
  const std::string whole = binaryPly();
  read("a.ply", whole);
  EXPECT_EQ(triangles(), 4);
  EXPECT_TRUE(warned.empty());
  read("a.ply", whole.substr(0, whole.size() - 20));
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(firstWarning(), AllOf(HasSubstr("a.ply"), HasSubstr("ends before face 3 of 4")));
  read("a.ply", whole.substr(0, whole.size() - 4 * 13));
  EXPECT_THAT(firstError(), AllOf(HasSubstr("a.ply"), HasSubstr("ends before face 1 of 4")));
}

TEST_F(ModelDamage, DoesNotBelieveTheCountsOfAPlyHeader)
{
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 4000000000\nproperty list uint int vertex_index\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n3 0 -1 2\n4294967295 0 1\n3 0 1 2.5e300\n";
  read("a.ply", text);
  EXPECT_EQ(triangles(), 1);
  const std::string all =
      atria::testing::joined({reader->GetWarnings()->GetValue(0), reader->GetWarnings()->GetValue(1)});
  EXPECT_THAT(all, AllOf(HasSubstr("a line does not hold face 4 of 4000000000"), HasSubstr("3 faces are left out")));
  text.replace(text.find("vertex 3"), 8, "vertex 9999999999999999999999");
  read("a.ply", text);
  EXPECT_THAT(firstError(), AllOf(HasSubstr("a.ply"), HasSubstr("line 3 of its header")));
}

TEST_F(ModelDamage, ReadsPlyOfEitherByteOrderInDoublePrecision)
{
  std::string bytes = "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 3\r\nproperty double x\r\n"
                      "property float64 y\r\nproperty double z\r\nelement face 1\r\n"
                      "property list ushort uint vertex_indices\r\nend_header\r\n";
  const auto add = [&](auto value) {
    std::string raw;
    append(raw, value);
    bytes.append(raw.rbegin(), raw.rend());
  };
  for (const double value : {4500000.123456789, 0.0, 0.0, 4500001.0, 0.0, 0.0, 4500000.0, 1.0, 0.0})
  {
    add(value);
  }
  add(std::uint16_t{3});
  for (const std::uint32_t id : {0u, 1u, 2u})
  {
    add(id);
  }
  read("far.ply", bytes);
  ASSERT_EQ(triangles(), 1);
  EXPECT_EQ(reader->GetOutput()->GetPoint(0)[0], 4500000.123456789);
}

TEST_F(ModelDamage, ReadsTheStlFacetsThatAreThere)
{
  const std::string whole = sampleOf("binary.stl", scratch.path());
  read("a.stl", whole);
  const vtkIdType all = triangles();
  read("a.stl", whole.substr(0, whole.size() - 60));
  EXPECT_EQ(triangles(), all - 2);
  const std::string facets = std::to_string(all);
  EXPECT_THAT(firstWarning(), AllOf(HasSubstr("a.stl"), HasSubstr("states " + facets)));
  std::string text = sampleOf("stl", scratch.path());
  text.insert(text.find("vertex") + 7, "x");
  read("a.stl", text);
  EXPECT_EQ(triangles(), all - 1);
  EXPECT_THAT(firstWarning(), AllOf(HasSubstr("a.stl"), HasSubstr("expected three numbers")));
}

TEST_F(ModelDamage, ReadsTheGltfPartsWhoseBuffersAreThere)
{
  const std::string whole = sampleOf("glb", scratch.path());
  read("a.glb", whole);
  const vtkIdType all = triangles();
  read("a.glb", whole.substr(0, whole.size() - 8));
  EXPECT_LT(triangles(), all);
  EXPECT_GT(triangles(), 0);
  EXPECT_THAT(firstWarning(), AllOf(HasSubstr("a.glb"), HasSubstr("'Floor'"), HasSubstr("too short")));
  std::string json = sampleOf("gltf", scratch.path());
  json.replace(json.find("house.bin"), 9, "other.bin");
  read("a.gltf", json);
  EXPECT_THAT(firstError(), AllOf(HasSubstr("a.gltf"), HasSubstr("other.bin"), HasSubstr("does not exist")));
}

/// A glTF file of one primitive with indices of 16 bits: 0 1 2, 2 1 9.
std::string indexedGltf(const std::string& accessor = R"("count":6)")
{
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"N"}],)"
         R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},)"
         R"({"bufferView":1,"componentType":5123,"type":"SCALAR",)" +
         accessor +
         R"(}],"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
         R"("buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)"
         R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAABAAIAAgABAAkA"}]})";
}

TEST_F(ModelDamage, LeavesOutGltfTrianglesWithCornersThatDoNotExist)
{
  read("a.gltf", indexedGltf());
  EXPECT_EQ(triangles(), 1);
  EXPECT_THAT(firstWarning(), HasSubstr("1 triangles are left out"));
  for (const char* wrong : {"\"count\":7", "\"count\":18446744073709551615", "\"count\":-1",
                            "\"count\":6,\"byteOffset\":2", "\"count\":6,\"byteOffset\":18446744073709551614"})
  {
    read("a.gltf", indexedGltf(wrong));
    EXPECT_THAT(firstError(), HasSubstr("a.gltf")) << wrong;
  }
  read("a.gltf", R"({"a":)" + std::string(100000, '[') + std::string(100000, ']') + "}");
  EXPECT_THAT(firstError(), HasSubstr("a.gltf"));
}

/// Two nodes of one mesh each, of one triangle each.
std::string twoNodes()
{
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":[{"name":"Left","mesh":0},)"
         R"({"name":"Right","mesh":1,"translation":[5,0,0]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},)"
         R"({"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,)"
         R"("type":"VEC3","count":3}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
         R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

TEST_F(ModelDamage, SaysWhereTheJsonOfAGltfFileIsDamaged)
{
  const std::string whole = twoNodes();
  for (const auto& [old, now] : std::vector<std::pair<std::string, std::string>>{{"\"Left\"", "Left\""},
                                                                                 {"\"mesh\":0},", "\"mesh\":0}"},
                                                                                 {"\"mesh\":0},", "\"mesh\":0,"},
                                                                                 {"[0,1]", "[0,1"},
                                                                                 {"\"mesh\":0", "\"mesh\" 0"},
                                                                                 {"\"buffers\"", "}\"buffers\""}})
  {
    std::string json = whole;
    const std::size_t at = whole.find(old);
    json.replace(at, old.size(), now);
    SCOPED_TRACE(json.insert(at, "\n"));
    read("a.gltf", json);
    EXPECT_EQ(triangles(), 0);
    EXPECT_THAT(firstError(),
                AllOf(HasSubstr("a.gltf"), HasSubstr("its JSON is damaged: parse error at line 2, column"),
                      HasSubstr("export it again")));
    EXPECT_LT(firstError().size(), 1000U);
  }
  // The fault is found at the end of a text of 60,000 bytes, which the message does not repeat.
  std::string open = whole.substr(0, whole.size() - 4);
  read("a.gltf", open + std::string(60000, 'A'));
  EXPECT_THAT(firstError(), HasSubstr("missing closing quote"));
  EXPECT_LT(firstError().size(), 1000U);
}

TEST_F(ModelDamage, RefusesBinaryGltfWhoseJsonHasAnotherLengthThanStated)
{
  const std::string whole = sampleOf("glb", scratch.path());
  for (const int off : {-4, 4, 8, 100000})
  {
    std::string bytes = whole;
    std::uint32_t size = 0;
    std::memcpy(&size, &bytes[12], 4);
    size += static_cast<std::uint32_t>(off);
    std::memcpy(&bytes[12], &size, 4);
    read("a.glb", bytes);
    EXPECT_EQ(triangles(), 0) << off;
    EXPECT_THAT(firstError(), HasSubstr("a.glb")) << off;
  }
}

TEST_F(ModelDamage, TakesGltfNamesThatAreNoUtf8AsLatin1)
{
  std::string json = twoNodes();
  json.replace(json.find("Left"), 4,
               "Fa\xe7"
               "ade \\u00e9");
  read("a.gltf", json);
  EXPECT_EQ(triangles(), 2);
  EXPECT_EQ(firstWarning(), "");
  auto* names = vtkStringArray::SafeDownCast(reader->GetOutput()->GetFieldData()->GetAbstractArray("SurfaceName"));
  EXPECT_EQ(names->GetValue(0), "Fa\xc3\xa7"
                                "ade \xc3\xa9");
}

TEST_F(ModelDamage, ReadsGltfNodesThatAreNoTreeOnce)
{
  std::string json = twoNodes();
  json.replace(json.find("\"mesh\":0}"), 9, "\"mesh\":0,\"children\":[1,null,0]}");
  read("a.gltf", json);
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(atria::testing::joined(warned), AllOf(HasSubstr("an entry of 'children'"), HasSubstr("several parents")));
  json = twoNodes();
  json.replace(json.find("\"scenes\""), 8, "\"s\"");
  read("a.gltf", json);
  EXPECT_EQ(triangles(), 2);
  EXPECT_THAT(firstWarning(), HasSubstr("it has no scene"));
}

TEST_F(ModelDamage, LeavesOutObjFacesWithDamagedVertices)
{
  read("a.obj", "v 0 0 0\nv 1 0 x\nv 1 1 0\nv 0 1 1e-400\nv 0 2 1e999\nf 1 3 4\nf 1 2 3\nf 3 4 5\n");
  EXPECT_EQ(triangles(), 1);
  EXPECT_EQ(reader->GetOutput()->GetBounds()[3], 1.0);
  EXPECT_THAT(atria::testing::joined(warned),
              AllOf(HasSubstr("line 2: expected three numbers"), HasSubstr("and 1 more like it"),
                    HasSubstr("2 faces are left out")));
}

class XmlMode : public ModelDamage, public ::testing::WithParamInterface<std::string>
{
};

/// VTK asks for as much memory as a file states, or reads on for hours.
TEST_P(XmlMode, DoesNotBelieveTheSizesOfXmlFiles)
{
  const std::string whole = xmlHouse(GetParam(), scratch.path());
  read("a.vtp", whole);
  EXPECT_EQ(errors, std::vector<std::string>());
  EXPECT_GT(triangles(), 0);
  std::vector<std::string> wrong;
  for (const char* key : {"NumberOfPoints=\"", "NumberOfVerts=\"", "NumberOfPolys=\"", "NumberOfComponents=\""})
  {
    for (const char* count : {"99999999999\"", "-1\"", "18446744073709551615\"", "x\""})
    {
      const std::size_t at = whole.find(key) + std::strlen(key);
      wrong.push_back(std::string(whole).replace(at, whole.find('"', at) + 1 - at, count));
    }
  }
  const std::size_t data = whole.find("<AppendedData");
  if (data != whole.npos)
  {
    std::string bytes = whole;
    wrong.push_back(bytes.replace(whole.find('_', data) + 1, 16,
                                  GetParam() == "raw" ? std::string(16, '\x7f') : "f39/f39/f39/f39/"));
    const std::size_t at = whole.rfind("offset=\"", data) + 8;
    wrong.push_back(std::string(whole).replace(at, whole.find('"', at) - at, "99999"));
  }
  else if (GetParam() == "inline")
  {
    const std::size_t array = whole.find(">", whole.find("Name=\"Points\""));
    wrong.push_back(std::string(whole).replace(whole.find_first_not_of(" \n", array + 1), 16, "f39/f39/f39/f39/"));
  }
  for (const std::string& bytes : wrong)
  {
    const atria::testing::Watchdog watchdog(GetParam(), std::chrono::seconds(60));
    read("a.vtp", bytes);
    EXPECT_THAT(firstError(), AllOf(HasSubstr("a.vtp"), HasSubstr("cannot be right"))) << bytes.substr(0, 1000);
  }
}

TEST_P(XmlMode, DoesNotFollowAFileThatNamesItself)
{
  std::string bytes = xmlHouse(GetParam(), scratch.path());
  read("a.vtp", bytes);
  const vtkIdType whole = triangles();
  read("a.vtp", bytes.insert(bytes.find("<PolyData"), "<DataSet index=\"0\" file=\"a.vtp\"/>"));
  EXPECT_EQ(errors, std::vector<std::string>());
  EXPECT_EQ(triangles(), whole);
}

INSTANTIATE_TEST_SUITE_P(Modes, XmlMode, ::testing::Values("text", "inline", "appended", "raw"));

} // namespace
