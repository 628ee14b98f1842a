// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace atria::testing {

/// Makes filters run on so many threads, whatever VTK was built with.
void useThreads(int count);

} // namespace atria::testing
