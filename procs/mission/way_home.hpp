// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace adit {

/// Whether the robot gets on on its way home, by how long exploration says that it still is. A
/// drive alone does not tell: back along its own track it leads away from a short cut that is
/// shut, and exploration leads to the short cut again.
class WayHome {
 public:
  static constexpr double kGotOnM = 1.0;

  /// It has turned home, or turned home again.
  void begin() { *this = {}; }

  /// What exploration says now [m]. Whether it is a metre shorter than ever, or another way at once
  /// after the verdict on the last; then what was refused before lies behind.
  bool got_on(double way_m) {
    const bool shorter = way_m < least_m_ - kGotOnM;
    const bool another = answers_verdict_ && way_m > last_m_ + kGotOnM;
    last_m_ = way_m;
    answers_verdict_ = false;
    if (!shorter && !another) return false;
    least_m_ = way_m;
    judged_ = false;
    return true;
  }

  /// A verdict says that this way is shut.
  void judge() { judged_ = answers_verdict_ = true; }
  /// Without it having got on since: exploration knows no other.
  [[nodiscard]] bool was_judged() const { return judged_; }

 private:
  double least_m_ = std::numeric_limits<double>::infinity();
  double last_m_ = std::numeric_limits<double>::infinity();
  bool judged_ = false;
  bool answers_verdict_ = false;  ///< what exploration says next
};

}  // namespace adit
