// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the files, boundary conditions and parts of files of all flow cases, and the template of each.
#pragma once

#include "FoamTemplate.h"

#include <set>
#include <span>

namespace atria {

/// A row of the table. The first row for something whose facts hold gives its template.
struct CaseRow
{
  std::string_view what; ///< one name, several (`U|k`) or all (`*`)
  std::string_view when; ///< facts that must hold, all of them; of `a|b` one
  std::string_view from; ///< name of the template
};

/// Files of a case by their path.
std::span<const CaseRow> caseFiles();
/// Boundary conditions by their field.
std::span<const CaseRow> caseConditions();
/// Parts that templates name as they name values.
std::span<const CaseRow> caseParts();

/// How the equations of a field are treated.
enum class FieldKind
{
  Velocity,
  Turbulence,
  Scalar,      ///< carried along by the air
  Temperature, ///< the same, and moves the air
  Derived      ///< not carried by the air
};

struct CaseField
{
  std::string_view name;
  std::string_view className;
  FieldKind kind;
  std::string_view when;       ///< facts as in CaseRow
  std::string_view row = name; ///< its name in the table; all passive scalars have one
};
std::span<const CaseField> caseFields();

/// Facts choose templates, values fill them.
struct Filling
{
  std::set<std::string, std::less<>> facts;
  std::map<std::string, Lines, std::less<>> values;
};

/// True if all facts hold that are listed as in CaseRow.
bool holds(std::string_view when, const Filling& filling);
/// Returns the row for something, or null if none holds.
const CaseRow* rowOf(std::span<const CaseRow> rows, std::string_view what, const Filling& filling);
/// Returns the filled template of something, without lines if no row holds. Throws Error if a template names what is
/// neither a value nor a part.
Lines textOf(std::span<const CaseRow> rows, std::string_view what, const Filling& filling);

} // namespace atria
