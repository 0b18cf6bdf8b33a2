// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

namespace adit {

/// Whether the vehicle is to stand: as soon as there is a reason, and until there was none for a
/// while and a command has come that is newer than the last moment in which there was one. Stands
/// at first.
class StopLatch {
 public:
  explicit StopLatch(double hold_s) : hold_s_(hold_s) {}

  /// Times by SteadyTime [µs], not before the last; that of the newest command.
  bool judge(bool has_reason, std::optional<std::int64_t> command_us, std::int64_t now_us);

 private:
  double hold_s_;
  bool stopped_ = true;
  std::optional<std::int64_t> reason_us_;  ///< when there was a reason last
};

}  // namespace adit
