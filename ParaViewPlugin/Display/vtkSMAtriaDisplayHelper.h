// SPDX-License-Identifier: GPL-3.0-or-later
/// Helper that sets up new representations of Atria's data in ParaView.
/**
 * @class   vtkSMAtriaDisplayHelper
 * @brief   initial display of representations of Atria's data
 *
 * The hints of a representation name it. The attributes of the hint, each optional, are:
 * - `cull_front="1"`: faces seen from outside of the fluid are not drawn, so that the domain is open to the eye;
 * - `array="SurfaceId" names="SurfaceName"`: the cells' array is shown in categorical colors, and those that occur have
 *   the names of the array of strings, as long as a legend can hold them, also after the data has changed. With
 *   `strong="1"` the colors suit lines. Without `names` they are those that the array has elsewhere;
 * - `line_width="4"`: in pixels; points are twice as large;
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
