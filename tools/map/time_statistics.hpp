// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace adit {

/// Mean, maximum and quantiles of any number of times, in constant memory.
class TimeStatistics {
 public:
  void add(double ms);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// 0 without times, as below.
  [[nodiscard]] double mean_ms() const;
  [[nodiscard]] double max_ms() const { return max_ms_; }
  /// The time below which a share of the times lies, 0 to 1: to half a percent, of times from a
  /// microsecond to a day.
  [[nodiscard]] double quantile_ms(double share) const;

 private:
  std::size_t count_ = 0;
  double sum_ms_ = 0.0;
  double max_ms_ = 0.0;
  std::vector<std::uint64_t> bins_;  ///< of equal width in the logarithm
};

}  // namespace adit
