// SPDX-License-Identifier: GPL-3.0-or-later
/// Filter that checks a model and estimates its mesh before meshing.
/**
 * @class   vtkAtriaPreflight
 * @brief   properties of a mesh before it is made
 *
 * Takes the mesher's input and properties, and makes the domain and the octree, but no mesh.
 *
 * Output: vtkTable with the columns `Quantity` (string), `Value` (double) and `Unit` (string: m, degrees, H for
 * building heights, or empty); docs/arrays.md lists the quantities. Quantities that the model does not have, such as an
 * opening, have no row. Field arrays: `Warning` (string, points to check before meshing), `OpeningSurface` and
 * `GapSurface` (string, the surfaces between which the narrowest opening and gap lie; empty without).
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
   * SizeMax, SizeMid and SizeMin of the last run: sizes of 0 are replaced by values from the model. With these sizes
   * the mesher makes the mesh that was estimated. 0 before a run.
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
