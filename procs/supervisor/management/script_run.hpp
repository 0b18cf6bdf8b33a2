// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/process_list/process_list.hpp"

namespace adit {

/// State of a process for scripts that wait for it.
enum class ProcessState { kStopped, kRunning, kChanging };

/// A change of processes requested by a script.
struct ScriptChange {
  ScriptAction::Kind kind = ScriptAction::Kind::kStart;  ///< start, stop or restart
  std::vector<std::string> ids;
};

/// Execution of a script. Times are passed in, in µs of a monotonic clock.
class ScriptRun {
 public:
  using ProcessStateOf = std::function<ProcessState(const std::string& id)>;

  /// The list must outlive the run and be valid: no recursive scripts. `timeout_s` applies to waits
  /// without one. Throws std::invalid_argument if there is no such script.
  ScriptRun(const ProcessList& list, const std::string& name, double timeout_s);

  /// Continues to the next change and returns it; the caller must apply it before the next call.
  /// Returns nothing while the script waits and after its end. A wait for a status that times out
  /// ends the script.
  std::optional<ScriptChange> advance(std::int64_t now_us, const ProcessStateOf& process_state_of);

  [[nodiscard]] bool is_finished() const { return calls_.empty(); }
  /// Why the script failed; empty if it did not.
  [[nodiscard]] const std::string& failure() const { return failure_; }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  struct Call {
    const ProcessScript* script;
    std::size_t next = 0;
  };

  [[nodiscard]] bool is_waiting(std::int64_t now_us, const ProcessStateOf& process_state_of);
  void begin_wait(const ScriptAction& action, std::int64_t now_us);

  const ProcessList& list_;
  std::string name_;
  double timeout_s_;
  std::vector<Call> calls_;  // call stack, innermost last
  const ScriptAction* waiting_ = nullptr;
  std::int64_t wait_end_us_ = 0;
  std::string failure_;
};

}  // namespace adit
