// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace adit {

/// A bar on a terminal for work of which the share that is done is known. Nothing is shown before
/// the work has taken a second, and nothing is left behind when the bar goes.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// On standard error if that is a terminal; otherwise silent.
  explicit ProgressBar(std::string label);
  /// On a stream, or silent for null.
  ProgressBar(std::string label, std::ostream* out, Clock::duration initial_delay);
  ~ProgressBar();

  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Cheap enough to be called for each of many small steps.
  void update(double fraction_done);

 private:
  void draw(double fraction_done, Clock::time_point now);

  std::string label_;
  std::ostream* out_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_draw_;
  bool shown_ = false;
};

}  // namespace adit
