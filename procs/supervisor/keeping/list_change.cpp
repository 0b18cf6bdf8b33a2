// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/keeping/list_change.hpp"

namespace adit {
namespace {

std::string line(const std::string& what, const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string text = what;
  for (const std::string& name : names) text += " " + name;
  return text + "\n";
}

}  // namespace

ListChange change_between(const ProcessList& before, const ProcessList& after) {
  ListChange change;
  for (const ListedCommand& command : after.commands) {
    const ListedCommand* const old = before.find(command.id);
    if (!old) change.added.push_back(command.id);
    if (old && *old != command) change.changed.push_back(command.id);
  }
  for (const ListedCommand& command : before.commands) {
    if (!after.find(command.id)) change.gone.push_back(command.id);
  }
  change.scripts = before.scripts != after.scripts;
  return change;
}

std::string text_of(const ListChange& change) {
  const std::string text = line("changed:", change.changed) + line("new:", change.added) +
                           line("gone:", change.gone) +
                           (change.scripts ? "scripts have changed\n" : "");
  return text.empty() ? "nothing has changed\n" : text;
}

}  // namespace adit
