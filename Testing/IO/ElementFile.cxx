// SPDX-License-Identifier: GPL-3.0-or-later
#include "ElementFile.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

namespace atria::testing {

namespace {

using Nodes = ElementFile::Nodes;
using Loops = std::vector<std::vector<std::size_t>>;

/// Faces by their corners, normals outward, as Gmsh's manual draws the elements.
const std::map<std::size_t, Loops> facesOf{
    {4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}},
    {5, {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}},
    {6, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
    {8, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}}};

/// Nodes of the faces S1, S2 … as Abaqus' manual lists them.
const std::map<std::size_t, Loops> abaqusFaces{
    {4, {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}},
    {6, {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}},
    {8, {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}}};

Vec3 areaVector(const ElementFile& mesh, const Nodes& loop)
{
  Vec3 sum = Vec3::Zero();
  const Vec3 origin = mesh.points.at(loop.front());
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
  {
    sum += (mesh.points.at(loop[i]) - origin).cross(mesh.points.at(loop[i + 1]) - origin) / 2.0;
  }
  return sum;
}

Vec3 centerOf(const ElementFile& mesh, const Nodes& nodes)
{
  Vec3 sum = Vec3::Zero();
  std::ranges::for_each(nodes, [&](std::int64_t node) { sum += mesh.points.at(node); });
  return sum / static_cast<double>(nodes.size());
}

Nodes faceOf(const Nodes& element, const std::vector<std::size_t>& corners)
{
  Nodes face;
  std::ranges::transform(corners, std::back_inserter(face), [&](std::size_t corner) { return element[corner]; });
  return face;
}

/// By triangles about the center of each face, as a bent face has a different volume with each diagonal.
double volumeOf(const ElementFile& mesh, const Nodes& element)
{
  const Vec3 origin = mesh.points.at(element.front());
  double sum = 0.0;
  for (const auto& corners : facesOf.at(element.size()))
  {
    const Nodes loop = faceOf(element, corners);
    const Vec3 center = centerOf(mesh, loop) - origin;
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const Vec3 a = mesh.points.at(loop[i]) - origin;
      const Vec3 b = mesh.points.at(loop[(i + 1) % loop.size()]) - origin;
      sum += center.dot(a.cross(b)) / 6.0;
    }
  }
  return sum;
}

/// The loop from its least node on, so that equal loops are equal lists.
Nodes rotated(Nodes loop)
{
  std::ranges::rotate(loop, std::ranges::min_element(loop));
  return loop;
}

void expectWord(std::istream& in, const std::string& expected)
{
  std::string word;
  in >> word;
  EXPECT_EQ(word, expected);
}

std::string stringIn(std::istream& in)
{
  std::string text;
  std::getline(in, text, '"');
  std::getline(in, text, '"');
  return text;
}

/// Reads the physical tags of entities of a dimension.
std::map<int, std::vector<int>> readTags(std::istream& in, int count)
{
  std::map<int, std::vector<int>> tags;
  for (int i = 0; i < count; ++i)
  {
    int entity = 0;
    int number = 0;
    Vec3 low;
    Vec3 high;
    in >> entity >> low[0] >> low[1] >> low[2] >> high[0] >> high[1] >> high[2] >> number;
    EXPECT_TRUE((low.array() <= high.array()).all());
    std::vector<int>& own = tags[entity];
    own.resize(static_cast<std::size_t>(number));
    std::ranges::for_each(own, [&](int& tag) { in >> tag; });
    in >> number;
    for (int b = 0, bound = 0; b < number; ++b)
    {
      in >> bound;
    }
  }
  EXPECT_EQ(tags.size(), static_cast<std::size_t>(count));
  return tags;
}

void readNodes(std::istream& in, ElementFile& mesh)
{
  expectWord(in, "$Nodes");
  std::size_t blocks = 0, count = 0, first = 0, last = 0;
  in >> blocks >> count >> first >> last;
  for (std::size_t b = 0; b < blocks; ++b)
  {
    std::size_t dimension = 0, entity = 0, parametric = 0, own = 0;
    in >> dimension >> entity >> parametric >> own;
    EXPECT_EQ(parametric, 0u);
    Nodes tags(own);
    std::ranges::for_each(tags, [&](std::int64_t& tag) { in >> tag; });
    for (const std::int64_t tag : tags)
    {
      Vec3 x;
      in >> x[0] >> x[1] >> x[2];
      EXPECT_TRUE(mesh.points.emplace(tag, x).second) << "node " << tag << " is there twice";
    }
  }
  EXPECT_EQ(mesh.points.size(), count);
  EXPECT_EQ(static_cast<std::size_t>(mesh.points.begin()->first), first);
  EXPECT_EQ(static_cast<std::size_t>(mesh.points.rbegin()->first), last);
  expectWord(in, "$EndNodes");
}

