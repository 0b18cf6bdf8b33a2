// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "common/process_list/process_list.hpp"
#include "common/procman/procman_values.hpp"
#include "procs/supervisor/keeping/output_log.hpp"

namespace adit {

/// What the processes of other computers print, as far as it was heard: of each the last lines, as
/// for those of this computer. Their names are those of the list, so nobody can fill the memory.
class RemoteOutput {
 public:
  /// What comes from another computer than the list says is left out, and so is what is `own`.
  void heard(const ProcmanOutput& output, const ProcessList& list, const std::string& own);

  /// Null where nothing was heard.
  [[nodiscard]] const OutputLog* find(const std::string& id) const;

 private:
  std::map<std::string, OutputLog> logs_;  // by process
};

}  // namespace adit
