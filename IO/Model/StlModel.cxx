// SPDX-License-Identifier: GPL-3.0-or-later
/// STL. Atria has a reader of its own because VTK 9.1's reader loses the names of solids that are empty, has single
/// precision, and trusts the count of a binary file.
#include "ModelFaces.h"
#include "ModelFile.h"
#include "ModelText.h"

#include "Support/Error.h"
#include "Support/Text.h"
#include "Support/Utf8.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace atria::model {

namespace {

using std::string_view;

constexpr std::size_t headerSize = 80;
constexpr std::size_t facetSize = 50;

/// Returns the number of facets that a binary file states; 0 if the file is too short for it.
std::size_t statedFacets(const std::string& bytes)
{
  std::uint32_t count = 0;
  if (bytes.size() >= headerSize + sizeof count)
  {
    std::memcpy(&count, bytes.data() + headerSize, sizeof count); // little endian, as all machines in use
  }
  return count;
}

/// True for text. Many binary files begin with the word `solid`, too; a damaged text may hold zeros.
bool isText(const std::string& bytes)
{
  const bool fits = bytes.size() == headerSize + sizeof(std::uint32_t) + facetSize * statedFacets(bytes);
  if (fits && statedFacets(bytes) > 0)
  {
    return false;
  }
  const std::string start = lowered(string_view(bytes).substr(0, 1024));
  const bool hasWords = start.find("vertex") != start.npos && start.find("facet") != start.npos;
  return hasWords || start.find('\0') == start.npos;
}

class TextReader
{
public:
  explicit TextReader(const std::string& bytes) : text(bytes) {}

  void read()
  {
    for (number = 1; at < text.size(); ++number)
    {
      string_view line = nextLine(text, at);
      const std::string word = lowered(nextWord(line));
      if (word == "solid")
      {
        names.push_back(toUtf8(trimmed(line)));
      }
      else if (word == "facet")
      {
        corners.clear();
      }
      else if (word == "vertex")
      {
        addCorner(line);
      }
      else if (word == "endfacet")
      {
        endFacet();
      }
    }
    if (!corners.empty())
    {
      complain("the file ends within a facet");
    }
  }

  ModelFaces faces;
  std::vector<std::string> names;
  std::string complaint; ///< the first
  std::size_t complaints = 0;

private:
  void addCorner(string_view line)
  {
    std::array<double, 3> p{};
    for (double& value : p)
    {
      if (!parse(nextWord(line), value) || !std::isfinite(value))
      {
        complain("expected three numbers behind 'vertex'");
        value = std::nan("");
      }
    }
    corners.push_back(p);
  }

  void endFacet()
  {
    if (corners.size() != 3)
    {
      complain("expected three corners of the facet that ends here");
    }
    else
    {
      if (names.empty())
      {
        names.emplace_back();
      }
      faces.add(std::array{faces.pointAt(corners[0]), faces.pointAt(corners[1]), faces.pointAt(corners[2])},
                static_cast<int>(names.size()) - 1);
    }
    corners.clear();
  }

  void complain(const std::string& what)
  {
    if (complaints++ == 0)
    {
      complaint = "line " + std::to_string(number) + ": " + what;
    }
  }

  string_view text;
  std::size_t at = 0;
  std::size_t number = 1;
  std::vector<std::array<double, 3>> corners;
};

/// Returns the existing facets, up to the stated number.
ModelFaces binaryFaces(const std::string& bytes)
{
  constexpr std::size_t start = headerSize + sizeof(std::uint32_t);
  constexpr std::size_t normalSize = 12;
  ModelFaces faces;
  const std::size_t present = bytes.size() < start ? 0 : (bytes.size() - start) / facetSize;
  for (std::size_t i = 0; i < std::min(present, statedFacets(bytes)); ++i)
  {
    std::array<std::size_t, 3> corners;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      std::array<float, 3> p;
      std::memcpy(p.data(), bytes.data() + start + i * facetSize + normalSize + corner * sizeof p, sizeof p);
      corners[corner] = faces.pointAt({p[0], p[1], p[2]});
    }
    faces.add(corners, 0);
  }
  return faces;
}

/// Gives names to solids without one. Equal names stay: they are one surface in several pieces.
void nameTheRest(std::vector<std::string>& names, const std::string& stem)
{
  int number = 1;
  for (std::string& name : names)
  {
    if (name.empty())
    {
      name = number == 1 ? stem : stem + "_" + std::to_string(number);
      ++number;
    }
  }
}

Model modelOf(const ModelFaces& faces, std::vector<std::string> names, const std::string& complaint,
              const std::string& file)
{
  if (faces.numberOfFaces() == 0)
  {
    throw Error("'" + file + "' cannot be read as STL: " + (complaint.empty() ? "it holds no facets" : complaint) +
                "; export it again");
  }
  nameTheRest(names, stemOf(file));
  Model model;
  if (!complaint.empty())
  {
    model.warnings.push_back("the file is damaged: " + complaint + "; what is left is read");
  }
  faces.giveTo(model, names, "facets");
  return model;
}

Model readText(const std::string& bytes, const std::string& file)
{
  TextReader reader(bytes);
  reader.read();
  const std::string more =
      reader.complaints > 1 ? ", and " + std::to_string(reader.complaints - 1) + " more places" : std::string();
  return modelOf(reader.faces, reader.names, reader.complaint.empty() ? "" : reader.complaint + more, file);
}

Model readBinary(const std::string& bytes, const std::string& file)
{
  const std::size_t body = bytes.size() - std::min(bytes.size(), headerSize + sizeof(std::uint32_t));
  const std::size_t stated = statedFacets(bytes);
  std::string complaint;
  if (body != stated * facetSize)
  {
    complaint = "it states " + std::to_string(stated) + " facets and has room for " + std::to_string(body / facetSize);
  }
  Model model = modelOf(binaryFaces(bytes), {""}, complaint, file);
  model.singlePrecision = true;
  return model;
}

} // namespace

Model readStl(const std::string& file)
{
  const std::string bytes = readBytes(file);
  Model model = isText(bytes) ? readText(bytes, file) : readBinary(bytes, file);
  model.head = headOf(bytes);
  return model;
}

} // namespace atria::model
