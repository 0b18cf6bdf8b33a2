// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tools/check_driver/check_result.hpp"
#include "tools/doctor/stage_load.hpp"

namespace adit {

/// What the kernel says of its clock (adjtimex).
struct ClockState {
  bool synchronized = false;
  double error_max_s = 0.0;
  std::int64_t utime = 0;
};

/// The results below are functions of what was read, so that each can be tested.
CheckResult check_route(const std::string& proc_net_route);
/// `rmem_max`: net.core.rmem_max [bytes]; less than 0 if it cannot be read.
CheckResult check_buffers(std::int64_t rmem_max);
/// Not synchronized is no fault of one computer that works alone, but a date before that of this
/// program is.
CheckResult check_clock(const ClockState& clock);
/// `governors`: one of each processor; none where the kernel does not scale its frequency.
CheckResult check_governors(const std::vector<std::string>& governors);
/// Whether a disk takes what is recorded: `write_mb_s` while it is written and synchronized,
/// against `log_mb_s` with a reserve of four, and for how many hours `free_mb` suffices.
CheckResult check_disk(const std::filesystem::path& folder, double write_mb_s, double free_mb,
                       double log_mb_s);
/// Whether a device can be opened for reading and writing, by its permissions.
CheckResult check_device(const std::string& driver, const std::string& device);
/// Whether the stages keep up: a core's worth of work, against the cores of this computer.
CheckResult check_load(const StageLoad& load, unsigned cores);

/// Everything but the disk and the load, of this computer, with the devices of the drivers whose
/// sections the file has.
CheckResults check_computer(const std::filesystem::path& config);
/// The speed with which a file of 64 MB in `folder` is written and synchronized [MB/s]. Throws
/// FileError.
double disk_speed_mb_s(const std::filesystem::path& folder);

}  // namespace adit
