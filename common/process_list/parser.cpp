// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/parser.hpp"

#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "common/process_list/command_line.hpp"
#include "common/process_list/item_parser.hpp"
#include "common/process_list/process_list.hpp"
#include "common/text/message_text.hpp"
#include "common/text/text_check.hpp"

namespace adit {
namespace {

/// Returns the first error in the list as a whole, one line, or an empty string: a duplicate name
/// of a command or script, a command without a program, a missing or cyclic dependency, a script
/// that refers to a missing item or calls itself.
std::string validation_error(const ProcessList& list);

using Links = std::map<std::string, std::vector<std::string>>;

std::string quoted(const std::string& name) { return quote(name, '"'); }

template <class Named, class Name>
std::string duplicate_name(const std::vector<Named>& all, Name name, const std::string& what) {
  std::set<std::string> seen;
  for (const Named& item : all) {
    if (!seen.insert(item.*name).second) return "duplicate " + what + " " + quoted(item.*name);
  }
  return {};
}

/// Returns a name that is part of a cycle, or an empty string. Depth-first search in the order of
/// the names; iterative, since a long list could exhaust the stack of a recursion.
std::string find_cycle(const Links& links) {
  std::set<std::string> done;
  for (const auto& start : links) {
    std::vector<std::pair<std::string, std::size_t>> path{{start.first, 0}};
    std::set<std::string> on_path{start.first};
    while (!path.empty()) {
      auto& [name, next] = path.back();
      const auto found = links.find(name);
      if (done.contains(name) || found == links.end() || next == found->second.size()) {
        done.insert(name);
        on_path.erase(name);
        path.pop_back();
        continue;
      }
      const std::string& target = found->second[next++];
      if (!on_path.insert(target).second) return target;
      path.emplace_back(target, 0);
    }
  }
  return {};
}

std::string command_error(const ProcessList& list, const ListedCommand& command) {
  if (const auto line = parse_command_line(command.exec); !line) {
    return "command " + quoted(command.id) + ": " + std::string(line.rejection());
  }
  for (const std::string& name : command.depends_on) {
    if (!list.find(name)) {
      return "command " + quoted(command.id) + " depends on " + quoted(name) +
             ", which is not in the list";
    }
  }
  return {};
}

std::string action_error(const ProcessList& list, const ScriptAction& action) {
  if (action.kind == ScriptAction::Kind::kRunScript) {
    return list.find_script(action.script) ? "" : "no script " + quoted(action.script);
  }
  if (action.kind == ScriptAction::Kind::kWaitTime || !list.ids_of(action.target).empty()) {
    return {};
  }
  if (action.target.kind == ScriptTarget::Kind::kEverything) return {};
  const bool group = action.target.kind == ScriptTarget::Kind::kGroup;
  return (group ? "no group " : "no command ") + quoted(action.target.name);
}

Links dependencies(const ProcessList& list) {
  Links links;
  for (const ListedCommand& command : list.commands) links[command.id] = command.depends_on;
  return links;
}

Links calls(const ProcessList& list) {
  Links links;
  for (const ProcessScript& script : list.scripts) {
    for (const ScriptAction& action : script.actions) {
      if (!action.script.empty()) links[script.name].push_back(action.script);
    }
  }
  return links;
}

std::string names_error(const ProcessList& list) {
  const std::string commands = duplicate_name(list.commands, &ListedCommand::id, "command");
  return commands.empty() ? duplicate_name(list.scripts, &ProcessScript::name, "script") : commands;
}

std::string links_error(const ProcessList& list) {
  if (const std::string name = find_cycle(dependencies(list)); !name.empty()) {
    return "command " + quoted(name) + " is part of a dependency cycle";
  }
  if (const std::string name = find_cycle(calls(list)); !name.empty()) {
    return "script " + quoted(name) + " is part of a call cycle";
  }
  return {};
}

std::string validation_error(const ProcessList& list) {
  if (std::string error = names_error(list); !error.empty()) return error;
  for (const ListedCommand& command : list.commands) {
    if (std::string error = command_error(list, command); !error.empty()) return error;
  }
  for (const ProcessScript& script : list.scripts) {
    for (const ScriptAction& action : script.actions) {
      const std::string error = action_error(list, action);
      if (!error.empty()) return "script " + quoted(script.name) + ": " + error;
    }
  }
  return links_error(list);
}

using Kind = ListToken::Kind;

std::string parse_group_name(TokenStream& tokens, const std::string& outer) {
  const ListToken name = tokens.expect(Kind::kString, "a quoted group name");
  require_name(tokens, name);
  std::string group = outer.empty() ? name.text : outer + "/" + name.text;
  require_group_path(tokens, name.position, group);
  return group;
}

void parse_group(TokenStream& tokens, const std::string& outer, ProcessList& list) {
  const std::string group = parse_group_name(tokens, outer);
  tokens.expect(Kind::kOpen, "'{'");
  while (!tokens.take_if(Kind::kClose)) {
    if (tokens.next().kind != Kind::kWord) tokens.fail_next("cmd, group or '}'");
    if (tokens.expect_one_of(Kind::kWord, {"cmd", "group"}) == "cmd") {
      list.commands.push_back(parse_listed_command(tokens, group));
    } else {
      parse_group(tokens, group, list);
    }
  }
}

void parse_item(TokenStream& tokens, ProcessList& list) {
  const std::string what = tokens.expect_one_of(Kind::kWord, {"cmd", "group", "script"});
  if (what == "cmd") {
    list.commands.push_back(parse_listed_command(tokens, ""));
  } else if (what == "group") {
    parse_group(tokens, "", list);
  } else {
    list.scripts.push_back(parse_process_script(tokens));
  }
}

/// Applies to strings in the list as well: they are shown on terminals and sent to other computers.
void require_text(std::string_view text, const std::string& name) {
  const auto position = find_non_text_byte(text);
  if (!position) return;
  throw ConfigError(name + ": byte " + std::to_string(*position) + " is not valid text");
}

}  // namespace

ProcessList parse_process_list(std::string_view text, const std::string& name) {
  require_text(text, name);
  ProcessList list;
  TokenStream tokens(text, name);
  while (tokens.next().kind != Kind::kEndOfFile) parse_item(tokens, list);
  if (const std::string error = validation_error(list); !error.empty()) {
    throw ConfigError(name + ": " + error);
  }
  return list;
}

ProcessList read_process_list(const std::filesystem::path& path) {
  constexpr std::size_t kBytesMax = std::size_t{256} << 10;  // thousands of commands
  std::string text;
  try {
    text = read_text_file(path, kBytesMax);
  } catch (const std::runtime_error& error) {
    throw ConfigError(error.what());
  }
  return parse_process_list(text, path.string());
}

}  // namespace adit
