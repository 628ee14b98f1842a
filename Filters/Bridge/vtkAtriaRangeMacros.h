// SPDX-License-Identifier: GPL-3.0-or-later
/// Macro for properties with a range.
/**
 * Properties that have a range. VTK's vtkSetClampMacro turns a size of -5 into the smallest allowed one, and accepts
 * values that are no numbers: the run then silently differs from the request. These macros keep values as they are
 * given; a run with a value outside its range is an error that names the property (see PropertyRange.h).
 */
#ifndef vtkAtriaRangeMacros_h
#define vtkAtriaRangeMacros_h

#include "vtkSetGet.h"

/**
 * Declares Set##name, and the range as Get##name##MinValue and Get##name##MaxValue.
 */
#define vtkAtriaSetInRangeMacro(name, type, least, most)                                                               \
  vtkSetMacro(name, type);                                                                                             \
  virtual type Get##name##MinValue() { return least; }                                                                 \
  virtual type Get##name##MaxValue() { return most; }

#endif
