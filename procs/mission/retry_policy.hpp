// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "common/types/planned_path.hpp"

namespace adit {

/// How often and from where a way to one target was looked for in vain.
class RetryPolicy {
 public:
  /// What a refusal rests on.
  enum class Evidence {
    kObserved,     ///< what is seen leaves no way
    kUnobserved,   ///< what is not seen leaves none, or the planner cannot say
    kNarrow,       ///< what is seen leaves none, but by less than can be told
    kDriveFailed,  ///< a drive that failed: there was a path, and it says nothing of the ground
  };

  /// What is to be tried next.
  enum class Action {
    kScanBeside,  ///< look from a little back at what lies beside the vehicle and round a corner
    kApproach,    ///< go as far as there is a way, and look from there
    kScanOtherLaser,  ///< look at what lies behind and beside, from the same place
    kBackOff,         ///< look again from `back_offs` times some metres back
    kRescan,
    kAbandon,  ///< it is blocked, or, where `is_uncertain`, not to be found
  };

  /// For another target than the last everything begins anew, and it says so.
  bool set_target(int frontier, bool returning_home);
  /// The robot got on: what was refused was elsewhere.
  void note_progress();
  /// The planner found no path, or the drive failed.
  Action reject(std::int64_t utime, double reached_m, const std::string& reason, Evidence evidence,
                bool may_back_off);

  [[nodiscard]] int rejections() const { return rejections_; }
  [[nodiscard]] int back_offs() const { return back_offs_; }
  /// Fewer than two looks saw that there is no way, or one that it can only not be told.
  [[nodiscard]] bool is_uncertain() const;
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] double reached_m() const { return reached_m_; }
  [[nodiscard]] const std::string& evidence() const { return evidence_; }

 private:
  Action choose_observation(double reached_m, bool may_back_off);

  int frontier_ = -1;
  bool homeward_ = false;
  int rejections_ = 0;
  int observed_ = 0;  ///< of them by what was seen
  bool narrow_ = false;
  bool scanned_beside_ = false;
  bool approached_ = false;
  bool scanned_other_side_ = false;
  bool rescanned_after_drive_ = false;
  int back_offs_ = 0;
  std::int64_t utime_ = 0;
  double reached_m_ = 0.0;
  std::string evidence_;
};

}  // namespace adit
