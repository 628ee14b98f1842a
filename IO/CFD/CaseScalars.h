// SPDX-License-Identifier: GPL-3.0-or-later
/// Passive scalars of a flow case, such as CO2 or smoke: their sources, and what the incoming air holds of them.
#pragma once

#include "CaseMesh.h"

#include <map>
#include <string>
#include <vector>

namespace atria {

struct FlowCaseSettings;
struct PatchChoice;

/// A source of a scalar, or its concentration in the air that comes in. Several sources of one scalar add up.
struct ScalarRule
{
  std::string scalar;
  std::string pattern; ///< see matchesPattern; of a cell zone, or else of a patch
  double amount = 0.0; ///< a source: units/s, over all that match; else units/m3 of incoming air
  bool isSource = true;
};

/// Parses `NAME PATTERN AMOUNT`, such as "CO2 Office 5e-6/s" (a source) or "CO2 Inlet 400e-6" (incoming air). Throws
/// Error if a part is missing, or is no name or amount.
ScalarRule scalarRuleFrom(const std::string& text);

/// A scalar with the amounts of all rules. Cell zones and patches are named as in OpenFOAM.
struct CaseScalar
{
  std::string name;
  std::map<std::string, double> zones;    ///< sources by cell zone, units/s
  std::map<std::string, double> surfaces; ///< sources by patch, units/s
  std::map<std::string, double> incoming; ///< concentration of the air that comes in, by patch, units/m3

  /// Returns the concentration of the air that comes in at a patch, units/m3.
  double incomingAt(const std::string& patch) const;
};

/// Returns the concentration at the start of a run: the least of those that come in, units/m3.
double startOf(const CaseScalar& scalar, const CaseMesh& mesh, const std::vector<PatchChoice>& choices);

/// Returns all scalars in the order of their first rules. A source of several zones or patches is divided among them in
/// proportion to volume or area. Throws Error for
/// - a rule that matches no cell zone and no patch,
/// - a source at patches through which air flows, or for the Foundation's dialects at any patches,
/// - a concentration where no air comes in,
/// - a scalar of which nothing comes into the air.
std::vector<CaseScalar> caseScalars(const CaseMesh& mesh, const FlowCaseSettings& settings,
                                    const std::vector<PatchChoice>& choices);

} // namespace atria
