// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "common/bus/bus.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/types/procman.hpp"
#include "viewer/server/topic_board.hpp"

namespace adit {

/// The processes of all computers and the health of the stages, /processes, from PM_INFO and
/// HEARTBEAT.
class ProcessLayer {
 public:
  static constexpr std::size_t kComputersMax = 50;
  static constexpr std::size_t kStagesMax = 200;

  /// All must outlive this. `now_utime`: the time of the content.
  ProcessLayer(Bus& bus, TopicBoard& board, std::function<std::int64_t()> now_utime);
  ProcessLayer(const ProcessLayer&) = delete;
  ProcessLayer& operator=(const ProcessLayer&) = delete;

 private:
  struct Process {
    int pid = 0;       ///< of the last run
    int restarts = 0;  ///< seen here
  };

  void on_info(const ProcmanInfo& info);
  [[nodiscard]] std::string processes_message() const;

  TopicBoard& board_;
  std::function<std::int64_t()> now_utime_;
  TopicId topic_ = 0;
  std::map<std::string, ProcmanInfo> computers_;
  std::map<std::string, Process> processes_;  ///< by computer and name
  std::map<std::string, Heartbeat> stages_;
};

}  // namespace adit
