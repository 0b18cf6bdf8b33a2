// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robots/simulated_robot.hpp"

#include <cmath>
#include <utility>

#include "common/bus/channels.hpp"

namespace adit {

GroundTruthRobot::GroundTruthRobot(World world, const SimulationParams& params)
    : site_(std::move(world)), sim_(bus_, site_, params, 1, kStartUtime) {
  bus_.tap([this](const ReceivedMessage& received) {
    if (received.channel != channels::kTruth) return;
    truth_.assign(received.bytes.begin(), received.bytes.end());
  });
}

void GroundTruthRobot::run(double seconds) {
  const std::int64_t end = sim_.simulation().utime() + std::llround(seconds * 1e6);
  while (sim_.simulation().utime() < end) {
    bus_.advance_to(sim_.next_utime());
    sim_.step();
    if (localized_ && !truth_.empty()) bus_.publish(channels::kPose, truth_);
    truth_.clear();
  }
}

ScanMatchingRobot::ScanMatchingRobot(World world)
    : site_(std::move(world)), scan_matching_(bus_, with_groundhog_lasers<ScanMatchingParams>()) {}

void ScanMatchingRobot::run(double seconds) {
  const std::int64_t end = sim_.simulation().utime() + std::llround(seconds * 1e6);
  while (sim_.simulation().utime() < end) {
    bus_.advance_to(sim_.next_utime());
    sim_.step();
  }
}

}  // namespace adit
