// SPDX-License-Identifier: GPL-3.0-or-later
/// Wavefront OBJ. Atria has a reader of its own because VTK 9.1's reader keeps no names of objects and groups, has
/// single precision, and does not check indices.
#include "ModelFile.h"
#include "ModelText.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

namespace atria::model {

namespace {

using std::string_view;

/// Lines of a text, whatever ends them. A backslash at the end of a line, but not of a comment, joins the next to it.
class Lines
{
public:
  explicit Lines(string_view all) : text(all) {}

  bool next(string_view& line)
  {
    if (at >= text.size())
    {
      return false;
    }
    line = nextPiece();
    first = number;
    const std::size_t start = line.find_first_not_of(blanks);
    if (start == string_view::npos || line[start] == '#' || line.back() != '\\')
    {
      return true;
    }
    joined.clear();
    while (!line.empty() && line.back() == '\\')
    {
      joined.append(line.substr(0, line.size() - 1)).push_back(' ');
      line = at < text.size() ? nextPiece() : string_view();
    }
    joined.append(line);
    line = joined;
    return true;
  }

  /// Returns the number of the line returned last, from 1.
  std::size_t where() const { return first; }

private:
  string_view nextPiece()
  {
    ++number;
    return nextLine(text, at);
  }

  string_view text;
  std::size_t at = 0;
  std::size_t number = 0;
  std::size_t first = 0;
  std::string joined;
};

class ObjReader
{
public:
  explicit ObjReader(const std::string& path) : file(path), bytes(readBytes(path)), lines(bytes) {}

  Model read()
  {
    points->SetDataTypeToDouble();
    string_view line;
    while (lines.next(line))
    {
      statement(line);
    }
    return model();
  }

private:
  void statement(string_view line);
  void addPoint(string_view line);
  void addFace(string_view line);
  /// Returns the vertex that a face's word names; -1 if it names none.
  vtkIdType vertexOf(string_view word) const;
  int currentPart();
  void addWarnings(Model& result) const;
  Model model();
  void complain(std::size_t line, const std::string& text)
  {
    constexpr std::size_t most = 100;
    if (complained++ < most)
    {
      complaints.push_back("line " + std::to_string(line) + ": " + text);
    }
  }

  struct Face
  {
    std::size_t line;
    int part;
  };

