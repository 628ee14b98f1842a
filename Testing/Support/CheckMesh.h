// SPDX-License-Identifier: GPL-3.0-or-later
/// OpenFOAM's checkMesh as a referee.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace atria::testing {

/// What checkMesh printed. Numbers it did not print are not a number.
struct CheckMeshReport
{
  std::string log;
  bool completed = false;                  ///< it read the mesh and came to a verdict
  int failedChecks = 0;                    ///< 0 where it said "Mesh OK."
  std::vector<std::string> failures;       ///< a line for each failed check
  std::map<std::string, long> counts;      ///< points, faces, internal faces, cells, boundary patches, cell zones …
  std::map<std::string, long> cellsByType; ///< hexahedra, prisms, wedges, pyramids, tet wedges, tetrahedra, polyhedra
  double maxNonOrthogonality;              ///< degrees
  double averageNonOrthogonality;          ///< arc cosine of the mean cosine, degrees
  double maxSkewness;
  double minVolume;
  double maxVolume;
  double totalVolume;
  double maxAspectRatio; ///< OpenFOAM's own, which depends on the axes
};

/// Whether checkMesh can be run here.
bool haveCheckMesh();
/// Why a test is skipped, wholly or in part, where it cannot.
inline constexpr const char* withoutCheckMesh = "checkMesh is not installed";

/// Runs one of OpenFOAM's utilities on a case; returns whether it succeeded. Its output is appended to `log`.
bool runOpenFOAM(const std::string& utility, const std::filesystem::path& caseFolder, std::string& log);

/// Runs checkMesh on a case, by default with all checks. As many digits as the case's writePrecision.
CheckMeshReport runCheckMesh(const std::filesystem::path& caseFolder,
                             const std::string& checks = "-allGeometry -allTopology");

} // namespace atria::testing
