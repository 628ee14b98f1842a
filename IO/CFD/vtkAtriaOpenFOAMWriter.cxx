// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkAtriaOpenFOAMWriter);

vtkAtriaOpenFOAMWriter::vtkAtriaOpenFOAMWriter() = default;
