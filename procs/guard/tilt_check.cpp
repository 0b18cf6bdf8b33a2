// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/tilt_check.hpp"

#include <cmath>

#include "procs/guard/attitude.hpp"
#include "procs/guard/decimal_text.hpp"

namespace adit {
namespace {

std::optional<std::string> beyond(const char* name, double angle_rad, double max_rad) {
  if (!(std::abs(angle_rad) > max_rad)) return std::nullopt;
  return std::string(name) + " of " + decimal_text(angle_rad, 2) + " rad, limit " +
         decimal_text(max_rad, 2) + " rad";
}

}  // namespace

std::optional<std::string> tilt_reason(const Eigen::Vector3d& up_body, double tilt_max_rad) {
  if (auto roll = beyond("roll", roll_rad(up_body), tilt_max_rad)) return roll;
  return beyond("pitch", pitch_up_rad(up_body), tilt_max_rad);
}

}  // namespace adit
