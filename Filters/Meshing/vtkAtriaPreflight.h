// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkAtriaPreflight
 * @brief   what a mesh would be like, before it is made
 *
 * Takes the mesher's input and properties, and makes the domain and the octree, but no mesh.
 *
 * Output: vtkTable with the columns `Quantity` (string), `Value` (double) and `Unit` (string: m, degrees, H for
 * building heights, or empty); docs/arrays.md lists the quantities. What a model does not have, such as an opening, has
 * no row. Field arrays: `Warning` (string, what to look at before meshing), `OpeningSurface` and `GapSurface` (string,
 * the surfaces the narrowest opening and gap lie between; empty without).
 */
#ifndef vtkAtriaPreflight_h
#define vtkAtriaPreflight_h

#include "vtkAtriaGridAlgorithm.h"

class vtkTable;

class ATRIAFILTERSMESHING_EXPORT vtkAtriaPreflight : public vtkAtriaGridAlgorithm
{
public:
  static vtkAtriaPreflight* New();
  vtkTypeMacro(vtkAtriaPreflight, vtkAtriaGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkTable* GetOutput();

  /**
   * SizeMax, SizeMid and SizeMin of the last run: those that were 0 follow from the model. With them the mesher makes
   * the mesh that was looked at. 0 before a run.
   */
  vtkGetVector3Macro(SizesTaken, double);

protected:
  vtkAtriaPreflight();
  ~vtkAtriaPreflight() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  double SizesTaken[3] = {0.0, 0.0, 0.0};

  vtkAtriaPreflight(const vtkAtriaPreflight&) = delete;
  void operator=(const vtkAtriaPreflight&) = delete;
};

#endif
