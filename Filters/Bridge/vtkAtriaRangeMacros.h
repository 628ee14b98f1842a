// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Properties that have a range. VTK's vtkSetClampMacro makes a size of -5 the smallest that there is, and lets what is
 * no number pass: the run then does something else than was asked for, and nobody is told. So values are kept as they
 * are given, and a run with one outside of its range is an error that names it (see PropertyRange.h).
 */
#ifndef vtkAtriaRangeMacros_h
#define vtkAtriaRangeMacros_h

#include "vtkSetGet.h"

/**
 * Set##name, and the range as Get##name##MinValue and Get##name##MaxValue.
 */
#define vtkAtriaSetInRangeMacro(name, type, least, most)                                                               \
  vtkSetMacro(name, type);                                                                                             \
  virtual type Get##name##MinValue() { return least; }                                                                 \
  virtual type Get##name##MaxValue() { return most; }

#endif
