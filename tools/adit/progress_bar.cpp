// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/progress_bar.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace adit {
namespace {

constexpr ProgressBar::Clock::duration kInitialDelay = std::chrono::seconds(1);
constexpr ProgressBar::Clock::duration kRedrawPeriod = std::chrono::milliseconds(100);
constexpr ProgressBar::Clock::duration kLinePeriod = std::chrono::seconds(10);
constexpr int kWidth = 40;
constexpr const char* kClearLine = "\r\033[K";

}  // namespace

ProgressBar::ProgressBar(std::string label)
    : ProgressBar(std::move(label), std::cerr,
                  isatty(STDERR_FILENO) != 0 ? Form::kBar : Form::kLines,
                  isatty(STDERR_FILENO) != 0 ? kInitialDelay : kLinePeriod) {}

ProgressBar::ProgressBar(std::string label, std::ostream& out, Form form,
                         Clock::duration initial_delay)
    : label_(std::move(label)), out_(out), form_(form), next_draw_(start_ + initial_delay) {}

ProgressBar::~ProgressBar() {
  if (shown_ && form_ == Form::kBar) out_ << kClearLine << std::flush;
}

void ProgressBar::update(double fraction_done) {
  const Clock::time_point now = Clock::now();
  if (now < next_draw_) return;
  next_draw_ = now + (form_ == Form::kBar ? kRedrawPeriod : kLinePeriod);
  draw(std::clamp(fraction_done, 0.0, 1.0), now);
}

void ProgressBar::draw(double fraction_done, Clock::time_point now) {
  const auto filled = static_cast<std::size_t>(std::lround(fraction_done * kWidth));
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  const bool is_bar = form_ == Form::kBar;
  std::string line = is_bar ? fmt::format("{}  [{}] {:3.0f} %", label_, bar, 100.0 * fraction_done)
                            : fmt::format("{}: {:.0f} %", label_, 100.0 * fraction_done);
  if (fraction_done > 0.02) {
    const std::chrono::duration<double> elapsed = now - start_;
    const double remaining_s = elapsed.count() * (1.0 - fraction_done) / fraction_done;
    line += fmt::format("  {:.0f} s left", std::ceil(remaining_s));
  }
  out_ << (is_bar ? kClearLine : "") << line << (is_bar ? "" : "\n") << std::flush;
  shown_ = true;
}

}  // namespace adit
