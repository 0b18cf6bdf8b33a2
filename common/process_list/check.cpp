// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/check.hpp"

#include <functional>
#include <map>
#include <set>
#include <vector>

#include "common/process_list/command_line.hpp"

namespace adit {
namespace {

using Links = std::map<std::string, std::vector<std::string>>;

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

template <class Named, class Name>
std::string named_twice(const std::vector<Named>& all, Name name, const std::string& what) {
  std::set<std::string> seen;
  for (const Named& one : all) {
    if (!seen.insert(one.*name).second) return "two " + what + " are called " + quoted(one.*name);
  }
  return {};
}

/// Where links lead from a name back to it, in the order of the list; depth first, without
/// recursion, which a long list could exhaust.
std::string circle(const Links& links) {
  std::set<std::string> done;
  for (const auto& start : links) {
    std::vector<std::pair<std::string, std::size_t>> way{{start.first, 0}};
    std::set<std::string> on_way{start.first};
    while (!way.empty()) {
      auto& [name, next] = way.back();
      const auto found = links.find(name);
      if (done.contains(name) || found == links.end() || next == found->second.size()) {
        done.insert(name);
        on_way.erase(name);
        way.pop_back();
        continue;
      }
      const std::string& target = found->second[next++];
      if (!on_way.insert(target).second) return target;
      way.emplace_back(target, 0);
    }
  }
  return {};
}

std::string wrong_command(const ProcessList& list, const ListedCommand& command) {
  if (const auto line = parse_command_line(command.exec); !line) {
    return "command " + quoted(command.id) + ": " + std::string(line.refusal());
  }
  for (const std::string& name : command.depends_on) {
    if (!list.find(name)) {
      return "command " + quoted(command.id) + " depends on " + quoted(name) +
             ", which is not in the list";
    }
  }
  return {};
}

std::string wrong_action(const ProcessList& list, const ScriptAction& action) {
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

std::string wrong_names(const ProcessList& list) {
  const std::string commands = named_twice(list.commands, &ListedCommand::id, "commands");
  return commands.empty() ? named_twice(list.scripts, &ProcessScript::name, "scripts") : commands;
}

std::string wrong_links(const ProcessList& list) {
  if (const std::string name = circle(dependencies(list)); !name.empty()) {
    return "command " + quoted(name) + " depends on itself, in a circle";
  }
  if (const std::string name = circle(calls(list)); !name.empty()) {
    return "script " + quoted(name) + " runs itself, in a circle";
  }
  return {};
}

}  // namespace

std::string what_is_wrong(const ProcessList& list) {
  if (std::string wrong = wrong_names(list); !wrong.empty()) return wrong;
  for (const ListedCommand& command : list.commands) {
    if (std::string wrong = wrong_command(list, command); !wrong.empty()) return wrong;
  }
  for (const ProcessScript& script : list.scripts) {
    for (const ScriptAction& action : script.actions) {
      const std::string wrong = wrong_action(list, action);
      if (!wrong.empty()) return "script " + quoted(script.name) + ": " + wrong;
    }
  }
  return wrong_links(list);
}

}  // namespace adit
