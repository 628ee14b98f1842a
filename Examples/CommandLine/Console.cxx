// SPDX-License-Identifier: GPL-3.0-or-later
#include "Console.h"

#include "Commands.h"
#include "Platform.h"
#include "Words.h"

#include <vtkAlgorithm.h>
#include <vtkCommand.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <functional>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <regex>
#include <sstream>
#include <string_view>
#include <utility>

namespace atria::tool {

namespace {

/// VTK writes "ERROR: In <file>, line <n>\n<class> (<address>): <text>\n\n".
std::string plainText(const std::string& message)
{
  static const std::regex prefix(
      R"(^\s*(ERROR|[A-Za-z ]*Warning): In [^\n]*, line \d+\n(\w+ \((0x)?[0-9a-fA-F]+\): )?)");
  std::string text = std::regex_replace(message, prefix, "", std::regex_constants::format_first_only);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
  {
    text.pop_back();
  }
  return text;
}

/// The pipeline adds this to an error that the filter itself already explained.
bool isPipelineEcho(const std::string& text) { return text.rfind("Algorithm vtk", 0) == 0; }

volatile std::sig_atomic_t interrupted = 0;

/// Ends the program at the second signal.
extern "C" void noteInterrupt(int signal)
{
  interrupted = 1;
  std::signal(signal, SIG_DFL);
}

void catchInterrupts(int signal) { std::signal(signal, noteInterrupt); }

bool isOurs(vtkAlgorithm* algorithm) { return std::string_view(algorithm->GetClassName()).starts_with("vtkAtria"); }

class ProgressCommand : public vtkCommand
{
public:
  static ProgressCommand* New() { return new ProgressCommand; }
  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    auto* algorithm = static_cast<vtkAlgorithm*>(caller);
    if (Console::wasInterrupted() && isOurs(algorithm))
    {
      algorithm->AbortExecuteOn();
      return;
    }
    Console::throwIfInterrupted();
    const char* text = algorithm->GetProgressText();
    show(*static_cast<double*>(data), text && *text ? text : phase);
  }
  std::string phase;
  std::function<void(double, const std::string&)> show;
};

/// Writes a line at once: std::cerr has no buffer, and mpiexec may put parts of a line elsewhere.
void writeLine(const char* kind, const std::string& text)
{
  std::cerr << std::string("atria: ") + kind + ": " + inOptions(text) + '\n';
}

} // namespace

class Console::Window : public vtkOutputWindow
{
public:
  static Window* New();
  vtkTypeMacro(Window, vtkOutputWindow);

  void DisplayText(const char* text) override { console->warning(plainText(text)); }
  void DisplayWarningText(const char* text) override { console->warning(plainText(text)); }
  void DisplayGenericWarningText(const char* text) override { console->warning(plainText(text)); }
  void DisplayDebugText(const char*) override {}
  void DisplayErrorText(const char* text) override
  {
    const std::lock_guard lock(mutex);
    errors.push_back(plainText(text));
  }

  Console* console = nullptr;
  std::vector<std::string> errors;

private:
  std::mutex mutex;
};
vtkStandardNewMacro(Console::Window);

Console::Console()
    : window(vtkSmartPointer<Window>::New()), previous(vtkOutputWindow::GetInstance()), terminal(errorsGoToTerminal())
{
  window->console = this;
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // VTK also logs what it writes to the window
  vtkOutputWindow::SetInstance(window);
  catchInterrupts(SIGINT);
}

Console::~Console()
{
  clearBar();
  vtkOutputWindow::SetInstance(previous);
}

void Console::error(const std::string& text)
{
  clearBar();
  writeLine("error", text);
}

void Console::warning(const std::string& text)
{
  clearBar();
  writeLine("warning", text);
}

void Console::note(const std::string& text)
{
  clearBar();
  writeLine("note", text);
}

void Console::catchTermination() { catchInterrupts(SIGTERM); }

bool Console::wasInterrupted() { return interrupted != 0; }

void Console::throwIfInterrupted()
{
  if (wasInterrupted())
  {
    throw Failure(Interrupted, "interrupted; what was not complete has not been written");
  }
}

void Console::follow(vtkAlgorithm* algorithm, double first, double last, const std::string& phase)
{
  vtkNew<ProgressCommand> command;
  command->phase = phase;
  command->show = [this, first, last](double fraction, const std::string& text) {
    progress(first + fraction * (last - first), text);
  };
  algorithm->AddObserver(vtkCommand::ProgressEvent, command);
}

void Console::progress(double fraction, const std::string& phase)
{
  if (!terminal)
  {
    return;
  }
  constexpr int width = 30;
  furthest = std::clamp(fraction, furthest, 1.0);
  const double done = furthest;
  const int filled = static_cast<int>(std::lround(done * width));
  std::ostringstream text;
  text << '[' << std::string(filled, '#') << std::string(width - filled, ' ') << "] " << std::setw(3)
       << std::lround(100 * done) << " % " << phase.substr(0, 36);
  const std::string line = text.str();
  if (line != shown)
  {
    std::cerr << '\r' << line << "\033[K" << std::flush;
    shown = line;
  }
}

void Console::clearBar()
{
  if (!shown.empty())
  {
    std::cerr << "\r\033[K" << std::flush;
    shown.clear();
  }
}

bool Console::hasErrors() const { return !window->errors.empty(); }

std::vector<std::string> Console::takeErrors()
{
  std::vector<std::string> errors = std::exchange(window->errors, {});
  const bool explained = std::any_of(errors.begin(), errors.end(), std::not_fn(isPipelineEcho));
  if (explained)
  {
    errors.erase(std::remove_if(errors.begin(), errors.end(), isPipelineEcho), errors.end());
  }
  return errors;
}

} // namespace atria::tool
