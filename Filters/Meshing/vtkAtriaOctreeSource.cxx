// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOctreeSource.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaOctreeSource);

vtkAtriaOctreeSource::vtkAtriaOctreeSource() = default;
