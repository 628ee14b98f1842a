// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkAtriaVRMLReader_h
#define vtkAtriaVRMLReader_h

#include "AtriaIOVRMLModule.h"
#include "vtkPolyDataAlgorithm.h"

class ATRIAIOVRML_EXPORT vtkAtriaVRMLReader : public vtkPolyDataAlgorithm
{
public:
  static vtkAtriaVRMLReader* New();
  vtkTypeMacro(vtkAtriaVRMLReader, vtkPolyDataAlgorithm);

protected:
  vtkAtriaVRMLReader();
  ~vtkAtriaVRMLReader() override = default;

private:
  vtkAtriaVRMLReader(const vtkAtriaVRMLReader&) = delete;
  void operator=(const vtkAtriaVRMLReader&) = delete;
};

#endif
