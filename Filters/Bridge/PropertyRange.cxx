// SPDX-License-Identifier: GPL-3.0-or-later
#include "PropertyRange.h"

#include "Support/Error.h"

#include <limits>
#include <sstream>

namespace atria {

void checkRange(const char* property, double value, double least, double most)
{
  if (value >= least && value <= most) // false for a value that is no number
  {
    return;
  }
  constexpr double unlimited = 1e30;
  const bool hasLeast = least > -unlimited;
  const bool hasMost = most < unlimited && most != std::numeric_limits<int>::max();
  std::ostringstream text;
  text.precision(10);
  text << property << " is " << value << "; it must be a number ";
  if (hasLeast && hasMost)
  {
    text << "from " << least << " to " << most;
  }
  else if (hasLeast)
  {
    text << "of at least " << least;
  }
  else
  {
    text << "that is finite";
  }
  throw Error(text.str());
}

} // namespace atria
