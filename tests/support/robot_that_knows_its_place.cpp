// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robot_that_knows_its_place.hpp"

#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"

namespace adit {

RobotThatKnowsItsPlace::RobotThatKnowsItsPlace(World world, const SimulationParams& params)
    : site_(std::move(world)), sim_(bus_, site_, params, 1, kStartUtime) {
  bus_.tap([this](const Received& received) {
    if (received.channel != channels::kTruth) return;
    truth_.assign(received.bytes.begin(), received.bytes.end());
  });
}

void RobotThatKnowsItsPlace::run(double seconds) {
  const std::int64_t end = sim_.simulation().utime() + std::llround(seconds * 1e6);
  while (sim_.simulation().utime() < end) {
    bus_.advance_to(sim_.next_utime());
    sim_.step();
    if (knows_ && !truth_.empty()) bus_.publish(channels::kPose, truth_);
    truth_.clear();
  }
}

}  // namespace adit
