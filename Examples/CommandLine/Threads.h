// SPDX-License-Identifier: GPL-3.0-or-later
/// Sets and returns the number of VTK's threads.
#pragma once

namespace atria::tool {

/// Limits VTK's threads; 0 leaves the choice to VTK.
void setThreads(int count);
int threadsInUse();

} // namespace atria::tool
