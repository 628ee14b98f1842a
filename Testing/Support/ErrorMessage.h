// SPDX-License-Identifier: GPL-3.0-or-later
/// The message of an Error that a call throws.
#pragma once

#include "Support/Error.h"

#include <functional>
#include <string>

namespace atria::testing {

/// Returns the message of the Error that a call throws; an empty text if it throws none.
inline std::string messageOf(const std::function<void()>& call)
{
  try
  {
    call();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return {};
}

} // namespace atria::testing
