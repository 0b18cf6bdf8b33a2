// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/timing/device_clock.hpp"

#include <cmath>

namespace adit {
namespace {

// So long after the answer its time and that of the arrivals are compared; later, the rate of the
// device's clock between the two would count.
constexpr std::int64_t kComparedUs = 20'000'000;

}  // namespace

void DeviceClock::add_answer(std::int64_t device_us, std::int64_t asked_us,
                             std::int64_t answered_us) {
  const std::int64_t took_us = answered_us - asked_us;
  if (answer_ && answer_->took_us <= took_us) return;
  answer_ = {device_us, 0.5 * static_cast<double>(asked_us + answered_us), took_us};
}

void DeviceClock::add_arrival(std::int64_t device_us, std::int64_t arrival_us) {
  arrivals_.add(device_us, arrival_us);
  if (!answer_ || device_us - answer_->device_us > kComparedUs) return;
  delay_us_ = arrivals_.arrival_us(static_cast<double>(answer_->device_us)) - answer_->utime;
}

std::int64_t DeviceClock::utime(std::int64_t device_us, double delay_us) const {
  return std::llround(arrivals_.arrival_us(static_cast<double>(device_us)) -
                      (answer_ ? delay_us_ : delay_us));
}

std::optional<double> DeviceClock::uncertainty_us() const {
  if (!answer_) return std::nullopt;
  return 0.5 * static_cast<double>(answer_->took_us);
}

}  // namespace adit
