// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

class vtkPolyData;

namespace atria::testing {

/// What is wrong with the output of a reader of models that reported no error; empty if it is what
/// vtkAtriaSurfaceReader promises.
std::string brokenPromise(vtkPolyData* output);

} // namespace atria::testing
