// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace adit {

/// A stage says which 3D scans it has, and asks for the newest other one that is still held.
struct CloudRequest {
  static constexpr std::size_t kHaveMax = 1000;

  std::int64_t utime = 0;                ///< [µs since the epoch]
  std::string asked_by;                  ///< name of the stage
  std::int64_t after_utime = 0;          ///< none is asked for that ended then or before
  std::vector<std::int64_t> have_utime;  ///< of the newest that it has: Cloud::utime

  friend bool operator==(const CloudRequest&, const CloudRequest&) = default;
};

}  // namespace adit
