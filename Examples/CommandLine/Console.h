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

  /// Shows the progress of `algorithm` as the part [first, last] of the whole, and stops it at Ctrl-C: filters of ours
  /// by their abort flag, so that the caller must ask wasInterrupted() after them; VTK's by throwing Failure, as not
  /// all of them look at theirs. `phase` is for those that have no text of their own.
  void follow(vtkAlgorithm* algorithm, double first, double last, const std::string& phase = {});
  /// Takes SIGTERM for Ctrl-C, too: it is what mpiexec sends where that was pressed, or where another rank has ended.
  static void catchTermination();
  /// Whether Ctrl-C was pressed. The second time it ends the program at once.
  static bool wasInterrupted();
  /// Throws Failure if so.
  static void throwIfInterrupted();
  /// Moves the bar without an algorithm.
  void progress(double fraction, const std::string& phase);
  /// Removes the bar, so that text can follow.
  void clearBar();

  /// VTK's errors since the last call, freed from addresses and source lines. Warnings are printed as they
  /// come.
  std::vector<std::string> takeErrors();
  bool hasErrors() const;

private:
  class Window;
  vtkSmartPointer<Window> window;
  vtkSmartPointer<vtkOutputWindow> previous;
  bool terminal = false;
  double furthest = 0.0; ///< what follows does not fall behind it
  std::string shown;
};

} // namespace atria::tool
