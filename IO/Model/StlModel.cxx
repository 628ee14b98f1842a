// SPDX-License-Identifier: GPL-3.0-or-later
/// STL. VTK's reader tells the solids of an ASCII file apart by number (ScalarTags); their names are read here, since
/// its Header loses those that are empty.
#include "ModelFile.h"

#include "Support/Error.h"
#include "Support/Utf8.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace atria::model {

namespace {

constexpr std::string_view blanks = " \t\v\f\r";

bool isSolid(std::string_view word)
{
  constexpr std::string_view wanted = "solid";
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// What stands behind `solid`, for each solid of an ASCII file.
std::vector<std::string> solidNames(std::string_view text)
{
  std::vector<std::string> names;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = text.substr(at, end - at);
    at = end + 1;
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    const std::size_t word = std::min(line.find_first_of(blanks), line.size());
    if (isSolid(line.substr(0, word)))
    {
      line.remove_prefix(word);
      const std::size_t first = line.find_first_not_of(blanks);
      const std::size_t last = line.find_last_not_of(blanks);
      names.push_back(first == line.npos ? std::string() : toUtf8(line.substr(first, last - first + 1)));
    }
  }
  return names;
}

/// Gives names to those without. Equal names stay: they are one surface in several pieces.
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

} // namespace

Model readStl(const std::string& file)
{
  const std::string bytes = readBytes(file);
  vtkNew<vtkSTLReader> reader;
  const Messages messages(reader);
  reader->SetFileName(file.c_str());
  reader->ScalarTagsOn();
  reader->Update();
  if (!messages.error().empty())
  {
    throw Error("'" + file + "' cannot be read as STL: " + messages.error() + "; export it again");
  }
  vtkPolyData* data = reader->GetOutput();
  std::vector<std::string> names{""};
  std::vector<int> ids(static_cast<std::size_t>(data->GetNumberOfCells()), 0);
  if (vtkDataArray* labels = data->GetCellData()->GetArray("STLSolidLabeling"))
  {
    names = solidNames(bytes);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      ids[i] = static_cast<int>(labels->GetComponent(static_cast<vtkIdType>(i), 0));
    }
  }
  nameTheRest(names, stemOf(file));
  setSurfaces(data, ids, names);
  Model model;
  model.data = data;
  model.warnings = messages.warnings();
  model.singlePrecision = true;
  model.head = headOf(bytes);
  return model;
}

} // namespace atria::model
