// SPDX-License-Identifier: GPL-3.0-or-later
/// Errors for properties outside of their range.
#pragma once

namespace atria {

/// Throws Error with property, value and range if the value is outside the range. Limits of 1e30 and beyond, and those
/// of int, count as no limit; infinity is outside every range.
void checkRange(const char* property, double value, double least, double most);

} // namespace atria

/// Checks a property in a method of its class. The property must be declared by vtkAtriaSetInRangeMacro.
#define atriaCheckRange(name)                                                                                          \
  atria::checkRange(#name, this->name, this->Get##name##MinValue(), this->Get##name##MaxValue())
