// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkOutputWindow;

namespace atria::testing {

/// Collects VTK's errors and warnings while it lives. Those that are not taken fail the test.
class VtkErrorGuard
{
public:
  VtkErrorGuard();
  ~VtkErrorGuard();
  VtkErrorGuard(const VtkErrorGuard&) = delete;
  VtkErrorGuard& operator=(const VtkErrorGuard&) = delete;

  /// What was reported since the last call, one text a message; these are then expected.
  std::vector<std::string> takeErrors();
  std::vector<std::string> takeWarnings();
  /// Those warnings alone in which `part` stands.
  std::vector<std::string> takeWarnings(const std::string& part);

private:
  class Window;
  vtkSmartPointer<Window> window;
  vtkSmartPointer<vtkOutputWindow> previous;
};

/// Fixture of every filter's tests: any VTK error or warning that a test did not take fails it.
class VtkTest : public ::testing::Test
{
protected:
  VtkErrorGuard messages;
};

} // namespace atria::testing
