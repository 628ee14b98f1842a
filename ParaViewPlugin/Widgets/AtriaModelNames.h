// SPDX-License-Identifier: GPL-3.0-or-later
/// Names and bounds of the model that a filter is given, for the panels.
#pragma once

#include <QStringList>

#include <vtkBoundingBox.h>

class vtkSMProxy;

namespace atria {

/// Returns names of the surfaces in the data of the proxy's input or, for a reader, in its own; empty before there is
/// any.
QStringList surfaceNamesOf(vtkSMProxy* proxy);

/// Returns the bounds of the data of the proxy's input; not valid before there is any.
vtkBoundingBox modelBoundsOf(vtkSMProxy* proxy);

} // namespace atria
