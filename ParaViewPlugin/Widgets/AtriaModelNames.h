// SPDX-License-Identifier: GPL-3.0-or-later
/// What the panels know of the model that a filter is given.
#pragma once

#include <QStringList>

#include <vtkBoundingBox.h>

class vtkSMProxy;

namespace atria {

/// Names of the surfaces in the data of the proxy's input or, of a reader, in its own; empty before there is any.
QStringList surfaceNamesOf(vtkSMProxy* proxy);

/// Bounds of the data of the proxy's input; not valid before there is any.
vtkBoundingBox modelBoundsOf(vtkSMProxy* proxy);

} // namespace atria
