// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "common/geometry/pose2.hpp"

namespace adit {

/// A motion between scans that scan matching may have got wrong: what follows in odom may be
/// displaced or turned against what came before.
struct MatchDoubt {
  enum class Reason : std::int8_t {
    kLost = 0,          ///< no accepted match, and no wheels measured the motion
    kPoor = 1,          ///< a match that may be by chance
    kAmbiguous = 2,     ///< other poses match about as well
    kDegenerate = 3,    ///< neither scan nor sensor observed a direction
    kContradicted = 4,  ///< a poor match far from what wheels or gyro measured
  };

  /// Another pose at which the scan matches.
  struct Alternative {
    Pose2 T_odom_body;
    double score = 0.0;  ///< 1 for a scan on the walls

    friend bool operator==(const Alternative&, const Alternative&) = default;
  };

  std::int64_t utime = 0;       ///< of the scan that ends the motion [µs since the epoch]
  std::int64_t from_utime = 0;  ///< of the scan at its beginning
  Reason reason = Reason::kLost;
  std::vector<Alternative> alternatives;  ///< to the pose in SCAN_MATCH, best first

  friend bool operator==(const MatchDoubt&, const MatchDoubt&) = default;
};

}  // namespace adit
