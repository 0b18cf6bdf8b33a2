// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/process_list/process_list.hpp"

#include <algorithm>

namespace adit {
namespace {

bool is_meant(const ListedCommand& command, const ScriptTarget& target) {
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
    if (is_meant(command, target)) ids.push_back(command.id);
  }
  return ids;
}

}  // namespace adit
