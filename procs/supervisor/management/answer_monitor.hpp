// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Finds a process that ignores its input: messages keep coming for a time, and it publishes
/// nothing in answer. A single message is no proof, since it may need no answer or have been lost,
/// nor is input with a pause as long as that time. Time that the process is blocked on the disk
/// does not count, up to one minute without an answer; nor does input before the first answer, if
/// answers may come late. Times are those of a monotonic clock [µs].
class AnswerMonitor {
 public:
  explicit AnswerMonitor(double timeout_s, bool late = false);

  /// The process was started and may ignore its input for `start_time_s`.
  void reset(std::int64_t now_us, double start_time_s);
  void on_input(std::int64_t now_us);
  void on_answer();
  /// The process was blocked for `blocked_us` until now.
  void add_blocked_time(std::int64_t blocked_us);

  /// Whether input has come since the last answer.
  [[nodiscard]] bool is_unanswered() const { return first_input_us_.has_value(); }
  /// Whether input has kept coming for the timeout since the last answer.
  [[nodiscard]] bool is_ignored() const;

 private:
  std::int64_t timeout_us_;
  bool late_;
  bool has_answered_ = false;  // since its start
  std::int64_t ready_us_ = 0;
  std::optional<std::int64_t> first_input_us_;  // since the last answer or pause
  std::int64_t last_input_us_ = 0;
  std::int64_t blocked_us_ = 0;  // since the first of these
};

}  // namespace adit