/// Lines without comments; blanks around fields are removed.
std::vector<std::vector<std::string>> abaqusLines(const std::string& file)
{
  std::ifstream in(file);
  std::vector<std::vector<std::string>> lines;
  for (std::string line; std::getline(in, line);)
  {
    EXPECT_LE(line.size(), 256u) << line;
    if (line.starts_with("**"))
    {
      continue;
    }
    std::istringstream fields(line);
    lines.emplace_back();
    for (std::string field; std::getline(fields, field, ',');)
    {
      field.erase(0, field.find_first_not_of(' '));
      lines.back().push_back(field);
    }
  }
  return lines;
}

/// The parameter of a keyword's line; a name must be one that Abaqus takes.
std::string parameter(const std::vector<std::string>& line, const std::string& key)
{
  for (const std::string& field : line)
  {
    if (field.starts_with(key + "="))
    {
      const std::string value = field.substr(key.size() + 1);
      EXPECT_LE(value.size(), 80u);
      EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(value.front()))) << value;
      EXPECT_TRUE(std::ranges::all_of(value, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; }))
          << value;
      return value;
    }
  }
  ADD_FAILURE() << "no " << key << " in " << line.front();
  return "";
}

double realOf(const std::string& field)
{
  EXPECT_LE(field.size(), 20u) << field;
  return std::stod(field);
}

} // namespace

ElementFile readGmsh(const std::string& file)
{
  std::ifstream in(file);
  ElementFile mesh;
  for (const char* word : {"$MeshFormat", "4.1", "0", "8", "$EndMeshFormat", "$PhysicalNames"})
  {
    expectWord(in, word);
  }
  std::size_t names = 0;
  in >> names;
  std::map<int, std::map<int, std::string>> nameOf;
  for (std::size_t i = 0; i < names; ++i)
  {
    int dimension = 0;
    int tag = 0;
    in >> dimension >> tag;
    EXPECT_TRUE(nameOf[dimension].emplace(tag, stringIn(in)).second);
  }
  expectWord(in, "$EndPhysicalNames");
  expectWord(in, "$Entities");
  std::array<int, 4> counts{};
  std::ranges::for_each(counts, [&](int& count) { in >> count; });
  EXPECT_EQ(counts[0] + counts[1], 0);
  std::map<int, std::map<int, std::vector<int>>> tagsOf;
  tagsOf[2] = readTags(in, counts[2]);
  tagsOf[3] = readTags(in, counts[3]);
  expectWord(in, "$EndEntities");
  readNodes(in, mesh);
  expectWord(in, "$Elements");
  std::size_t blocks = 0, count = 0, first = 0, last = 0;
  in >> blocks >> count >> first >> last;
  const std::map<int, std::size_t> corners{{2, 3}, {3, 4}, {4, 4}, {5, 8}, {6, 6}, {7, 5}};
  std::set<std::int64_t> numbers;
  for (std::size_t b = 0; b < blocks; ++b)
  {
    int dimension = 0, entity = 0, type = 0, own = 0;
    in >> dimension >> entity >> type >> own;
    EXPECT_EQ(dimension, type < 4 ? 2 : 3);
    for (int i = 0; i < own; ++i)
    {
      std::int64_t number = 0;
      in >> number;
      EXPECT_TRUE(numbers.insert(number).second);
      Nodes nodes(corners.at(type));
      std::ranges::for_each(nodes, [&](std::int64_t& node) { in >> node; });
      for (const int tag : tagsOf.at(dimension).at(entity))
      {
        const std::string& name = nameOf.at(dimension).at(tag);
        if (dimension == 2)
        {
          mesh.surfaces[name].push_back(nodes);
        }
        else
        {
          mesh.zones[name].push_back(number);
        }
      }
      if (dimension == 3)
      {
        mesh.elements[number] = nodes;
      }
    }
  }
  EXPECT_EQ(numbers.size(), count);
  EXPECT_EQ(static_cast<std::size_t>(*numbers.begin()), first);
  EXPECT_EQ(static_cast<std::size_t>(*numbers.rbegin()), last);
  expectWord(in, "$EndElements");
  EXPECT_EQ(mesh.surfaces.size(), nameOf[2].size());
  EXPECT_EQ(mesh.zones.size(), nameOf[3].size());
  return mesh;
}

