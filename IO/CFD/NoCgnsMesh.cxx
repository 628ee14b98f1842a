// SPDX-License-Identifier: GPL-3.0-or-later
#include "CgnsMesh.h"

#include "Support/Error.h"

namespace atria {

bool cgnsIsAvailable() { return false; }

void writeCgnsMesh(const std::filesystem::path&, const SolverMesh&, const RunContext&)
{
  throw Error("Atria was built without libcgns; install it (Debian: libcgns-dev) and build again");
}

} // namespace atria
