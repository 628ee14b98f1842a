// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkChecks.h"

#include "Quality/Checks/CheckTexts.h"

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

namespace atria {

namespace {

template <typename Array, typename ValueOf>
void addColumn(vtkTable* table, const char* name, const MeshVerdict& verdict, ValueOf&& valueOf)
{
  vtkNew<Array> column;
  column->SetName(name);
  for (const MeshCheck& check : verdict.checks)
  {
    column->InsertNextValue(valueOf(check));
  }
  table->AddColumn(column);
}

} // namespace

void checksToVtk(const MeshVerdict& verdict, vtkTable* table)
{
  addColumn<vtkStringArray>(table, "Check", verdict, [](const MeshCheck& check) { return check.name; });
  addColumn<vtkStringArray>(table, "Of", verdict, [](const MeshCheck& check) { return nameOf(check.part); });
  addColumn<vtkDoubleArray>(table, "Limit", verdict, [](const MeshCheck& check) { return check.limit; });
  addColumn<vtkDoubleArray>(table, "Worst", verdict, [](const MeshCheck& check) { return check.worst; });
  addColumn<vtkDoubleArray>(table, "Mean", verdict, [](const MeshCheck& check) { return check.mean; });
  addColumn<vtkIdTypeArray>(table, "Failing", verdict,
                            [](const MeshCheck& check) { return static_cast<vtkIdType>(check.failing.size()); });
  addColumn<vtkUnsignedCharArray>(table, "IsError", verdict,
                                  [](const MeshCheck& check) { return check.isError ? 1 : 0; });
  addColumn<vtkStringArray>(table, "Set", verdict, [](const MeshCheck& check) { return check.set; });
  addColumn<vtkStringArray>(table, "Advice", verdict, [](const MeshCheck& check) { return adviceFor(check); });
}

} // namespace atria