  std::string file;
  std::string bytes;
  Lines lines;
  vtkNew<vtkPoints> points;
  std::vector<vtkIdType> corners; ///< corners of all faces
  std::vector<std::size_t> offsets{0};
  std::vector<Face> faces;
  std::string object;
  std::string group;
  std::string material;
  int part = -1; ///< that of object, group and material; -1 where not looked up
  std::vector<Part> parts;
  std::map<std::tuple<std::string, std::string, std::string>, int> partIds;
  std::map<std::array<std::string, 3>, std::size_t> owners; ///< keyed by object and group, or else by material
  std::size_t notSurfaces = 0;
  std::size_t freeForms = 0;
  std::set<vtkIdType> damaged; ///< vertices
  std::size_t incomplete = 0;  ///< faces with such
  std::vector<std::string> complaints;
  std::size_t complained = 0; ///< how often; the first are kept
};

void ObjReader::statement(string_view line)
{
  const string_view keyword = nextWord(line);
  if (keyword == "v")
  {
    addPoint(line);
  }
  else if (keyword == "f" || keyword == "fo")
  {
    addFace(line);
  }
  else if (keyword == "o" || keyword == "g" || keyword == "usemtl")
  {
    (keyword == "o" ? object : keyword == "g" ? group : material) = toUtf8(trimmed(line));
    part = -1;
  }
  else if (keyword == "l" || keyword == "p")
  {
    ++notSurfaces;
  }
  else if (keyword == "surf" || keyword == "curv" || keyword == "curv2")
  {
    ++freeForms;
  }
}

void ObjReader::addPoint(string_view line)
{
  std::array<double, 3> p{};
  bool good = true;
  for (double& value : p)
  {
    good = good && parse(nextWord(line), value) && std::isfinite(value);
  }
  if (!good)
  {
    // The vertex is kept, so that those that follow keep their numbers.
    damaged.insert(points->GetNumberOfPoints());
    complain(lines.where(), "expected three numbers behind 'v'; faces with this vertex are left out");
    p = {};
  }
  points->InsertNextPoint(p.data());
}

vtkIdType ObjReader::vertexOf(string_view word) const
{
  long long index = 0;
  if (!parse(word, index, "/"))
  {
    return -1;
  }
  return index < 0 ? points->GetNumberOfPoints() + index : index - 1; // counted from the end, or from 1
}

/// Returns a name for faces of an object and a group, either of which may be empty. Most exporters write one of them,
/// or both alike.
std::string ownerName(const std::string& object, const std::string& group)
{
  if (group.empty() || group == "default" || group == "off" || object.find(group) != std::string::npos)
  {
    return object.empty() ? group : object;
  }
  return object.empty() || group.find(object) != std::string::npos ? group : object + "_" + group;
}

int ObjReader::currentPart()
{
  if (part < 0)
  {
    const auto [found, isNew] =
        partIds.try_emplace(std::tuple(object, group, material), static_cast<int>(parts.size()));
    part = found->second;
    if (isNew)
    {
      const std::string owner = ownerName(object, group);
      const std::size_t id =
          owners.try_emplace({object, group, owner.empty() ? material : ""}, owners.size()).first->second;
      parts.push_back({owner.empty() ? material : owner, material, id});
    }
  }
  return part;
}

void ObjReader::addFace(string_view line)
{
  const std::size_t before = corners.size();
  bool good = true;
  for (string_view word = nextWord(line); good && !word.empty() && word.front() != '#'; word = nextWord(line))
  {
    corners.push_back(vertexOf(word));
    good = corners.back() >= 0;
  }
  if (!good || corners.size() - before < 3)
  {
    complain(lines.where(), std::string("the face is left out: ") +
                                (good ? "it has fewer than three corners" : "a corner names no vertex"));
    corners.resize(before);
    return;
  }
  offsets.push_back(corners.size());
  faces.push_back({lines.where(), currentPart()});
}

void ObjReader::addWarnings(Model& result) const
{
  result.warnings = complaints;
  if (complained > complaints.size())
  {
    result.warnings.push_back(std::to_string(complained - complaints.size()) + " more lines are damaged");
  }
  if (incomplete > 0)
  {
    result.warnings.push_back(std::to_string(incomplete) + " faces are left out: they have corners that are damaged");
  }
  if (notSurfaces > 0)
  {
    result.warnings.push_back(std::to_string(notSurfaces) + " lines and points make no surface");
  }
  if (freeForms > 0)
  {
    result.warnings.push_back(std::to_string(freeForms) +
                              " free-form curves and surfaces are left out; export them as polygons");
  }
}

Model ObjReader::model()
{
  vtkNew<vtkCellArray> cells;
  std::vector<int> ids;
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    const vtkIdType* first = corners.data() + offsets[i];
    const auto count = static_cast<vtkIdType>(offsets[i + 1] - offsets[i]);
    // A face may come before its vertices, so this shows at the end only.
    if (*std::max_element(first, first + count) >= points->GetNumberOfPoints())
    {
      complain(faces[i].line, "the face is left out: a corner names a vertex beyond the last one");
      continue;
    }
    if (std::any_of(first, first + count, [&](vtkIdType id) { return damaged.count(id) != 0; }))
    {
      ++incomplete;
      continue;
    }
    cells->InsertNextCell(count, first);
    ids.push_back(faces[i].part);
  }
  if (ids.empty() && complained > 0)
  {
    throw Error("'" + file + "' holds no face that can be read: " + complaints.front() + "; export it again");
  }
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  const std::vector<std::string> names = uniqueNames(parts, stemOf(file));
  setSurfaces(data, ids, names);
  Model result;
  result.data = data;
  result.head = headOf(bytes);
  keepParts(result, parts, names);
  addWarnings(result);
  return result;
}

} // namespace

Model readObj(const std::string& file) { return ObjReader(file).read(); }

} // namespace atria::model
