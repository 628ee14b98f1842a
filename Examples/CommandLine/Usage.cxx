// SPDX-License-Identifier: GPL-3.0-or-later
#include "Usage.h"

#include "Support/NamePattern.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <vector>

namespace atria::tool {

namespace {

/// Returns the requested subcommand, or the program itself.
const CLI::App& commandOf(const CLI::App& app)
{
  const std::vector<CLI::App*> requested = app.get_subcommands();
  return requested.empty() ? app : *requested.front();
}

std::vector<std::string> optionsOf(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      names.push_back("--" + name);
    }
  }
  return names;
}

std::vector<std::string> subcommandNames(const CLI::App& app)
{
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
  {
    names.push_back(command->get_name());
  }
  return names;
}

std::string didYouMean(const std::string& wanted, const std::vector<std::string>& names)
{
  const std::string nearest = nearestName(wanted, names);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

/// Returns an error message on unexpected arguments: an unknown option, rather than its possible value.
std::string unexpected(const CLI::App& app)
{
  const std::vector<std::string> left = app.remaining(true);
  const auto option = std::find_if(left.begin(), left.end(), [](const std::string& s) { return s.starts_with('-'); });
  if (option != left.end())
  {
    const std::string name = option->substr(0, option->find('='));
    return "there is no option " + name + didYouMean(name, optionsOf(commandOf(app)));
  }
  const CLI::App& command = commandOf(app);
  if (&command == &app && !left.empty())
  {
    return "there is no subcommand " + left.front() + didYouMean(left.front(), subcommandNames(app));
  }
  return left.empty() ? "" : "'" + left.back() + "' is one argument too many";
}

/// Returns an error message for "INI was not able to parse mesh.size-mni".
std::string unknownKey(const CLI::App& app, const std::string& message)
{
  const std::string key = message.substr(message.rfind(' ') + 1);
  const auto dot = key.rfind('.');
  const std::string section = dot == std::string::npos ? "" : key.substr(0, dot);
  const std::vector<const CLI::App*> commands =
      app.get_subcommands([&](const CLI::App* candidate) { return candidate->get_name() == section; });
  const CLI::App* command = section.empty() ? &app : commands.empty() ? nullptr : commands.front();
  const std::string name = "--" + key.substr(dot == std::string::npos ? 0 : dot + 1);
  return "--config: there is no option for " + key + (command ? didYouMean(name, optionsOf(*command)) : "") +
         (section.empty() ? "; options stand in a section such as [mesh]" : "");
}

} // namespace

std::string usageMessage(const CLI::App* app, const CLI::Error& error)
{
  std::string text = error.what();
  if (dynamic_cast<const CLI::ConfigError*>(&error))
  {
    text = unknownKey(*app, text);
  }
  else if (const std::string what = unexpected(*app); !what.empty())
  {
    text = what;
  }
  const CLI::App& command = commandOf(*app);
  return "atria: error: " + text + "\nSee atria " + (&command == app ? "" : command.get_name() + " ") + "--help.\n";
}

} // namespace atria::tool
