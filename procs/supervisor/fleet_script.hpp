// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/keeping/script_run.hpp"

namespace adit {

/// The script that runs on a fleet, one at a time, and how the last one fared.
class FleetScript {
 public:
  /// Takes the place of one that runs. Throws std::invalid_argument where there is no such script.
  void begin(const std::string& name, const ProcessList& list, double timeout_s);
  /// Does what its turn has come for. Whether anything was changed.
  bool advance(Fleet& fleet, std::int64_t now_us);
  /// Ends it, with that as its failure. Whether one ran.
  bool end(const std::string& why);

  /// Why the last one ended before its end; empty where it did not.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  std::optional<ScriptRun> run_;
  std::string failure_;
};

}  // namespace adit
