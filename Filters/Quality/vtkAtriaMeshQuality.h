// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef vtkAtriaMeshQuality_h
#define vtkAtriaMeshQuality_h

#include "AtriaFiltersQualityModule.h"
#include "vtkAlgorithm.h"

class ATRIAFILTERSQUALITY_EXPORT vtkAtriaMeshQuality : public vtkAlgorithm
{
public:
  static vtkAtriaMeshQuality* New();
  vtkTypeMacro(vtkAtriaMeshQuality, vtkAlgorithm);

protected:
  vtkAtriaMeshQuality();
  ~vtkAtriaMeshQuality() override = default;

private:
  vtkAtriaMeshQuality(const vtkAtriaMeshQuality&) = delete;
  void operator=(const vtkAtriaMeshQuality&) = delete;
};

#endif
