// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/completion.hpp"

#include <algorithm>

#include <CLI/CLI.hpp>

namespace adit {
namespace {

CommandWords words_of(const CLI::App& app, const std::string& path) {
  CommandWords words;
  words.path = path;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    words.subcommands.push_back({sub->get_name(), sub->get_description(), false});
  }
  for (const CLI::Option* option : app.get_options()) {
    const bool takes_value = option->get_items_expected_max() > 0;
    if (option->get_positional()) words.takes_files = true;
    for (const std::string& name : option->get_lnames()) {
      words.options.push_back({"--" + name, option->get_description(), takes_value});
    }
  }
  return words;
}

void list_into(std::vector<CommandWords>& commands, const CLI::App& app, const std::string& path) {
  commands.push_back(words_of(app, path));
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; })) {
    list_into(commands, *sub, path.empty() ? sub->get_name() : path + " " + sub->get_name());
  }
}

/// In single quotes, for any of the shells.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string joined(const std::vector<CommandWords::Word>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word.text;
  return text;
}

/// A pattern of `case` for all words that go deeper into the tree.
std::string paths_pattern(const std::vector<CommandWords>& commands) {
  std::string pattern;
  for (const CommandWords& command : commands) {
    if (command.path.empty()) continue;
    pattern += (pattern.empty() ? "" : "|") + quoted(command.path);
  }
  return pattern;
}

std::string options_with_values(const CommandWords& command) {
  std::string pattern;
  for (const auto& option : command.options) {
    if (option.takes_value) pattern += (pattern.empty() ? "" : "|") + option.text;
  }
  return pattern;
}

/// Words with descriptions as zsh's _describe takes them; colons divide the two.
std::string described(const std::vector<CommandWords::Word>& words) {
  std::string text;
  for (const auto& word : words) text += " " + quoted(word.text + ":" + word.description);
  return text;
}

std::string fish_line(const std::string& path, const std::string& rest) {
  return "complete -c adit -n " + quoted("__adit_at " + quoted(path)) + " " + rest + "\n";
}

std::string fish_lines(const CommandWords& command) {
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

std::vector<CommandWords> list_commands(const CLI::App& app) {
  std::vector<CommandWords> commands;
  list_into(commands, app, "");
  return commands;
}

std::string bash_completion(const std::vector<CommandWords>& commands) {
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
  for (const CommandWords& command : commands) {
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

std::string zsh_completion(const std::vector<CommandWords>& commands) {
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
  for (const CommandWords& command : commands) {
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

std::string fish_completion(const std::vector<CommandWords>& commands) {
  std::string text = R"(# fish completion for adit, made by: adit completion fish
function __adit_at
  set -l path
  for word in (commandline -opc)[2..-1]
    switch "$path $word"
      case)";
  for (const CommandWords& command : commands) {
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
  for (const CommandWords& command : commands) text += fish_lines(command);
  return text;
}

}  // namespace adit
