// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>

namespace adit {

/// Progress bar on a terminal, with an estimate of the remaining time. The bar appears after the
/// first second of work, and its destructor erases it.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;

  /// Draws on standard error if that is a terminal, else draws nothing.
  explicit ProgressBar(std::string label);
  /// Draws on `out`; draws nothing if `out` is null.
  ProgressBar(std::string label, std::ostream* out, Clock::duration initial_delay);
  ~ProgressBar();

  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Redraws at most every 0.1 s, so that it can be called for each small step.
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
