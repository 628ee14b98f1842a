// SPDX-License-Identifier: GPL-3.0-or-later
/// What a run says of properties outside of their range.
#pragma once

namespace atria {

/// Throws Error with property, value and range unless the value is in the range. Limits of 1e30 and beyond, and those
/// of int, are none; but infinity is in no range.
void checkRange(const char* property, double value, double least, double most);

} // namespace atria

/// For methods of a class whose property was declared by vtkAtriaSetInRangeMacro.
#define atriaCheckRange(name)                                                                                          \
  atria::checkRange(#name, this->name, this->Get##name##MinValue(), this->Get##name##MaxValue())
