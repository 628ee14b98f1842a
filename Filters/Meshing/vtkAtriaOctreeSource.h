// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkAtriaOctreeSource_h
#define vtkAtriaOctreeSource_h

#include "AtriaFiltersMeshingModule.h"
#include "vtkAlgorithm.h"

class ATRIAFILTERSMESHING_EXPORT vtkAtriaOctreeSource : public vtkAlgorithm
{
public:
  static vtkAtriaOctreeSource* New();
  vtkTypeMacro(vtkAtriaOctreeSource, vtkAlgorithm);

protected:
  vtkAtriaOctreeSource();
  ~vtkAtriaOctreeSource() override = default;

private:
  vtkAtriaOctreeSource(const vtkAtriaOctreeSource&) = delete;
  void operator=(const vtkAtriaOctreeSource&) = delete;
};

#endif
