// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class   vtkSMAtriaDisplayHelper
 * @brief   how representations of Atria's data begin
 *
 * Named in the hints of a representation. What the attributes of the hint do, each optional:
 * - `cull_front="1"`: faces seen from outside of the fluid are not drawn, so that the domain is open to the eye;
 * - `array="SurfaceId" names="SurfaceName"`: the cells' array is shown in categorical colors, with the names that the
 *   array of strings has, where the data has cells and not more names than a legend holds. Without `names` the colors
 *   are those that the array has elsewhere;
 * - `x="Value" series="PDF"`: a chart shows one column over another.
 */
#ifndef vtkSMAtriaDisplayHelper_h
#define vtkSMAtriaDisplayHelper_h

#include "AtriaParaViewDisplayModule.h" // For export macro
#include "vtkSMProxyInitializationHelper.h"

class ATRIAPARAVIEWDISPLAY_EXPORT vtkSMAtriaDisplayHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMAtriaDisplayHelper* New();
  vtkTypeMacro(vtkSMAtriaDisplayHelper, vtkSMProxyInitializationHelper);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void PostInitializeProxy(vtkSMProxy* proxy, vtkPVXMLElement* xml, vtkMTimeType time) override;

protected:
  vtkSMAtriaDisplayHelper();
  ~vtkSMAtriaDisplayHelper() override;

private:
  vtkSMAtriaDisplayHelper(const vtkSMAtriaDisplayHelper&) = delete;
  void operator=(const vtkSMAtriaDisplayHelper&) = delete;
};

#endif
