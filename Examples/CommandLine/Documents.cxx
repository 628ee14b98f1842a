// SPDX-License-Identifier: GPL-3.0-or-later
#include "Documents.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

namespace atria::tool {

namespace {

std::vector<const CLI::App*> subcommandsOf(const CLI::App& app)
{
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<std::string> namesOf(const CLI::Option& option)
{
  std::vector<std::string> names;
  std::ranges::transform(option.get_snames(), std::back_inserter(names), [](const auto& name) { return "-" + name; });
  std::ranges::transform(option.get_lnames(), std::back_inserter(names), [](const auto& name) { return "--" + name; });
  return names;
}

/// Returns the values of a type such as axes|walls|domain; none for other types.
std::vector<std::string> valuesOf(const CLI::Option& option)
{
  const std::string type = option.get_type_name();
  const bool isChoice = type.find('|') != std::string::npos &&
                        std::ranges::all_of(type, [](unsigned char c) { return std::islower(c) || c == '|'; });
  return isChoice ? CLI::detail::split(type, '|') : std::vector<std::string>();
}

bool takesValue(const CLI::Option& option) { return option.get_expected_min() > 0; }

std::string joined(const std::vector<std::string>& words, const char* between)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : between) + word;
  }
  return text;
}

/// Returns all names of all options of a command.
std::string optionWords(const CLI::App& command)
{
  std::vector<std::string> words;
  for (const CLI::Option* option : command.get_options())
  {
    const std::vector<std::string> names = namesOf(*option);
    words.insert(words.end(), names.begin(), names.end());
  }
  return joined(words, " ");
}

std::string bashScript(const CLI::App& app)
{
  std::vector<std::string> commands;
  std::ostringstream options;
  std::ostringstream values;
  for (const CLI::App* command : subcommandsOf(app))
  {
    commands.push_back(command->get_name());
    options << "    " << command->get_name() << ") words='" << optionWords(*command) << "' ;;\n";
    for (const CLI::Option* option : command->get_options())
    {
      if (const std::vector<std::string> choice = valuesOf(*option); !choice.empty())
      {
        values << "    '" << command->get_name() << ' ' << namesOf(*option).back() << "') words='"
               << joined(choice, " ") << "' ;;\n";
      }
    }
  }
  std::ostringstream out;
  out << "_atria() {\n  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    words='"
      << joined(commands, " ") << ' ' << optionWords(app)
      << "'\n    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n    return\n  fi\n"
         "  case \"${COMP_WORDS[1]} $before\" in\n"
      << values.str() << "  esac\n  [ -n \"$words\" ] || case \"$current\" in -*) case \"${COMP_WORDS[1]}\" in\n"
      << options.str() << "  esac ;; esac\n"
      << "  if [ -n \"$words\" ]; then\n    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "  else\n    COMPREPLY=($(compgen -f -- \"$current\"))\n  fi\n}\ncomplete -o filenames -F _atria atria\n";
  return out.str();
}

/// Returns a text in single quotes.
std::string fishText(const std::string& text)
{
  std::string out = "'";
  for (const char c : text)
  {
    out += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c == '\n' ? ' ' : c);
  }
  return out + "'";
}

std::string fishScript(const CLI::App& app)
{
  std::ostringstream out;
  for (const CLI::App* command : subcommandsOf(app))
  {
    const std::string& name = command->get_name();
    out << "complete -c atria -n __fish_use_subcommand -f -a " << name << " -d " << fishText(command->get_description())
        << '\n';
    for (const CLI::Option* option : command->get_options())
    {
      if (option->get_positional() && namesOf(*option).empty())
      {
        continue;
      }
      out << "complete -c atria -n '__fish_seen_subcommand_from " << name << '\'';
      for (const std::string& shortName : option->get_snames())
      {
        out << " -s " << shortName;
      }
      for (const std::string& longName : option->get_lnames())
      {
        out << " -l " << longName;
      }
      const std::vector<std::string> choice = valuesOf(*option);
      out << (takesValue(*option) ? " -r" : "") << (choice.empty() ? "" : " -f -a " + fishText(joined(choice, " ")))
          << " -d " << fishText(option->get_description()) << '\n';
    }
  }
  return out.str();
}

/// Returns text for troff: escapes backslashes, hyphens that are minus signs, and lines that begin like requests.
std::string troff(const std::string& text)
{
  std::string out;
  for (const char c : text)
  {
    const bool lineStart = out.empty() || out.back() == '\n';
    out += lineStart && (c == '.' || c == '\'') ? "\\&" : "";
    out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c);
  }
  return out;
}

void manualOfOption(std::ostringstream& out, const CLI::Option& option)
{
  const std::vector<std::string> names = namesOf(option);
  const std::string type = takesValue(option) ? option.get_type_name() : "";
  const std::string standard = option.get_default_str();
  out << ".TP\n\\fB" << troff(names.empty() ? option.get_single_name() : joined(names, ", ")) << "\\fR"
      << (type.empty() || names.empty() ? "" : " \\fI" + troff(type) + "\\fR") << '\n'
      << troff(option.get_description()) << (standard.empty() ? "" : troff(" (default: " + standard + ")")) << '\n';
}

void manualOfCommand(std::ostringstream& out, const CLI::App& command)
{
  out << ".SH ATRIA " << troff(CLI::detail::to_lower(command.get_name())) << "\n"
      << troff(command.get_description()) << ".\n";
  std::vector<std::string> groups;
  for (const CLI::Option* option : command.get_options())
  {
    if (std::ranges::find(groups, option->get_group()) == groups.end())
    {
      groups.push_back(option->get_group());
    }
  }
  for (const std::string& group : groups)
  {
    out << (group.empty() ? "" : ".SS " + troff(group) + '\n');
    for (const CLI::Option* option : command.get_options())
    {
      if (option->get_group() == group)
      {
        manualOfOption(out, *option);
      }
    }
  }
  if (!command.get_footer().empty())
  {
    out << ".SS Notes\n.nf\n" << troff(command.get_footer()) << "\n.fi\n";
  }
}

} // namespace

std::string completionFor(const CLI::App& app, const std::string& shell)
{
  return shell == "fish"  ? fishScript(app)
         : shell == "zsh" ? "#compdef atria\nautoload -U +X bashcompinit && bashcompinit\n" + bashScript(app)
                          : bashScript(app);
}

std::string manualOf(const CLI::App& app)
{
  std::ostringstream out;
  out << ".TH ATRIA 1 \"\" \"Atria " << ATRIA_TOOL_VERSION
      << "\"\n.SH NAME\natria \\- meshes architecture for flow simulation\n"
      << ".SH SYNOPSIS\n";
  for (const CLI::App* command : subcommandsOf(app))
  {
    out << "\\fBatria " << command->get_name() << "\\fR [options]\n.br\n";
  }
  out << ".SH DESCRIPTION\n" << troff(app.get_description()) << "\n.SH OPTIONS\n";
  for (const CLI::Option* option : app.get_options())
  {
    manualOfOption(out, *option);
  }
  for (const CLI::App* command : subcommandsOf(app))
  {
    manualOfCommand(out, *command);
  }
  return out.str();
}

} // namespace atria::tool
