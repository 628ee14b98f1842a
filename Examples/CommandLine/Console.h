// SPDX-License-Identifier: GPL-3.0-or-later
/// What people see on standard error: messages of VTK in plain words, and a progress bar on a terminal.
#pragma once

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkOutputWindow;

namespace atria::tool {

class Console
{
public:
  Console();
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  void error(const std::string& text);
  void warning(const std::string& text);
  void note(const std::string& text);

  /// Shows the progress of `algorithm` as the part [first, last] of the whole.
  void follow(vtkAlgorithm* algorithm, double first, double last);
  /// Moves the bar without an algorithm.
  void progress(double fraction, const std::string& phase);
  /// Removes the bar, so that text can follow.
  void clearBar();

  /// VTK's errors since the last call, freed from addresses and source lines. Warnings are printed as they
  /// come.
  std::vector<std::string> takeErrors();

private:
  class Window;
  vtkSmartPointer<Window> window;
  vtkSmartPointer<vtkOutputWindow> previous;
  bool terminal = false;
  std::string shown;
};

} // namespace atria::tool
