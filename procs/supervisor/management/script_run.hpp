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

/// How a process stands, for who waits for it.
enum class ProcessState { kStopped, kRunning, kChanging };

/// What a script asks for.
struct ScriptChange {
  ScriptAction::Kind kind = ScriptAction::Kind::kStart;  ///< start, stop or restart
  std::vector<std::string> ids;
};

/// A script on its way. Knows no clock: times are given, in µs of a clock that is never put back.
class ScriptRun {
 public:
  using ProcessStateOf = std::function<ProcessState(const std::string& id)>;

  /// The list must outlive this; it has been checked, so that no script runs itself. `timeout_s` is
  /// for waits that name none. Throws std::invalid_argument where there is no such script.
  ScriptRun(const ProcessList& list, const std::string& name, double timeout_s);

  /// Goes on as far as the next change, which is to be made before the next call; nothing where the
  /// script waits or is over. A wait for a status that is not reached in time ends the script.
  std::optional<ScriptChange> advance(std::int64_t now_us, const ProcessStateOf& process_state_of);

  [[nodiscard]] bool is_finished() const { return calls_.empty(); }
  /// Why it ended before its end; empty where it did not.
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
  std::vector<Call> calls_;  // the innermost last
  const ScriptAction* waiting_ = nullptr;
  std::int64_t wait_end_us_ = 0;
  std::string failure_;
};

}  // namespace adit
