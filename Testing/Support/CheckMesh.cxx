// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/CheckMesh.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string_view>

namespace atria::testing {

namespace {

/// The number after the first occurrence of a text.
double numberAfter(const std::string& log, const std::string& text)
{
  const std::size_t at = log.find(text);
  return at == std::string::npos ? std::numeric_limits<double>::quiet_NaN()
                                 : std::strtod(log.c_str() + at + text.size(), nullptr);
}

/// Lines "    name:   number" from the line that begins with `title` to the next empty one.
std::map<std::string, long> table(const std::string& log, std::string_view title)
{
  std::map<std::string, long> rows;
  std::istringstream lines(log.substr(std::min(log.find(title), log.size())));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line) && !line.empty())
  {
    const std::size_t colon = line.find(':');
    const std::size_t first = line.find_first_not_of(' ');
    if (colon != std::string::npos && first < colon)
    {
      rows[line.substr(first, colon - first)] = std::strtol(line.c_str() + colon + 1, nullptr, 10);
    }
  }
  return rows;
}

/// Lines that begin with checkMesh's mark of a failed check.
std::vector<std::string> failuresIn(const std::string& log)
{
  std::vector<std::string> failures;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);)
  {
    if (line.starts_with(" ***"))
    {
      failures.push_back(line);
    }
  }
  return failures;
}

} // namespace

bool haveCheckMesh() { return std::system("command -v checkMesh > /dev/null 2>&1") == 0; }

bool runOpenFOAM(const std::string& utility, const std::filesystem::path& caseFolder, std::string& log)
{
  // Debian's packages are called without OpenFOAM's environment; this alone they need.
  const std::string command =
      "WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} " + utility + " -case '" + caseFolder.string() + "' 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe)
  {
    return false;
  }
  char buffer[4096];
  for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
  {
    log.append(buffer, n);
  }
  return pclose(pipe) == 0;
}

CheckMeshReport runCheckMesh(const std::filesystem::path& caseFolder, const std::string& checks)
{
  CheckMeshReport report;
  runOpenFOAM("checkMesh " + checks, caseFolder, report.log);
  const std::string& log = report.log;
  const bool ok = log.find("\nMesh OK.") != std::string::npos;
  const double failed = numberAfter(log, "\nFailed ");
  report.completed = ok || failed > 0;
  report.failedChecks = ok || !(failed > 0) ? 0 : static_cast<int>(failed);
  report.failures = failuresIn(log);
  report.counts = table(log, "Mesh stats");
  report.cellsByType = table(log, "Overall number of cells of each type");
  report.maxNonOrthogonality = numberAfter(log, "Mesh non-orthogonality Max: ");
  report.averageNonOrthogonality = numberAfter(log, " average: ");
  report.maxSkewness = numberAfter(log, "Max skewness = ");
  report.minVolume = numberAfter(log, "Min volume = ");
  report.maxVolume = numberAfter(log, "Max volume = ");
  report.totalVolume = numberAfter(log, "Total volume = ");
  report.maxAspectRatio = numberAfter(log, "Max aspect ratio = ");
  return report;
}

} // namespace atria::testing
