// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/orders/remote_output.hpp"

namespace adit {

void RemoteOutput::heard(const ProcmanOutput& output, const ProcessList& list,
                         const std::string& own) {
  if (output.deputy == own) return;
  for (const ProcmanOutput::Text& text : output.texts) {
    const ListedCommand* const command = list.find(text.id);
    if (command && command->deputy == output.deputy) logs_[text.id].add(text.text);
  }
}

const OutputLog* RemoteOutput::find(const std::string& id) const {
  const auto found = logs_.find(id);
  return found == logs_.end() ? nullptr : &found->second;
}

}  // namespace adit
