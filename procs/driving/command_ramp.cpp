// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/driving/command_ramp.hpp"

#include <algorithm>
#include <cmath>

namespace adit {
namespace {

constexpr double kStandS = 0.3;
constexpr double kSteered1M = 0.05;  // of curvature that may be missing

}  // namespace

void CommandRamp::drive(double speed_m_s, double curvature_1_m, double seconds) {
  const double most = steering_rate_1_m_s_ * seconds;
  curvature_1_m_ += std::clamp(curvature_1_m - curvature_1_m_, -most, most);
  const bool steered = std::abs(curvature_1_m - curvature_1_m_) <= kSteered1M;
  const bool stays = speed_m_s_ == 0.0 && !(has_stood() && steered);
  if (stays || speed_m_s_ * speed_m_s < 0.0) return stand(seconds);
  const double faster = std::abs(speed_m_s_) + acceleration_m_s2_ * seconds;
  speed_m_s_ = std::clamp(speed_m_s, -faster, faster);
  standing_s_ = 0.0;
}

void CommandRamp::stand(double seconds) {
  standing_s_ = speed_m_s_ == 0.0 ? standing_s_ + seconds : 0.0;
  speed_m_s_ = 0.0;
}

bool CommandRamp::has_stood() const { return standing_s_ >= kStandS; }

}  // namespace adit
