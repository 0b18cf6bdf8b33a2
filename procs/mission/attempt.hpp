// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/path/planned_path.hpp"

namespace adit {

/// How often and from where a way to one target was looked for in vain.
class Attempt {
 public:
  /// What is to be tried next.
  enum class Next {
    kOtherLaser,  ///< look at what lies behind and beside, from the same place
    kBackOff,     ///< look again from some metres back
    kLookAgain,
    kGiveUp,  ///< it is blocked
  };

  /// For another target than the last everything begins anew.
  void aim_at(int stub, bool homeward);
  /// The robot got on: what was refused was elsewhere.
  void got_on();
  /// The planner found no path, or the drive failed.
  Next refuse(std::int64_t utime, double reached_m, const std::string& reason, bool unseen,
              bool may_back_off);

  [[nodiscard]] int refusals() const { return refusals_; }
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] double reached_m() const { return reached_m_; }
  [[nodiscard]] const std::string& evidence() const { return evidence_; }

 private:
  int stub_ = -1;
  bool homeward_ = false;
  int refusals_ = 0;
  bool looked_round_ = false;
  bool backed_off_ = false;
  std::int64_t utime_ = 0;
  double reached_m_ = 0.0;
  std::string evidence_;
};

}  // namespace adit
