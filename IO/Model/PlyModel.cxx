// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelFile.h"

#include "Support/Error.h"

#include <vtkNew.h>
#include <vtkPLYReader.h>
#include <vtkPolyData.h>

#include <set>
#include <sstream>

namespace atria::model {

namespace {

/// Throws Error unless the header declares vertices with coordinates and faces: VTK's reader relies on both.
void checkHeader(const std::string& file, const std::string& bytes)
{
  constexpr std::size_t longest = 1 << 16;
  std::istringstream header(bytes.substr(0, longest));
  std::string line;
  std::string element;
  std::set<std::string> found;
  bool ended = false;
  bool first = true;
  while (!ended && std::getline(header, line))
  {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (first && word != "ply")
    {
      throw Error("'" + file + "' is no PLY file: it does not begin with 'ply'");
    }
    first = false;
    ended = word == "end_header";
    if (word == "element")
    {
      words >> element;
    }
    else if (word == "property")
    {
      for (std::string next; words >> next;)
      {
        word = next;
      }
      found.insert(element + " " + word);
    }
  }
  const bool faces = found.count("face vertex_indices") || found.count("face vertex_index");
  if (!ended || !found.count("vertex x") || !found.count("vertex y") || !found.count("vertex z") || !faces)
  {
    throw Error("'" + file + "' holds no faces: its header lacks vertex x, y, z or face vertex_indices; a cloud of " +
                "points is no surface, export the model with its faces");
  }
}

} // namespace

Model readPly(const std::string& file)
{
  const std::string bytes = readBytes(file);
  checkHeader(file, bytes);
  vtkNew<vtkPLYReader> reader;
  const Messages messages(reader);
  reader->SetFileName(file.c_str());
  reader->Update();
  if (!messages.error().empty())
  {
    throw Error("'" + file + "' cannot be read as PLY: " + messages.error() + "; export it again");
  }
  vtkPolyData* data = reader->GetOutput();
  setSurfaces(data, std::vector<int>(static_cast<std::size_t>(data->GetNumberOfCells()), 0), {stemOf(file)});
  Model model;
  model.data = data;
  model.warnings = messages.warnings();
  model.singlePrecision = true;
  model.head = headOf(bytes);
  return model;
}

} // namespace atria::model
