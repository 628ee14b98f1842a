// SPDX-License-Identifier: GPL-3.0-or-later
/// Sends data objects between ranks.
#pragma once

#include <vtkSmartPointer.h>

class vtkDataObject;
class vtkMultiProcessController;

namespace atria {

/// Sends a data object. Unstructured grids, surfaces and collections of these are sent array by array, without a copy,
/// and arrive with the same bits; arrays of neither numbers nor strings are omitted. Other types are sent by VTK.
/// `data` may be null.
void sendData(vtkDataObject* data, int rank, vtkMultiProcessController& controller);

/// Receives the object that `rank` sends by sendData().
vtkSmartPointer<vtkDataObject> receiveData(int rank, vtkMultiProcessController& controller);

} // namespace atria
