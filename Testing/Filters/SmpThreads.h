// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace atria::testing {

/// Asks VTK to run filters on so many threads, also where its backend is Sequential. The backend STDThread takes no
/// more than the machine has.
void useThreads(int count);

} // namespace atria::testing
