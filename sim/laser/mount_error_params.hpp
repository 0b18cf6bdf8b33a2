// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/config/bounds.hpp"

namespace adit {

/// By how much a laser stands otherwise than the stages take it for.
struct MountErrorParams {
  double yaw_rad = 0.0;   ///< to the left
  double tilt_rad = 0.0;  ///< downwards, at every reading of its encoder

  template <class V>
  void visit(V& v) {
    v("yaw_rad", yaw_rad, within(-0.2, 0.2));
    v("tilt_rad", tilt_rad, within(-0.2, 0.2));
  }
};

}  // namespace adit
