// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/process_list.hpp"

#include <algorithm>

namespace adit {
namespace {

bool matches(const ListedCommand& command, const ScriptTarget& target) {
  using Kind = ScriptTarget::Kind;
  if (target.kind == Kind::kEverything) return true;
  if (target.kind == Kind::kCommand) return command.id == target.name;
  return command.group == target.name || command.group.starts_with(target.name + "/");
}

}  // namespace

const ListedCommand* ProcessList::find(const std::string& id) const {
  const auto found = std::ranges::find(commands, id, &ListedCommand::id);
  return found == commands.end() ? nullptr : &*found;
}

const ProcessScript* ProcessList::find_script(const std::string& name) const {
  const auto found = std::ranges::find(scripts, name, &ProcessScript::name);
  return found == scripts.end() ? nullptr : &*found;
}

std::vector<std::string> ProcessList::ids_of(const ScriptTarget& target) const {
  std::vector<std::string> ids;
  for (const ListedCommand& command : commands) {
    if (matches(command, target)) ids.push_back(command.id);
  }
  return ids;
}

namespace {

std::string names_line(const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = what;
  for (const std::string& name : names) text += " " + name;
  return text + "\n";
}

}  // namespace

ProcessListDiff diff(const ProcessList& before, const ProcessList& after) {
  ProcessListDiff change;
  for (const ListedCommand& command : after.commands) {
    const ListedCommand* const old = before.find(command.id);
    if (!old) change.added.push_back(command.id);
    if (old && *old != command) change.changed.push_back(command.id);
  }
  for (const ListedCommand& command : before.commands) {
    if (!after.find(command.id)) change.removed.push_back(command.id);
  }
  change.scripts = before.scripts != after.scripts;
  return change;
}

std::string text_of(const ProcessListDiff& change) {
  const std::string text =
      names_line("changed:", change.changed) + names_line("added:", change.added) +
      names_line("removed:", change.removed) + (change.scripts ? "scripts changed\n" : "");
  return text.empty() ? "no changes\n" : text;
}

}  // namespace adit
