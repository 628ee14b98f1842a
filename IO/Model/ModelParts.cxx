// SPDX-License-Identifier: GPL-3.0-or-later
#include "ModelParts.h"

#include "AddArray.h"
#include "Support/Error.h"
#include "Support/Text.h"
#include "Support/Utf8.h"

#include <vtkCellData.h>
#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <unordered_map>

namespace atria::model {

std::vector<std::string> namesByMaterial(const std::vector<Part>& parts, const std::string& fallback)
{
  std::map<std::size_t, std::set<std::string>> materials;
  for (const Part& part : parts)
  {
    materials[part.owner].insert(part.material);
  }
  std::vector<std::string> names;
  for (const Part& part : parts)
  {
    const bool several = materials[part.owner].size() > 1 && !part.material.empty();
    names.push_back((part.name.empty() ? fallback : part.name) + (several ? "_" + part.material : ""));
  }
  return names;
}

std::vector<std::string> uniqueNames(const std::vector<Part>& parts, const std::string& fallback)
{
  std::unordered_map<std::string, int>
      used; // with the last number tried behind each, so that many equal ones are quick
  std::vector<std::string> names = namesByMaterial(parts, fallback);
  for (std::string& name : names)
  {
    const std::string wanted = name;
    const auto [found, isNew] = used.try_emplace(wanted, 1);
    int& number = found->second; // stays where it is as the table grows
    for (bool isFree = isNew; !isFree; isFree = used.try_emplace(name, 1).second)
    {
      name = wanted + "_" + std::to_string(++number);
    }
  }
  return names;
}

std::vector<std::string> keepTree(Model& model, const std::vector<Part>& parts)
{
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    numbers.push_back(std::to_string(i));
  }
  keepParts(model, parts, numbers);
  return numbers;
}

void keepParts(Model& model, const std::vector<Part>& parts, const std::vector<std::string>& names)
{
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    model.parts[names[i]] = parts[i];
  }
}

std::string headOf(const std::string& bytes)
{
  constexpr std::size_t length = 4096;
  const std::string head = bytes.substr(0, length);
  return head.find('\0') == head.npos ? head : std::string();
}

std::string stemOf(const std::string& file) { return toUtf8(std::filesystem::path(file).stem().string()); }

std::string lowerEnding(const std::string& file) { return lowered(std::filesystem::path(file).extension().string()); }

void setSurfaces(vtkPolyData* data, const std::vector<int>& ids, const std::vector<std::string>& names)
{
  addArrayOf<vtkIntArray>(data->GetCellData(), "SurfaceId", ids);
  addArrayOf<vtkStringArray>(data->GetFieldData(), "SurfaceName", names);
}

std::string readBytes(const std::string& file)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
  {
    throw Error("'" + file + "' does not exist or is not a file");
  }
  std::string bytes(static_cast<std::size_t>(std::filesystem::file_size(file)), '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in && !bytes.empty())
  {
    throw Error("cannot read '" + file + "'; check its permissions");
  }
  return bytes;
}

} // namespace atria::model
