// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/run_progress.hpp"

#include <stdexcept>

namespace adit {

void RunProgress::update(const std::string& step, double done) {
  if (stop_.received()) {
    bar_.reset();
    throw std::runtime_error("interrupted; nothing was written to " + folder_.string());
  }
  if (!bar_ || step != step_) bar_.emplace(step);
  step_ = step;
  bar_->update(done);
}

}  // namespace adit