ElementFile readAbaqus(const std::string& file)
{
  const std::map<std::string, std::size_t> corners{{"C3D4", 4}, {"C3D6", 6}, {"C3D8", 8}};
  ElementFile mesh;
  std::string keyword;
  std::string name;
  std::size_t size = 0;
  std::set<std::string> names;
  for (const std::vector<std::string>& line : abaqusLines(file))
  {
    if (line.front().starts_with('*'))
    {
      keyword = line.front();
      size = keyword == "*ELEMENT" ? corners.at(parameter(line, "TYPE")) : 0;
      name = keyword == "*ELSET" ? parameter(line, "ELSET") : keyword == "*SURFACE" ? parameter(line, "NAME") : "";
      std::string capitals;
      std::ranges::transform(name, std::back_inserter(capitals), [](unsigned char c) { return std::toupper(c); });
      EXPECT_TRUE(name.empty() || names.insert(capitals).second) << name << " is there twice";
      continue;
    }
    if (keyword == "*NODE")
    {
      const Vec3 x(realOf(line.at(1)), realOf(line.at(2)), realOf(line.at(3)));
      EXPECT_TRUE(mesh.points.emplace(std::stoll(line.at(0)), x).second);
    }
    else if (keyword == "*ELEMENT")
    {
      Nodes nodes;
      std::transform(line.begin() + 1, line.end(), std::back_inserter(nodes),
                     [](const std::string& field) { return std::stoll(field); });
      EXPECT_EQ(nodes.size(), size);
      EXPECT_TRUE(mesh.elements.emplace(std::stoll(line.at(0)), nodes).second);
    }
    else if (keyword == "*ELSET")
    {
      EXPECT_LE(line.size(), 16u);
      std::ranges::transform(line, std::back_inserter(mesh.zones[name]),
                             [](const std::string& field) { return std::stoll(field); });
    }
    else if (keyword == "*SURFACE")
    {
      const Nodes& element = mesh.elements.at(std::stoll(line.at(0)));
      EXPECT_EQ(line.at(1).front(), 'S');
      std::vector<std::size_t> face = abaqusFaces.at(element.size()).at(std::stoul(line.at(1).substr(1)) - 1);
      std::ranges::for_each(face, [](std::size_t& node) { --node; });
      mesh.surfaces[name].push_back(faceOf(element, face));
    }
    else
    {
      EXPECT_EQ(keyword, "*HEADING");
    }
  }
  return mesh;
}

MeshFacts factsOf(const ElementFile& mesh, bool turned)
{
  MeshFacts facts;
  facts.cells = mesh.elements.size();
  std::map<Nodes, std::vector<Nodes>> loopsOf; // by the sorted nodes of a face
  const auto sorted = [](Nodes nodes) {
    std::ranges::sort(nodes);
    return nodes;
  };
  for (const auto& [number, element] : mesh.elements)
  {
    const double volume = volumeOf(mesh, element);
    EXPECT_GT(volume, 0.0) << "element " << number;
    facts.volume += volume;
    for (const auto& corners : facesOf.at(element.size()))
    {
      const Nodes loop = faceOf(element, corners);
      loopsOf[sorted(loop)].push_back(rotated(loop));
    }
  }
  std::set<Nodes> marked;
  for (const auto& [name, faces] : mesh.surfaces)
  {
    facts.patches[name].faces = faces.size();
    for (const Nodes& face : faces)
    {
      facts.patches[name].area += areaVector(mesh, face).norm();
      EXPECT_TRUE(marked.insert(sorted(face)).second) << "a face of " << name << " is there twice";
      const std::vector<Nodes>& loops = loopsOf[sorted(face)];
      EXPECT_EQ(loops.size(), 1u) << "a face of " << name << " is not on the boundary";
      EXPECT_TRUE(!turned || loops.front() == rotated(face)) << "a face of " << name << " looks inward";
    }
  }
  for (const auto& [nodes, loops] : loopsOf)
  {
    EXPECT_LE(loops.size(), 2u);
    EXPECT_TRUE(loops.size() == 2 || marked.contains(nodes)) << "a boundary face is in no surface";
  }
  return facts;
}

double volumeOf(const ElementFile& mesh, const std::string& zone)
{
  double sum = 0.0;
  for (const std::int64_t element : mesh.zones.at(zone))
  {
    sum += volumeOf(mesh, mesh.elements.at(element));
  }
  return sum;
}

} // namespace atria::testing
