// SPDX-License-Identifier: GPL-3.0-or-later
/// Exceptions of the core.
#pragma once

#include <stdexcept>

namespace atria {

/// Base of all errors the core throws. The message says what is wrong, with which input, and what to do.
class Error : public std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/// Thrown out of a stage when ProgressMonitor::aborted() says so. Not an error: the caller asked for it.
class Aborted : public std::exception
{
public:
  const char* what() const noexcept override { return "aborted"; }
};

} // namespace atria
