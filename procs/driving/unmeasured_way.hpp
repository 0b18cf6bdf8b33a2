// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "common/sensing/scan_match.hpp"

namespace adit {

/// How far was driven since a scan, or wheels or a gyro in its place, last told the motion in every
/// direction. Where nothing tells it the pose stands still, and the end of a path never comes.
class UnmeasuredWay {
 public:
  /// A scan that is lost says neither.
  void add_match(const ScanMatch& match) {
    if (match.status != ScanMatch::Status::kMatched) return;
    open_ = leaves_open(match);
    if (!open_) way_m_ = 0.0;
  }
  /// By command [m], either way.
  void drive(double way_m) {
    if (open_) way_m_ += std::abs(way_m);
  }
  void begin_anew() { way_m_ = 0.0; }

  [[nodiscard]] double way_m() const { return way_m_; }

 private:
  bool open_ = false;
  double way_m_ = 0.0;
};

}  // namespace adit
