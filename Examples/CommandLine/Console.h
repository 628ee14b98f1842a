// SPDX-License-Identifier: GPL-3.0-or-later
/// Output to the user on standard error: messages of VTK in plain words, and a progress bar on a terminal.
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

  /// Shows the progress of `algorithm` as the part [first, last] of the whole, and stops it at Ctrl-C. Atria's filters
  /// are stopped by their abort flag, so that the caller must check wasInterrupted() after them. VTK's are stopped by
  /// throwing Failure, as not all of them check their flag. `phase` is for filters without a text of their own.
  void follow(vtkAlgorithm* algorithm, double first, double last, const std::string& phase = {});
  /// Treats SIGTERM like Ctrl-C: mpiexec sends it after Ctrl-C, or when another rank has ended.
  static void catchTermination();
  /// True if Ctrl-C was pressed. The second time it ends the program at once.
  static bool wasInterrupted();
  /// Throws Failure if Ctrl-C was pressed.
  static void throwIfInterrupted();
  /// Moves the bar without an algorithm.
  void progress(double fraction, const std::string& phase);
  /// Removes the bar, so that text can follow.
  void clearBar();

  /// Returns VTK's errors since the last call, without addresses and source lines. Warnings are printed at once.
  std::vector<std::string> takeErrors();
  bool hasErrors() const;

private:
  class Window;
  vtkSmartPointer<Window> window;
  vtkSmartPointer<vtkOutputWindow> previous;
  bool terminal = false;
  double furthest = 0.0; ///< the bar never moves back behind it
  std::string shown;
};

} // namespace atria::tool
