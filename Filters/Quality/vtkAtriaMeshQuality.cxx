// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaMeshQuality.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaMeshQuality);

vtkAtriaMeshQuality::vtkAtriaMeshQuality() = default;
