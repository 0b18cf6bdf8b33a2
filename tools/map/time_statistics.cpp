// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/map/time_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kShortestMs = 1e-3;
constexpr double kLongestMs = 1e8;
constexpr double kBinWidth = 0.01;  // of the natural logarithm

}  // namespace

void TimeStatistics::add(double ms) {
  ++count_;
  sum_ms_ += ms;
  max_ms_ = std::max(max_ms_, ms);
  const double within = std::clamp(ms, kShortestMs, kLongestMs);
  const auto bin = static_cast<std::size_t>(std::log(within / kShortestMs) / kBinWidth);
  if (bin >= bins_.size()) bins_.resize(bin + 1);
  ++bins_[bin];
}

double TimeStatistics::mean_ms() const {
  return count_ > 0 ? sum_ms_ / static_cast<double>(count_) : 0.0;
}

double TimeStatistics::quantile_ms(double share) const {
  const double below = share * static_cast<double>(count_);
  double found = 0.0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    found += static_cast<double>(bins_[bin]);
    if (found > below || bin + 1 == bins_.size()) {
      const double middle = (static_cast<double>(bin) + 0.5) * kBinWidth;
      return std::min(max_ms_, kShortestMs * std::exp(middle));
    }
  }
  return 0.0;
}

}  // namespace adit
