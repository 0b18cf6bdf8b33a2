// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>

#include "common/pose_graph/optimize.hpp"

namespace adit {

/// Wall time that an optimisation spends in each of its phases. Give `observer()` to `optimize`.
class PhaseStopwatch {
 public:
  PhaseStopwatch() : since_(Clock::now()) {}

  [[nodiscard]] OptimizeObserver observer() {
    return [this](OptimizePhase begins) { enter(begins); };
  }
  /// What comes before the first phase counts as kRest, what comes after kEnd as nothing.
  [[nodiscard]] double ms(OptimizePhase phase) const { return ms_[index(phase)]; }
  [[nodiscard]] double total_ms() const;

 private:
  using Clock = std::chrono::steady_clock;
  static std::size_t index(OptimizePhase phase) { return static_cast<std::size_t>(phase); }
  void enter(OptimizePhase begins);

  std::array<double, 5> ms_{};
  OptimizePhase phase_ = OptimizePhase::kRest;
  Clock::time_point since_;
};

}  // namespace adit
