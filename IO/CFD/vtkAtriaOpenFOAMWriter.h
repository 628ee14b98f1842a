// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkAtriaOpenFOAMWriter_h
#define vtkAtriaOpenFOAMWriter_h

#include "AtriaIOCFDModule.h"
#include "vtkAlgorithm.h"

class ATRIAIOCFD_EXPORT vtkAtriaOpenFOAMWriter : public vtkAlgorithm
{
public:
  static vtkAtriaOpenFOAMWriter* New();
  vtkTypeMacro(vtkAtriaOpenFOAMWriter, vtkAlgorithm);

protected:
  vtkAtriaOpenFOAMWriter();
  ~vtkAtriaOpenFOAMWriter() override = default;

private:
  vtkAtriaOpenFOAMWriter(const vtkAtriaOpenFOAMWriter&) = delete;
  void operator=(const vtkAtriaOpenFOAMWriter&) = delete;
};

#endif
