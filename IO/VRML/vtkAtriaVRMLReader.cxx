// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaVRMLReader.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaVRMLReader);

vtkAtriaVRMLReader::vtkAtriaVRMLReader() = default;
