// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/types/mission.hpp"

namespace adit {

/// An order of the operator to a mission on LCM.
struct MissionOrderOptions {
  MissionOrder::Kind order = MissionOrder::Kind::kPause;
  std::filesystem::path mission;  ///< folder of a mission on a private network; empty: this network
  std::string lcm_url;            ///< empty: LCM's default
  double timeout_s = 10.0;        ///< of wall time
};

/// Repeats the order until PHASE confirms it. Returns the reason in PHASE, a sentence. Throws
/// std::runtime_error if no mission responds, the order is not executed within the timeout, or the
/// mission has ended.
std::string order_mission(const MissionOrderOptions& options);

}  // namespace adit
