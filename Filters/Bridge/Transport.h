// SPDX-License-Identifier: GPL-3.0-or-later
/// Data objects from rank to rank.
#pragma once

#include <vtkSmartPointer.h>

class vtkDataObject;
class vtkMultiProcessController;

namespace atria {

/// Unstructured grids, surfaces and collections of these go array by array, without a copy, and arrive with the same
/// bits; arrays of neither numbers nor strings stay behind. All else goes as VTK sends it. `data` may be null.
void sendData(vtkDataObject* data, int rank, vtkMultiProcessController& controller);

/// What sendData() of `rank` sent.
vtkSmartPointer<vtkDataObject> receiveData(int rank, vtkMultiProcessController& controller);

} // namespace atria
