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
  /// What a refusal rests on.
  enum class Evidence {
    kSeen,    ///< what is seen leaves no way
    kUnseen,  ///< what is not seen leaves none, or the planner cannot say
    kNarrow,  ///< what is seen leaves none, but by less than can be told
    kDrive,   ///< a drive that failed: there was a path, and it says nothing of the ground
  };

  /// What is to be tried next.
  enum class Next {
    kBeside,      ///< look from a little back at what lies beside the vehicle and round a corner
    kNearer,      ///< go as far as there is a way, and look from there
    kOtherLaser,  ///< look at what lies behind and beside, from the same place
    kBackOff,     ///< look again from `back_offs` times some metres back
    kLookAgain,
    kGiveUp,  ///< it is blocked, or, where `is_doubtful`, not to be found
  };

  /// For another target than the last everything begins anew, and it says so.
  bool aim_at(int stub, bool homeward);
  /// The robot got on: what was refused was elsewhere.
  void got_on();
  /// The planner found no path, or the drive failed.
  Next refuse(std::int64_t utime, double reached_m, const std::string& reason, Evidence evidence,
              bool may_back_off);

  [[nodiscard]] int refusals() const { return refusals_; }
  [[nodiscard]] int back_offs() const { return back_offs_; }
  /// Fewer than two looks saw that there is no way, or one that it can only not be told.
  [[nodiscard]] bool is_doubtful() const;
  [[nodiscard]] std::int64_t utime() const { return utime_; }
  [[nodiscard]] double reached_m() const { return reached_m_; }
  [[nodiscard]] const std::string& evidence() const { return evidence_; }

 private:
  Next see_more(double reached_m, bool may_back_off);

  int stub_ = -1;
  bool homeward_ = false;
  int refusals_ = 0;
  int seen_ = 0;  ///< of them by what was seen
  bool narrow_ = false;
  bool looked_beside_ = false;
  bool went_nearer_ = false;
  bool looked_round_ = false;
  bool drove_again_ = false;
  int back_offs_ = 0;
  std::int64_t utime_ = 0;
  double reached_m_ = 0.0;
  std::string evidence_;
};

}  // namespace adit
