// SPDX-License-Identifier: GPL-3.0-or-later
#include "ProcessorFolders.h"

#include "FoamText.h"
#include "OpenFOAMCase.h"
#include "OutputFolders.h"
#include "Support/Error.h"

#include <system_error>

namespace atria {

namespace fs = std::filesystem;

namespace {

bool isProcessorFolder(const fs::directory_entry& entry)
{
  const std::string name = entry.path().filename().string();
  return entry.is_directory() && name.starts_with("processor") &&
         name.find_first_not_of("0123456789", 9) == std::string::npos;
}

} // namespace

fs::path unfinishedProcessors(const fs::path& caseFolder) { return caseFolder / ".processors.unfinished"; }

void placeProcessors(const fs::path& caseFolder, std::size_t parts, const Vec3& size,
                     const std::vector<std::string>& undivided)
{
  refuseProcessorResults(caseFolder);
  removeProcessors(caseFolder);
  moveFiles(unfinishedProcessors(caseFolder), caseFolder);
  writeDecomposition(caseFolder, parts, size, undivided);
}

void refuseProcessorResults(const fs::path& caseFolder)
{
  if (!fs::is_directory(caseFolder))
  {
    return;
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(caseFolder))
  {
    const std::string result = isProcessorFolder(entry) ? resultIn(entry.path()) : std::string();
    refuseResult(caseFolder, result.empty() ? result : entry.path().filename().string() + "/" + result);
  }
}

void addDivision(Filling& filling, std::size_t parts, const Vec3& size, const std::vector<std::string>& undivided)
{
  std::size_t fewer = 1;
  for (std::size_t divisor = 1; divisor * divisor <= parts; ++divisor)
  {
    fewer = parts % divisor == 0 ? divisor : fewer;
  }
  const std::size_t more = parts / fewer;
  const auto alongX = static_cast<double>(size[0] < size[1] ? fewer : more);
  const auto alongY = static_cast<double>(size[0] < size[1] ? more : fewer);
  filling.facts.insert("parallel");
  filling.values["processors"] = {std::to_string(parts)};
  filling.values["processorsAlongAxes"] = {foamVector({alongX, alongY, 1.0})};
  if (!undivided.empty())
  {
    filling.facts.insert("undivided");
    filling.values["undividedPatches"] = {foamList(undivided)};
  }
}

void writeDecomposition(const fs::path& caseFolder, std::size_t parts, const Vec3& size,
                        const std::vector<std::string>& undivided)
{
  constexpr const char* file = "system/decomposeParDict";
  Filling filling;
  addDivision(filling, parts, size, undivided);
  writeFoamFile(caseFolder, file, "dictionary", textOf(caseFiles(), file, filling));
}

void removeProcessors(const fs::path& caseFolder)
{
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(caseFolder))
  {
    if (isProcessorFolder(entry))
    {
      folders.push_back(entry.path());
    }
  }
  for (const fs::path& folder : folders)
  {
    std::error_code error;
    fs::remove_all(folder, error);
    if (error)
    {
      throw OutputError("cannot remove '" + folder.string() + "': " + error.message());
    }
  }
}

} // namespace atria
