// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/config/bounds.hpp"
#include "common/sensing/scan_match.hpp"

namespace adit {

struct TrustParams {
  double pose_age_max_s = 0.25;  ///< of the newest pose
  double lost_max_s = 0.5;       ///< for which scan matching may be lost

  template <class V>
  void visit(V& v) {
    v("pose_age_max_s", pose_age_max_s, above_up_to(0.0, 1.0));
    v("lost_max_s", lost_max_s, within(0.0, 5.0));
  }
};

/// Whether the robot knows where it is. Without any word from scan matching the poses themselves
/// are trusted: they may come from elsewhere.
class PoseTrust {
 public:
  explicit PoseTrust(const TrustParams& params) : params_(params) {}

  /// A lost match counts from its time until one of any laser is matched.
  void add_match(std::int64_t utime, ScanMatch::Status status);

  /// Why it does not know it, at a time and with the time of the newest pose; nothing if it does.
  [[nodiscard]] std::optional<std::string> doubt(
      std::int64_t utime, const std::optional<std::int64_t>& pose_utime) const;

 private:
  TrustParams params_;
  std::optional<std::int64_t> lost_utime_;
};

}  // namespace adit
