// SPDX-License-Identifier: GPL-3.0-or-later
#include "ConfigFile.h"

#include "Files.h"
#include "Numbers.h"
#include "OutputFiles.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace atria::tool {

namespace {

std::string quoted(const std::string& value)
{
  double number = 0.0;
  return value == "true" || value == "false" || readNumber(value, number) ? value
                                                                          : CLI::detail::convert_arg_for_ini(value);
}

/// Returns the values in TOML: a list if there are several.
std::string valueOf(const CLI::Option& option)
{
  const std::vector<std::string> values = option.reduced_results();
  if (values.size() == 1)
  {
    return quoted(values.front());
  }
  std::string text;
  for (const std::string& value : values)
  {
    text += (text.empty() ? "[" : ", ") + quoted(value);
  }
  return text + "]";
}

void describe(std::ostringstream& out, const CLI::Option& option)
{
  std::istringstream lines(option.get_description());
  for (std::string text; std::getline(lines, text);)
  {
    out << "# " << text << '\n';
  }
  const bool isFlag = option.get_expected_min() == 0;
  const std::string form = isFlag ? "true" : option.get_type_name();
  if (option.count() > 0)
  {
    out << option.get_single_name() << " = " << valueOf(option) << '\n';
  }
  else
  {
    const std::string standard = option.get_default_str();
    out << "# " << option.get_single_name() << " = " << (standard.empty() || isFlag ? form : quoted(standard)) << '\n';
  }
}

} // namespace

std::string configFileOf(const CLI::App& command)
{
  std::ostringstream out;
  out << "# Options of atria " << command.get_name()
      << " for --config. What stands here as a comment has its default.\n[" << command.get_name() << "]\n";
  std::vector<std::string> groups;
  for (const CLI::Option* option : command.get_options())
  {
    const std::string& group = option->get_group();
    if (option->get_configurable() && std::find(groups.begin(), groups.end(), group) == groups.end())
    {
      groups.push_back(group);
    }
  }
  for (const std::string& group : groups)
  {
    out << "\n## " << group << "\n\n";
    for (const CLI::Option* option : command.get_options())
    {
      if (option->get_configurable() && option->get_group() == group)
      {
        describe(out, *option);
      }
    }
  }
  return out.str();
}

void declareConfigFile(CLI::App& command, std::string& file, const char* instead)
{
  command
      .add_option("--write-config", file,
                  std::string("Write these options, and what others there are, to a file for --config, and ") + instead)
      ->configurable(false)
      ->type_name("OUT.toml");
}

bool writesConfigFile(const CLI::App& command, const std::string& file)
{
  if (file.empty())
  {
    return false;
  }
  checkOutput("--write-config", file, ".toml");
  writeText(file, configFileOf(command));
  return true;
}

} // namespace atria::tool
