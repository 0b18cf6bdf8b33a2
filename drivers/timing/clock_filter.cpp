// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/timing/clock_filter.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace adit {
namespace {

constexpr double kParts = 120.0;  // of the window, each with one point

}  // namespace

double ClockFilter::delay_of(std::int64_t device_us, std::int64_t arrival_us) const {
  return static_cast<double>(arrival_us - device_us - first_delay_us_);
}

void ClockFilter::add(std::int64_t device_us, std::int64_t arrival_us) {
  if (!points_.empty() && device_us <= last_us_) reset();
  if (points_.empty()) {
    origin_us_ = device_us;
    first_delay_us_ = arrival_us - device_us;
  }
  last_us_ = device_us;
  const Point point{static_cast<double>(device_us - origin_us_), delay_of(device_us, arrival_us)};
  const double window_us = 1e6 * params_.window_s;
  const double part_us = window_us / kParts;
  const bool same_part =
      !points_.empty() && static_cast<std::int64_t>(points_.back().device_us / part_us) ==
                              static_cast<std::int64_t>(point.device_us / part_us);
  if (!same_part) {
    points_.push_back(point);
  } else if (point.delay_us <
             points_.back().delay_us + slope_ * (point.device_us - points_.back().device_us)) {
    points_.back() = point;
  } else {
    return;
  }
  while (points_.front().device_us < point.device_us - window_us) points_.pop_front();
  fit();
}

void ClockFilter::fit() {
  const auto turns_left = [](const Point& a, const Point& b, const Point& c) {
    return (b.device_us - a.device_us) * (c.delay_us - a.delay_us) >
           (c.device_us - a.device_us) * (b.delay_us - a.delay_us);
  };
  std::vector<Point> hull;
  double mean_us = 0.0;
  for (const Point& point : points_) {
    while (hull.size() > 1 && !turns_left(hull[hull.size() - 2], hull.back(), point)) {
      hull.pop_back();
    }
    hull.push_back(point);
    mean_us += point.device_us / static_cast<double>(points_.size());
  }
  slope_ = 0.0;
  for (std::size_t i = 1; i < hull.size(); ++i) {
    if (hull[i].device_us < mean_us && i + 1 < hull.size()) continue;
    slope_ =
        (hull[i].delay_us - hull[i - 1].delay_us) / (hull[i].device_us - hull[i - 1].device_us);
    break;
  }
  slope_ = std::clamp(slope_, -params_.drift_max, params_.drift_max);
  offset_us_ = std::numeric_limits<double>::infinity();
  for (const Point& point : hull) {
    offset_us_ = std::min(offset_us_, point.delay_us - slope_ * point.device_us);
  }
}

double ClockFilter::arrival_us(double device_us) const {
  const double since_us = device_us - static_cast<double>(origin_us_);
  return device_us + static_cast<double>(first_delay_us_) + offset_us_ + slope_ * since_us;
}

}  // namespace adit
