// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/mission/mission_progress.hpp"

namespace adit {

/// Shows how a mission goes: on a terminal one line that changes, in a file a line now and then.
class MissionTeller {
 public:
  MissionTeller();

  /// `wall_s` is the time since the mission began.
  void update(const MissionProgress& progress, double wall_s);
  /// What a person should know, on standard error.
  void say(const std::string& what) const;
  /// How it ended, and how long that took. `trouble` is why it did not come to its end, or empty.
  static void end(const MissionProgress& last, const std::string& trouble, double wall_s);

 private:
  bool on_terminal_;
  double next_s_ = 0.0;
};

}  // namespace adit
