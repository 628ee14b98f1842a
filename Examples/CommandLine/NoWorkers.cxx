// SPDX-License-Identifier: GPL-3.0-or-later
/// Workers of a build without VTK's MPI.
#include "Workers.h"

namespace atria::tool {

class Workers::Ranks
{
};

Workers::Workers(int*, char***) {}

Workers::~Workers() = default;

Workers::operator bool() const { return false; }

bool Workers::isWorker() const { return false; }

int Workers::serve(const Work&) { return 0; }

void Workers::doTogether(const std::string&, const std::function<void(vtkMultiProcessController&)>&) const {}

int Workers::end(int status) { return status; }

} // namespace atria::tool
