// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/VtkErrorGuard.h"

#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace atria::testing {

class VtkErrorGuard::Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);

  void DisplayText(const char* text) override { keep(warnings, text); }
  void DisplayErrorText(const char* text) override { keep(errors, text); }
  void DisplayWarningText(const char* text) override { keep(warnings, text); }
  void DisplayGenericWarningText(const char* text) override { keep(warnings, text); }
  void DisplayDebugText(const char*) override {}

  std::vector<std::string> errors;
  std::vector<std::string> warnings;

private:
  void keep(std::vector<std::string>& list, const char* text)
  {
    const std::lock_guard lock(mutex);
    list.emplace_back(text);
  }
  std::mutex mutex;
};
vtkStandardNewMacro(VtkErrorGuard::Window);

VtkErrorGuard::VtkErrorGuard() : window(vtkSmartPointer<Window>::New()), previous(vtkOutputWindow::GetInstance())
{
  vtkOutputWindow::SetInstance(window);
}

VtkErrorGuard::~VtkErrorGuard()
{
  vtkOutputWindow::SetInstance(previous);
  for (const std::string& text : window->errors)
  {
    ADD_FAILURE() << "unexpected VTK error: " << text;
  }
  for (const std::string& text : window->warnings)
  {
    ADD_FAILURE() << "unexpected VTK warning: " << text;
  }
}

std::vector<std::string> VtkErrorGuard::takeErrors() { return std::exchange(window->errors, {}); }
std::vector<std::string> VtkErrorGuard::takeWarnings() { return std::exchange(window->warnings, {}); }

std::vector<std::string> VtkErrorGuard::takeWarnings(const std::string& part)
{
  std::vector<std::string>& all = window->warnings;
  const auto wanted = std::stable_partition(
      all.begin(), all.end(), [&](const std::string& text) { return text.find(part) == std::string::npos; });
  std::vector<std::string> taken(wanted, all.end());
  all.erase(wanted, all.end());
  return taken;
}

} // namespace atria::testing
