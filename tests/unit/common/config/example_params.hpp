// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/config.hpp"

namespace adit {

struct InnerParams {
  int iterations = 10;
  bool robust = true;

  template <class V>
  void visit(V& v) {
    v("iterations", iterations, within(1, 100));
    v("robust", robust);
  }
  friend bool operator==(const InnerParams&, const InnerParams&) = default;
};

struct OuterParams {
  double search_radius_m = 0.3;
  double share = 0.1;
  std::string channel = "LASER_FRONT";
  std::vector<double> thresholds_m = {0.5, 0.25};
  Pose2 T_body_laser{0.2, 0.0, 0.0};
  InnerParams inner;

  template <class V>
  void visit(V& v) {
    v("search_radius_m", search_radius_m, above(0.0));
    v("share", share, within(0.0, 1.0));
    v("channel", channel);
    v("thresholds_m", thresholds_m, at_least(0.0));
    v("T_body_laser", T_body_laser);
    v("inner", inner);
  }
  friend bool operator==(const OuterParams&, const OuterParams&) = default;
};

inline OuterParams load_outer(const std::string& yaml) {
  return load_section<OuterParams>(ConfigFile::parse(yaml, "robot.yaml"), "outer");
}

}  // namespace adit
