// SPDX-License-Identifier: GPL-3.0-or-later
#include "VtkChecks.h"

#include "AddArray.h"
#include "Quality/Checks/CheckTexts.h"

#include <vtkDataSetAttributes.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

namespace atria {

void checksToVtk(const MeshVerdict& verdict, vtkTable* table)
{
  vtkDataSetAttributes* rows = table->GetRowData();
  addArrayOf<vtkStringArray>(rows, "Check", verdict.checks, &MeshCheck::name);
  addArrayOf<vtkStringArray>(rows, "Of", verdict.checks, [](const MeshCheck& check) { return nameOf(check.part); });
  addArrayOf<vtkDoubleArray>(rows, "Limit", verdict.checks, &MeshCheck::limit);
  addArrayOf<vtkDoubleArray>(rows, "Worst", verdict.checks, &MeshCheck::worst);
  addArrayOf<vtkDoubleArray>(rows, "Mean", verdict.checks, &MeshCheck::mean);
  addArrayOf<vtkIdTypeArray>(rows, "Failing", verdict.checks,
                             [](const MeshCheck& check) { return check.failingCount; });
  addArrayOf<vtkUnsignedCharArray>(rows, "IsError", verdict.checks, &MeshCheck::isError);
  addArrayOf<vtkStringArray>(rows, "Set", verdict.checks, &MeshCheck::set);
  addArrayOf<vtkStringArray>(rows, "Advice", verdict.checks, adviceFor);
}

} // namespace atria
