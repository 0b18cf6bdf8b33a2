// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace adit {

/// The progress of long work, with an estimate of the remaining time. On a terminal it is a bar,
/// which appears after the first second of work and which the destructor erases; elsewhere a line
/// every ten seconds.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  enum class Form { kBar, kLines };

  /// On standard error, in the form that it needs.
  explicit ProgressBar(std::string label);
  /// On `out`. `initial_delay`: time until the first output.
  ProgressBar(std::string label, std::ostream& out, Form form, Clock::duration initial_delay);
  ~ProgressBar();

  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Draws a bar at most every 0.1 s, so that it can be called for each small step.
  void update(double fraction_done);

 private:
  void draw(double fraction_done, Clock::time_point now);

  std::string label_;
  std::ostream& out_;
  Form form_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_draw_;
  bool shown_ = false;
};

}  // namespace adit
