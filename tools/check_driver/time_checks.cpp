// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/check_driver/time_checks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include <fmt/format.h>

#include "common/geometry/order_statistics.hpp"

namespace adit {
namespace {

using Verdict = CheckResult::Verdict;

std::vector<double> steps_ms(const std::vector<std::int64_t>& times) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) {
    steps.push_back(1e-3 * static_cast<double>(times[i] - times[i - 1]));
  }
  return steps;
}

CheckResult check_rate(const DriverChannel& channel, const MessageTimes& times) {
  const double span_s = 1e-6 * static_cast<double>(times.arrivals.back() - times.arrivals.front());
  const double rate_hz = static_cast<double>(times.arrivals.size() - 1) / std::max(span_s, 1e-6);
  const std::string text = fmt::format("{:.1f} messages per second", rate_hz);
  if (rate_hz >= channel.rate_min_hz) return {Verdict::kGood, "rate", text};
  return {Verdict::kBad, "rate",
          fmt::format("{}: at least {} are needed; check baud rate and settings of the device",
                      text, channel.rate_min_hz)};
}

CheckResult check_gaps(const DriverChannel& channel, const MessageTimes& times) {
  const auto steps = steps_ms(times.arrivals);
  const double longest_s = 1e-3 * *std::ranges::max_element(steps);
  const std::string text = fmt::format("at most {:.3f} s between two messages", longest_s);
  if (longest_s <= channel.interval_max_s) return {Verdict::kGood, "gaps", text};
  return {Verdict::kBad, "gaps",
          fmt::format("{}: the guard stops the vehicle after {} s; look for a loose cable, lost "
                      "datagrams or a busy computer",
                      text, channel.interval_max_s)};
}

CheckResult check_order(const MessageTimes& times) {
  const auto steps = steps_ms(times.stamps);
  const auto wrong = std::ranges::count_if(steps, [](double step) { return step <= 0.0; });
  if (wrong == 0) return {Verdict::kGood, "order", "every stamp is later than the one before"};
  return {Verdict::kBad, "order",
          fmt::format("{} of {} stamps are not later than the one before: publish in order of "
                      "time, and each reading once; is there a second driver?",
                      wrong, steps.size())};
}

/// Distance of the steps from multiples of the usual one.
CheckResult check_jitter(const DriverChannel& channel, const MessageTimes& times) {
  constexpr double kJitterMaxShare = 0.1;
  const auto steps = steps_ms(times.stamps);
  const double period_ms = quantile(steps, 0.5);
  if (period_ms <= 0.0) return {Verdict::kUnknown, "jitter", "not checked: stamps do not advance"};
  std::vector<double> off_ms;
  for (const double step : steps) {
    off_ms.push_back(std::abs(step - period_ms * std::max(1.0, std::round(step / period_ms))));
  }
  const double jitter_ms = quantile(off_ms, 0.95);
  const std::string text =
      fmt::format("stamps are within {:.2f} ms of a period of {:.2f} ms", jitter_ms, period_ms);
  if (jitter_ms <= std::max(channel.jitter_max_ms, kJitterMaxShare * period_ms)) {
    return {Verdict::kGood, "jitter", text};
  }
  return {Verdict::kBad, "jitter",
          fmt::format("{}: stamp with the time of measurement, from the rate of the device, not "
                      "of arrival (drivers/timing)",
                      text)};
}

CheckResult check_clock(const DriverChannel& channel, const MessageTimes& times) {
  constexpr double kAheadMaxMs = 1.0;
  std::vector<double> ages_ms;
  for (std::size_t i = 0; i < times.stamps.size(); ++i) {
    ages_ms.push_back(1e-3 * static_cast<double>(times.arrivals[i] - times.stamps[i]));
  }
  const double least_ms = quantile(ages_ms, 0.01);
  const double usual_ms = quantile(ages_ms, 0.5);
  const std::string text =
      fmt::format("stamps are {:.1f} ms before arrival, {:.1f} ms at least", usual_ms, least_ms);
  if (least_ms < -kAheadMaxMs) {
    return {Verdict::kBad, "clock",
            fmt::format("stamps are {:.1f} ms ahead of their arrival: stamp by the clock of this "
                        "computer, or synchronise that of the other one with chrony",
                        -least_ms)};
  }
  if (usual_ms < channel.age_min_ms) {
    return {
        Verdict::kBad, "clock",
        fmt::format("{}: these are times of arrival; utime is the time of the first beam", text)};
  }
  if (usual_ms > 500.0 * channel.interval_max_s) {
    return {Verdict::kBad, "clock",
            fmt::format("{}, of {} s that the guard permits: is the clock of the computer or the "
                        "device wrong, or does the driver collect messages?",
                        text, channel.interval_max_s)};
  }
  return {Verdict::kGood, "clock", text};
}

}  // namespace

CheckResults check_times(const DriverChannel& channel, const MessageTimes& times) {
  if (times.stamps.size() < 3) return {};
  return {check_rate(channel, times), check_gaps(channel, times), check_order(times),
          check_jitter(channel, times), check_clock(channel, times)};
}

}  // namespace adit
