// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/types/mission.hpp"

namespace adit {

/// An order of a person to the mission on LCM.
struct MissionOrderOptions {
  MissionOrder::Kind order = MissionOrder::Kind::kPause;
  std::filesystem::path mission;  ///< folder of one that has a network of its own; empty: this one
  std::string lcm_url;            ///< empty: LCM's default
  double timeout_s = 10.0;        ///< of wall time
};

/// Says it until PHASE shows that it is obeyed. Returns what the mission says then, a sentence.
/// Throws std::runtime_error where no mission answers, does not obey in time, or has ended.
std::string order_mission(const MissionOrderOptions& options);

}  // namespace adit
