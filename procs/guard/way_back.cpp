// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/guard/way_back.hpp"

namespace adit {

bool WayBack::forbids(bool is_there, int direction, std::int64_t now_us) {
  if (!is_there) {
    if (now_us - there_us_ > kOverAfterUs) into_.reset();
    if (direction != 0) driven_ = direction;
    return false;
  }
  there_us_ = now_us;
  if (!into_) into_ = driven_;
  const bool leaves = *into_ != 0 && direction == -*into_;
  return !leaves;
}

}  // namespace adit
