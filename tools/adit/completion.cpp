// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/completion.hpp"

#include <algorithm>
#include <iostream>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

CommandCompletion completion_of(const CLI::App& app, const std::string& path) {
  CommandCompletion entries;
  entries.path = path;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    entries.subcommands.push_back({sub->get_name(), sub->get_description(), false});
  }
  for (const CLI::Option* option : app.get_options()) {
    const bool takes_value = option->get_items_expected_max() > 0;
    if (option->get_positional()) entries.takes_files = true;
    for (const std::string& name : option->get_lnames()) {
      entries.options.push_back({"--" + name, option->get_description(), takes_value});
    }
  }
  return entries;
}

void collect_commands(std::vector<CommandCompletion>& commands, const CLI::App& app,
                      const std::string& path) {
  commands.push_back(completion_of(app, path));
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    collect_commands(commands, *sub, path.empty() ? sub->get_name() : path + " " + sub->get_name());
  }
}

/// In single quotes, for any of the shells.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string joined(const std::vector<CommandCompletion::Entry>& entries) {
  std::string text;
  for (const auto& entry : entries) text += (text.empty() ? "" : " ") + entry.text;
  return text;
}

/// A pattern of `case` for all words that go deeper into the tree.
std::string paths_pattern(const std::vector<CommandCompletion>& commands) {
  std::string pattern;
  for (const CommandCompletion& command : commands) {
    if (command.path.empty()) continue;
    pattern += (pattern.empty() ? "" : "|") + quoted(command.path);
  }
  return pattern;
}

std::string options_with_values(const CommandCompletion& command) {
  std::string pattern;
  for (const auto& option : command.options) {
    if (option.takes_value) pattern += (pattern.empty() ? "" : "|") + option.text;
  }
  return pattern;
}

/// Words with descriptions as zsh's _describe takes them; colons divide the two.
std::string described(const std::vector<CommandCompletion::Entry>& entries) {
  std::string text;
  for (const auto& entry : entries) text += " " + quoted(entry.text + ":" + entry.description);
  return text;
}

std::string fish_line(const std::string& path, const std::string& rest) {
  return "complete -c adit -n " + quoted("__adit_at " + quoted(path)) + " " + rest + "\n";
}

std::string fish_lines(const CommandCompletion& command) {
  std::string text;
  for (const auto& sub : command.subcommands) {
    text += fish_line(command.path, "-f -a " + sub.text + " -d " + quoted(sub.description));
  }
  for (const auto& option : command.options) {
    text +=
        fish_line(command.path, "-l " + option.text.substr(2) + (option.takes_value ? " -r" : "") +
                                    " -d " + quoted(option.description));
  }
  if (command.takes_files) text += fish_line(command.path, "-F");
  return text;
}

}  // namespace

std::vector<CommandCompletion> list_commands(const CLI::App& app) {
  std::vector<CommandCompletion> commands;
  collect_commands(commands, app, "");
  return commands;
}

std::string bash_completion(const std::vector<CommandCompletion>& commands) {
  std::string text = R"(# bash completion for adit, made by: adit completion bash
_adit() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} path= next i
  for ((i = 1; i < COMP_CWORD; i++)); do
    next=${path:+$path }${COMP_WORDS[i]}
    case $next in
      )" + paths_pattern(commands) +
                     R"() path=$next ;;
    esac
  done
  local words= options= valued= files=
  case $path in
)";
  for (const CommandCompletion& command : commands) {
    text += "    " + quoted(command.path) + ") words=" + quoted(joined(command.subcommands)) +
            " options=" + quoted(joined(command.options)) +
            " valued=" + quoted(options_with_values(command)) +
            " files=" + (command.takes_files ? "yes" : "") + " ;;\n";
  }
  return text + R"(  esac
  COMPREPLY=()
  if [[ -n $valued && "|$valued|" == *"|$previous|"* ]]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  elif [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current"; [[ -z $files ]] || compgen -f -- "$current")
  fi
}
complete -o filenames -F _adit adit
)";
}

std::string zsh_completion(const std::vector<CommandCompletion>& commands) {
  std::string text = R"(#compdef adit
# zsh completion for adit, made by: adit completion zsh
_adit() {
  local at= next word
  for word in ${words[2,CURRENT-1]}; do
    next=${at:+$at }$word
    case $next in
      )" + paths_pattern(commands) +
                     R"() at=$next ;;
    esac
  done
  local -a verbs flags
  local valued= files=
  case $at in
)";
  for (const CommandCompletion& command : commands) {
    text += "    " + quoted(command.path) + ")\n      verbs=(" + described(command.subcommands) +
            " )\n      flags=(" + described(command.options) +
            " )\n      valued=" + quoted(options_with_values(command)) +
            "\n      files=" + (command.takes_files ? "yes" : "") + " ;;\n";
  }
  return text + R"(  esac
  if [[ -n $valued && "|$valued|" == *"|${words[CURRENT-1]}|"* ]]; then
    _files
  elif [[ $PREFIX == -* ]]; then
    _describe option flags
  else
    (( $#verbs )) && _describe command verbs
    [[ -z $files ]] || _files
  fi
}
if [[ $funcstack[1] == _adit ]]; then _adit "$@"; else compdef _adit adit; fi
)";
}

std::string fish_completion(const std::vector<CommandCompletion>& commands) {
  std::string text = R"(# fish completion for adit, made by: adit completion fish
function __adit_at
  set -l path
  for word in (commandline -opc)[2..-1]
    switch "$path $word"
      case)";
  for (const CommandCompletion& command : commands) {
    if (!command.path.empty()) text += " " + quoted(" " + command.path);
  }
  text += R"(
        set path "$path $word"
    end
  end
  test (string trim -- "$path") = "$argv[1]"
end
complete -c adit -f
)";
  for (const CommandCompletion& command : commands) text += fish_lines(command);
  return text;
}

namespace {

constexpr const char* kCompletionFooter = R"(Examples:
  source <(adit completion bash)                              in ~/.bashrc
  source <(adit completion zsh)                               in ~/.zshrc, after compinit
  adit completion fish > ~/.config/fish/completions/adit.fish)";

using MakeScript = std::string (*)(const std::vector<CommandCompletion>&);

void add_shell(CLI::App& completion, const CLI::App& adit, const std::string& shell,
               MakeScript make_script) {
  CLI::App* command = completion.add_subcommand(shell, "Print the script for " + shell);
  command->callback([&adit, make_script] { std::cout << make_script(list_commands(adit)); });
}

}  // namespace

void add_completion_command(CLI::App& adit) {
  CLI::App* completion =
      adit.add_subcommand("completion", "Print a script that completes adit's words in a shell");
  completion->require_subcommand(1);
  completion->footer(kCompletionFooter);
  add_shell(*completion, adit, "bash", bash_completion);
  add_shell(*completion, adit, "zsh", zsh_completion);
  add_shell(*completion, adit, "fish", fish_completion);
}

}  // namespace adit
