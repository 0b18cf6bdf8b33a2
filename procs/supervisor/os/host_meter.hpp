// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "common/procman/procman_values.hpp"

namespace adit {

/// How busy this computer is, from one look at /proc to the next.
class HostMeter {
 public:
  explicit HostMeter(std::filesystem::path proc = "/proc") : proc_(std::move(proc)) {}

  HostLoad measure();

 private:
  std::filesystem::path proc_;
  double busy_ticks_ = 0.0;
  double all_ticks_ = 0.0;
};

}  // namespace adit
